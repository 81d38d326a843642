// Manual pages, in the macros of man(7), and completions for shells: they say what --help says.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/commands/command.hpp"

namespace lantern::app {

// "lantern.1", "lantern-bench-step.1"
std::string manual_file(const CommandPath& path);

// The page of one of all commands, or of the program itself, the first of them.
std::string manual_page(const CommandPath& path, const std::vector<CommandPath>& all);

// A script for "bash", "zsh" or "fish" that completes commands, options, and what may stand behind
// them; another word is a broken invariant.
std::string completions(std::string_view shell, const std::vector<CommandPath>& all);

}  // namespace lantern::app
