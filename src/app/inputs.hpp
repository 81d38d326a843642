// What stands where a command wants scenarios: files, folders of them, and standard input.
#pragma once

#include <string>
#include <vector>

namespace lantern::app {

// The files of all words, in their order: a file as it is, "-" for standard input, and of a folder
// every .toml in it, not those of folders below, in the order of a lecture: by `lecture`, those
// without one behind the others, by name. A .toml that is no scenario is left out, with a warning.
// Throws UsageError for standard input named twice and for a folder without scenarios, IoError for
// one that cannot be listed.
std::vector<std::string> input_files(const std::vector<std::string>& words);

}  // namespace lantern::app
