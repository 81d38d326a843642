// Other programs of the machine.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace lantern {

// The file that the shell would run by this name, from PATH.
std::optional<std::filesystem::path> find_program(std::string_view name);

}  // namespace lantern
