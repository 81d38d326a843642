// Completions for shells: of commands, options, and what may stand behind them.
#pragma once

#include <string>
#include <string_view>

#include "app/command_words.hpp"

namespace lantern::app {

// A script for "bash", "zsh" or "fish"; another word is a broken invariant.
std::string completions(std::string_view shell, const CommandWords& root);

}  // namespace lantern::app
