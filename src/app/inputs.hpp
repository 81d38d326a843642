// What stands where a command wants scenarios: files, folders of them, and standard input.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lantern::app {

// The files of all words, in their order: a file as it is, "-" for standard input, and of a folder
// every .toml in it, not those of folders below, in the order of a lecture: by `lecture`, those
// without one behind the others, by name. A .toml that is no scenario is left out, with a warning.
// Throws UsageError for standard input named twice and for a folder without scenarios, IoError for
// one that cannot be listed.
std::vector<std::string> input_files(const std::vector<std::string>& words);

// The folder of the scenarios that come with Lantern: scenarios/ here, beside the folder in which
// this program was built, or where an installation has them; nothing if there is none of these.
std::optional<std::filesystem::path> own_scenarios();

// The file of one of them, by its name; looked for in each of these folders. Throws UsageError.
std::string own_scenario(std::string_view name);

}  // namespace lantern::app
