// Where scenarios are that come with Lantern, and how one is named without its folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lantern::app {

// The folders that hold Lantern's scenarios, the nearest first: scenarios/ here, beside the program
// (where it is installed: share/lantern/scenarios; where it was built: the repository's), and those
// of $XDG_DATA_DIRS. Only what is there.
std::vector<std::filesystem::path> scenario_folders();

// The file that the user means. A path, a file that is there and "-" are themselves; a bare word
// ("ghost_quadtree") is the scenario of that name in the first of these folders that has it, or a
// problem of that name in problems/ there, and which file that is is said. Throws IoError, with the
// nearest name, if there is none.
std::string scenario_file(const std::string& words);

// The files of all words, in their order: a file as it is, "-" for standard input, and of a folder
// every .toml in it, not those of folders below, in the order of a lecture: by `lecture`, those
// without one behind the others, by name. A .toml that is no scenario is left out, with a warning.
// Throws UsageError for standard input named twice and for a folder without scenarios, IoError for
// one that cannot be listed.
std::vector<std::string> input_files(const std::vector<std::string>& words);

}  // namespace lantern::app
