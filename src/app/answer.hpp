// What a command answers a program that said --json: one JSON object on standard output, whatever
// happens. Its first member is `format`, "lantern.check/1"; then comes what the command found, as
// far as it came; then `diagnostics`, all errors and warnings, and `exit_code`. Every member is
// told of in scenarios/JSON.md.
#pragma once

#include <string>
#include <string_view>

#include "base/json_writer.hpp"

namespace lantern::app {

// Begins an object with the format of version 1 of a command ("check", "bench.step").
JsonWriter answer_of(std::string_view command);

// What the command found: a whole JSON object whose first member is `format`. It is kept until the
// exit code is known; a later one replaces it.
void answer(std::string object);

// From here on an answer is owed, of this command if it never gives one of its own. Keeps
// diagnostics, and room for the words that there is no memory.
void owe_answer(std::string_view command);
// Standard output is for something else, such as help.
void owe_no_answer() noexcept;

// Writes what is owed, if anything is, and owes nothing any more. Throws as write_stdout does.
void write_answer(int exit_code);
// The same when there is no memory: only that there was none. Needs none; throws nothing.
void write_answer_without_memory() noexcept;

}  // namespace lantern::app
