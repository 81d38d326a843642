#include "base/file.hpp"

#include <cerrno>
#include <string_view>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "base/error.hpp"

// The program under test calls these in place of the C library's, so that a test can take /proc
// away or let a disk fail, and see what was asked for.
namespace {
bool proc_is_missing = false;
int syncfs_calls = 0, syncfs_error = 0;
}  // namespace

extern "C" int linkat(int from, const char* name, int to, const char* new_name,
                      int flags) noexcept {
  if (proc_is_missing && std::string_view(name).starts_with("/proc/")) {
    errno = ENOENT;
    return -1;
  }
  return static_cast<int>(::syscall(SYS_linkat, from, name, to, new_name, flags));
}

extern "C" int syncfs(int descriptor) noexcept {
  ++syncfs_calls;
  errno = syncfs_error;
  return syncfs_error != 0 ? -1 : static_cast<int>(::syscall(SYS_syncfs, descriptor));
}

namespace lantern {
namespace {

namespace fs = std::filesystem;

// A folder of its own for each test, empty at its beginning.
class File : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(LANTERN_TEST_OUTPUT) / "file" /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    make_folder(folder_);
  }

  std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  // The action must fail with both parts in its message.
  template <class Action>
  void expect_io_error(const std::string& part, const std::string& other, Action&& action) {
    try {
      action();
      FAIL() << "no error about " << part;
    } catch (const IoError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find(part), std::string::npos) << text;
      EXPECT_NE(text.find(other), std::string::npos) << text;
    }
  }

  fs::path folder_;
};

TEST_F(File, ComesBackByteForByte) {
  std::string bytes = "a\0b\r\n\xff";
  bytes += std::string(300'000, '\0');
  write_file(folder_ / "x", bytes);
  EXPECT_EQ(read_file(folder_ / "x", 1 << 20), bytes);
  write_file(folder_ / "x", "");
  EXPECT_EQ(read_file(folder_ / "x", 0), "");
  EXPECT_EQ(entries(), 1u) << "a temporary file is left";
}

TEST_F(File, IsNeverSeenHalf) {
  const fs::path path = folder_ / "frame";
  const std::string a(200'000, 'a'), b(100'000, 'b');
  write_file(path, a);
  std::thread writer([&] {
    for (int i = 0; i < 50; ++i) write_file(path, i % 2 == 0 ? b : a);
  });
  int halves = 0;
  for (int i = 0; i < 200; ++i) {
    const std::string seen = read_file(path, 1 << 20);
    halves += seen != a && seen != b;
  }
  writer.join();
  EXPECT_EQ(halves, 0) << "a reader saw neither the old nor the new file";
}

TEST_F(File, ReplacesALinkAndSparesItsTarget) {
  write_file(folder_ / "target", "precious");
  fs::create_symlink("target", folder_ / "link");
  write_file(folder_ / "link", "new");
  EXPECT_EQ(read_file(folder_ / "target", 100), "precious") << "the link was followed";
  EXPECT_FALSE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(read_file(folder_ / "link", 100), "new");
}

TEST_F(File, NamesPathAndReasonWhenItCannotBeWritten) {
  expect_io_error("missing/x", "No such file", [&] { write_file(folder_ / "missing/x", "1"); });
  fs::create_directory(folder_ / "taken");
  expect_io_error("taken", "directory", [&] { write_file(folder_ / "taken", "1"); });
  EXPECT_EQ(entries(), 1u) << "a temporary file is left after a failure";
}

TEST_F(File, RefusesToReadWhatIsNoFile) {
  expect_io_error("missing", "No such file", [&] { read_file(folder_ / "missing", 10); });
  expect_io_error(folder_.filename().string(), "directory", [&] { read_file(folder_, 10); });
  expect_io_error("/dev/zero", "not a regular file", [&] { read_file("/dev/zero", 10); });
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  expect_io_error("pipe", "not a regular file", [&] { read_file(pipe, 10); });  // and never waits
}

TEST_F(File, RefusesToReadMoreThanAllowed) {
  write_file(folder_ / "x", "12345");
  EXPECT_EQ(read_file(folder_ / "x", 5), "12345");
  expect_io_error("5 bytes", "limit is 4", [&] { read_file(folder_ / "x", 4); });
}

TEST_F(File, LeftoversGoAndNothingElse) {
  write_file(folder_ / ".lantern-part-1-0", "half");
  write_file(folder_ / "frame.png", "whole");
  write_file(folder_ / ".hidden", "mine");
  Folder(folder_).remove_leftovers();
  EXPECT_FALSE(fs::exists(folder_ / ".lantern-part-1-0"));
  EXPECT_EQ(entries(), 2u);
}

TEST_F(File, MakesFoldersWithTheirParents) {
  make_folder(folder_ / "a/b/c");
  EXPECT_TRUE(fs::is_directory(folder_ / "a/b/c"));
  EXPECT_NO_THROW(make_folder(folder_ / "a/b/c")) << "one that is there already is good";
  write_file(folder_ / "file", "");
  expect_io_error("file", "cannot make the folder", [&] { make_folder(folder_ / "file"); });
  expect_io_error("file/x", "cannot make the folder", [&] { make_folder(folder_ / "file/x"); });
}

TEST_F(File, IsWrittenWithoutProc) {
  proc_is_missing = true;
  EXPECT_NO_THROW(write_file(folder_ / "x", "new"));
  EXPECT_NO_THROW(write_file(folder_ / "x", "newer"));
  expect_io_error("missing/x", "No such file", [&] { write_file(folder_ / "missing/x", "1"); });
  proc_is_missing = false;
  EXPECT_EQ(read_file(folder_ / "x", 10), "newer");
  EXPECT_EQ(entries(), 1u) << "a temporary file is left";
}

TEST_F(File, AFolderIsMadeDurableByTheSystem) {
  const int before = syncfs_calls;
  Folder(folder_).settle();
  EXPECT_EQ(syncfs_calls, before + 1);
  expect_io_error("missing", "No such file", [&] { Folder(folder_ / "missing"); });
  syncfs_error = EIO;
  expect_io_error(folder_.filename().string(), "Input/output", [&] { Folder(folder_).settle(); });
  syncfs_error = 0;
}

// A name never reaches a terminal as it is.
TEST_F(File, ErrorsShowAStrangeNameAsEscapes) {
  expect_io_error("a\\x1b[31m\\n\\xff", "No such file",
                  [&] { read_file(folder_ / "a\x1b[31m\n\xff", 10); });
}

TEST_F(File, WritesIntoTheCurrentFolder) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  write_file("plain", "1");
  fs::current_path(before);
  EXPECT_EQ(read_file(folder_ / "plain", 10), "1");
}

// --- held open ---

TEST_F(File, AFolderStaysTheSameWhateverBecomesOfItsPath) {
  make_folder(folder_ / "held");
  const Folder held(folder_ / "held");
  fs::rename(folder_ / "held", folder_ / "moved");
  make_folder(folder_ / "held");
  write_file({held, "x"}, "1");
  EXPECT_EQ(read_file(folder_ / "moved/x", 10), "1");
  EXPECT_FALSE(fs::exists(folder_ / "held/x"));
  EXPECT_EQ(held.names(), std::vector<std::string>{"x"});
  EXPECT_EQ(held.read("x", 10), "1");
  EXPECT_FALSE(held.read("y", 10));
  EXPECT_TRUE(held.remove("x"));
  EXPECT_FALSE(held.remove("x"));
  EXPECT_TRUE(held.is(Folder(folder_ / "moved")));
  EXPECT_FALSE(held.is(Folder(folder_ / "held")));
}

TEST_F(File, AFolderFollowsNoLink) {
  make_folder(folder_ / "outside");
  write_file(folder_ / "outside/x", "precious");
  const Folder in = Folder::made(folder_ / "in");
  fs::create_directory_symlink(folder_ / "outside", folder_ / "in/link");
  fs::create_symlink(folder_ / "outside/x", folder_ / "in/x");
  expect_io_error("in/link", "a link", [&] { in.inside("link"); });
  expect_io_error("in/link", "a link", [&] { in.find("link"); });
  expect_io_error("in/x", "a link", [&] { in.read("x", 10); });
  EXPECT_TRUE(in.has("x"));
  EXPECT_FALSE(in.has_file("x"));
  write_file({in, "x"}, "new");
  EXPECT_EQ(read_file(folder_ / "outside/x", 10), "precious");
  EXPECT_TRUE(in.remove("link"));
  EXPECT_TRUE(fs::exists(folder_ / "outside/x"));
}

TEST_F(File, AFolderHasEntriesAndNoPaths) {
  const Folder folder(folder_);
  for (const char* name : {"", ".", "..", "a/b", "../x", "/tmp/x"}) {
    EXPECT_DEATH(folder.inside(name), "broken invariant");
    EXPECT_DEATH(write_file({folder, name}, ""), "broken invariant");
  }
  EXPECT_DEATH(folder.read(std::string_view("a\0b", 3), 1), "broken invariant");
}

// --- inputs ---

TEST_F(File, NothingIsWrittenOverWhatWasRead) {
  write_file(folder_ / "in", "mine");
  fs::create_hard_link(folder_ / "in", folder_ / "other");
  EXPECT_FALSE(is_input(folder_ / "in"));
  read_input(folder_ / "in", 10);
  for (const char* name : {"in", "./in", "other"}) {
    EXPECT_TRUE(is_input(folder_ / name)) << name;
    expect_io_error(name, "what this run has read", [&] { write_file(folder_ / name, "new"); });
  }
  expect_io_error("in", "what this run has read", [&] {
    write_file({Folder(folder_), "in"}, "new");
  });
  EXPECT_EQ(read_file(folder_ / "in", 10), "mine");
  // An editor puts a new file in the place of the old, whose number is then free for another.
  fs::remove(folder_ / "in");
  fs::remove(folder_ / "other");
  write_file(folder_ / "picture", "1");
  EXPECT_NO_THROW(write_file(folder_ / "picture", "2"));
}

}  // namespace
}  // namespace lantern
