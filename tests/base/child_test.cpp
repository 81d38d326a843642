#include "base/child.hpp"

#include <array>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "base/file.hpp"
#include "base/stop.hpp"

namespace lantern {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> shell_words(const std::string& script) {
  return {"/bin/sh", "-c", script};
}

TEST(Child, ReadsWhatIsWrittenIntoTheFileThatItWasHanded) {
  const fs::path folder = fs::path(LANTERN_TEST_OUTPUT) / "child";
  make_folder(folder);
  PartFile file(folder / "x");
  Child child(shell_words("cat >&3; echo done >&2; exit 5"), file.descriptor());
  const std::string bytes(3'000'000, 'x');
  EXPECT_TRUE(child.write(bytes));
  EXPECT_EQ(child.finish(), 5);
  EXPECT_EQ(child.finish(), 5);
  EXPECT_EQ(child.said(), "done\n");
  EXPECT_EQ(file.bytes(), bytes.size());
  file.give_name();
  EXPECT_EQ(read_file(folder / "x", 1 << 23), bytes);
}

// And this process lives on, though it does nothing about SIGPIPE.
TEST(Child, ThatReadsNoMoreIsToldOf) {
  Child child(shell_words("exit 3"));
  EXPECT_FALSE(child.write(std::string(3'000'000, 'x')));
  EXPECT_EQ(child.finish(), 3);
}

TEST(Child, ThatIsNoProgramSaysSo) {
  Child child({"/nowhere/ffmpeg"});
  EXPECT_EQ(child.finish(), 127);
  EXPECT_EQ(child.said(), "No such file or directory");
}

TEST(Child, MayTalkWithoutEnd) {
  Child child(
      shell_words("i=0; while [ $i -lt 3000 ]; do echo 0123456789012345678901234567890123456"
                  " >&2; i=$((i+1)); done; echo end >&2; cat >/dev/null"));
  EXPECT_TRUE(child.write(std::string(2'000'000, 'x')));
  EXPECT_EQ(child.finish(), 0);
  EXPECT_LE(child.said().size(), 4096u);
  EXPECT_TRUE(child.said().ends_with("\nend\n"));
}

TEST(Child, EndsWithItsOwner) {
  // What is left of it would keep the pipe open, and be waited for to its end.
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
  { Child child(shell_words("sleep 10000 & sleep 10000"), ends[1]); }
  ::close(ends[1]);
  char byte = 0;
  EXPECT_EQ(::read(ends[0], &byte, 1), 0);
  ::close(ends[0]);
}

// Whoever waits for it may have just been told that it is gone: nobody else must be ended for it.
TEST(Child, IsEndedWhileItIsWaitedFor) {
  Child witness(shell_words("sleep 100"));
  for (int round = 0; round < 200; ++round) {
    Child child(shell_words("exit 0"));
    std::thread waits([&] { child.finish(); });
    for (int i = 0; i < 200; ++i) child.end();
    waits.join();
  }
  EXPECT_TRUE(witness.write("still here"));
}

TEST(Child, ThatDoesNotReadDoesNotKeepAWishToStopWaiting) {
  Child child(shell_words("sleep 100"));
  std::thread later([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    ask_to_stop();
  });
  EXPECT_THROW(child.write(std::string(3'000'000, 'x')), Stopped);
  later.join();
  EXPECT_THROW(child.finish(), Stopped);
  forget_stop();
}

}  // namespace
}  // namespace lantern
