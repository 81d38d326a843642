// Runs the program as a user would: words in, exit code and both streams out.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fresh_folder.hpp"

namespace lantern::app {

struct Outcome {
  int code = -1;    // exit code; 128 + number for a signal
  std::string out;  // standard output
  std::string err;  // standard error
};

// A shell command. Words in it:
//   lantern WORDS...   the program under test
//   unread COMMAND...  with a standard output that nobody reads any more
//   begin WORDS...     the program in the background, its messages where "begin" sends them
//   until_so CONDITION waits until this command succeeds, or the program has ended, which fails
//   interrupt          sends SIGINT to what was begun, and ends with its exit code
Outcome shell(const std::string& command);

void write_text(const std::filesystem::path& path, const std::string& text);
std::string read_text(const std::filesystem::path& path);

// The path of a file of the repository.
std::filesystem::path repository(const std::string& path);

// README.md, and then the pages that it leads to, each once.
std::vector<std::string> pages();

// The file of a scenario that comes with Lantern.
std::string scenario(const std::string& name);
// Eight frames that stay as they are, whatever becomes of the course's.
inline const std::string kGhosts = LANTERN_ROOT "/tests/app/ghost_quadtree.toml";

}  // namespace lantern::app
