#include "app/process.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

#include <sys/wait.h>
#include <unistd.h>

namespace lantern::app {

namespace fs = std::filesystem;

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

fs::path repository(const std::string& path) { return fs::path(LANTERN_ROOT) / path; }

std::vector<std::string> pages() {
  std::vector<std::string> all = {"README.md"};
  const std::string readme = read_text(repository(all[0]));
  const std::regex link("\\]\\(([A-Za-z0-9_./]+\\.md)\\)");
  for (std::sregex_iterator it(readme.begin(), readme.end(), link), end; it != end; ++it)
    if (std::ranges::find(all, (*it)[1].str()) == all.end()) all.push_back((*it)[1]);
  return all;
}

std::string scenario(const std::string& name) {
  return repository("scenarios/" + name + ".toml").string();
}

Outcome shell(const std::string& command) {
  char base[] = "/tmp/lantern-test-XXXXXX";
  if (::mkdtemp(base) == nullptr) return {};
  const fs::path folder = base;
  // Under the address sanitizer: Mesa keeps some memory until the process ends, which is no leak of
  // ours; the other rooms' tests look for leaks. The rest as in tests/CMakeLists.txt.
  const std::string script =
      "export ASAN_OPTIONS=detect_leaks=0:malloc_context_size=5:"
      "quarantine_size_mb=32\nlantern() { " LANTERN_BINARY
      " \"$@\"; }\n"
      // Of the pipe that it opens the reader has been and gone.
      "unread() { mkfifo " +
      (folder / "pipe").string() + "; : <" + (folder / "pipe").string() + " & exec 5>" +
      (folder / "pipe").string() +
      "; wait; \"$@\" >&5; }\n"
      // Without job control what a shell starts would ignore INT.
      "begin() { env --default-signal=INT " LANTERN_BINARY
      " \"$@\" & program=$!; }\n"
      "until_so() { until eval \"$1\"; do kill -0 $program 2>/dev/null || return 1; sleep 0.01; "
      "done; }\n"
      "interrupt() { kill -INT $program; wait $program; }\n" +
      command + "\n";
  write_text(folder / "script", script);
  const std::string line = "sh " + (folder / "script").string() + " >" + (folder / "out").string() +
                           " 2>" + (folder / "err").string() + " </dev/null";
  const int status = std::system(line.c_str());
  Outcome outcome;
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.out = read_text(folder / "out");
  outcome.err = read_text(folder / "err");
  fs::remove_all(folder);
  return outcome;
}

}  // namespace lantern::app
