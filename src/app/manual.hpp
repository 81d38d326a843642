// Manual pages, in the macros of man(7).
#pragma once

#include <string>

#include "app/command_words.hpp"

namespace lantern::app {

// "lantern.1", "lantern-bench-step.1"
std::string manual_file(const CommandPath& path);

// The page of one command, or of the program itself; `root` is the whole table.
std::string manual_page(const CommandPath& path, const CommandWords& root);

}  // namespace lantern::app
