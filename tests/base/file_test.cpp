#include "base/file.hpp"

#include <cerrno>
#include <string_view>
#include <thread>

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
  remove_leftovers(folder_);
  EXPECT_FALSE(fs::exists(folder_ / ".lantern-part-1-0"));
  EXPECT_EQ(entries(), 2u);
  remove_leftovers(folder_ / "missing");  // must not throw
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
  make_durable(folder_);
  EXPECT_EQ(syncfs_calls, before + 1);
  expect_io_error("missing", "No such file", [&] { make_durable(folder_ / "missing"); });
  syncfs_error = EIO;
  expect_io_error(folder_.filename().string(), "Input/output", [&] { make_durable(folder_); });
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

}  // namespace
}  // namespace lantern
