#include "app/answer.hpp"

#include <utility>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/terminal.hpp"
#include "base/check.hpp"
#include "base/file.hpp"

namespace lantern::app {
namespace {

bool owed = false;
std::string given;       // by the command, or an object with nothing but the format
std::string last_words;  // whole, made while there is memory

void write_text_or_null(JsonWriter& json, const char* key, const std::string& text) {
  json.key(key);
  text.empty() ? json.null() : json.value(text);
}

void write_number_or_null(JsonWriter& json, const char* key, int number) {
  json.key(key);
  number == 0 ? json.null() : json.value(number);
}

// Every member in any case, null where there is nothing to say.
void write(JsonWriter& json, const Diagnostic& d) {
  json.line().begin_object();
  json.member("severity", d.severity == Severity::error ? "error" : "warning");
  write_text_or_null(json, "file", d.where.file);
  write_number_or_null(json, "line", d.where.line);
  write_number_or_null(json, "column", d.where.column);
  json.member("message", d.message);
  write_text_or_null(json, "source_line", d.source_line);
  write_text_or_null(json, "suggestion", d.suggestion);
  json.end_object();
}

// The object with the members that it ends with.
std::string ended(std::string object, const std::vector<Diagnostic>& diagnostics, int exit_code) {
  const std::size_t end = object.find_last_of('}');
  LANTERN_CHECK(end, !=, std::string::npos);
  object.resize(object.find_last_not_of(" \n", end - 1) + 1);
  JsonWriter json;
  json.begin_object().line().key("diagnostics").begin_array();
  for (const Diagnostic& d : diagnostics) write(json, d);
  if (!diagnostics.empty()) json.line();
  json.end_array().line().member("exit_code", exit_code).line().end_object();
  return object + "," + json.text().substr(1) + "\n";
}

}  // namespace

JsonWriter answer_of(std::string_view command) {
  JsonWriter json;
  json.begin_object().line().member("format", fmt::format("lantern.{}/1", command));
  return json;
}

void answer(std::string object) { given = std::move(object); }

void owe_answer(std::string_view command) {
  given = answer_of(command).end_object().text();
  Diagnostic no_memory;
  no_memory.message = "out of memory";
  last_words = ended(given, {no_memory}, kFailed);
  owed = true;
  keep_diagnostics();
}

void owe_no_answer() noexcept { owed = false; }

void write_answer(int exit_code) {
  const bool is_told = exit_code != 0;
  if (!owed || (output_is_input() && is_told)) return;
  const std::string text = ended(given, kept_diagnostics(), exit_code);
  owed = false;
  write_stdout(text);
}

void write_answer_without_memory() noexcept {
  if (!std::exchange(owed, false)) return;
  try {
    write_stdout(last_words);
  } catch (const std::exception&) {  // it has been told that there is no memory
  }
}

}  // namespace lantern::app
