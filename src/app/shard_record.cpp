#include "app/shard_record.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"
#include "embedded/version.hpp"

namespace lantern::app {
namespace {

constexpr std::string_view kFormat = "lantern.shard/1";

std::string differs(std::string_view what, std::string_view a, std::string_view b) {
  const auto shown = [](std::string_view value) {
    return value.empty() ? std::string("not given") : std::string(value);
  };
  return fmt::format("{} is {} in the first, {} in the second", what, shown(a), shown(b));
}

std::string setting(const ShardRecord& record, const std::string& name) {
  const auto found = record.settings.find(name);
  return found == record.settings.end() ? "" : found->second;
}

std::optional<std::string> difference_of_inputs(const ShardRecord& a, const ShardRecord& b) {
  if (a.inputs.size() != b.inputs.size())
    return differs("the number of inputs", std::to_string(a.inputs.size()),
                   std::to_string(b.inputs.size()));
  for (std::size_t i = 0; i < a.inputs.size(); ++i) {
    if (a.inputs[i].name != b.inputs[i].name)
      return differs(fmt::format("input {}", i + 1), a.inputs[i].name, b.inputs[i].name);
    if (a.inputs[i].text != b.inputs[i].text)
      return fmt::format("'{}' has another text in the second", a.inputs[i].name);
  }
  return std::nullopt;
}

}  // namespace

ShardRecord new_record(std::string command, const Shard& shard) {
  ShardRecord record;
  record.command = std::move(command);
  record.shard = shard;
  record.version = kVersion;
  record.sources = kSourceHash;
  record.words = command_line_words();
  return record;
}

std::string to_json(const ShardRecord& r) {
  JsonWriter json;
  json.begin_object().lines("format", kFormat, "command", r.command, "shard", r.shard.number, "of",
                            r.shard.of, "version", r.version, "sources", r.sources, "finished",
                            r.finished);
  json.line().key("settings").begin_object();
  for (const auto& [name, value] : r.settings) json.member(name, value);
  json.end_object().line().key("words").begin_array();
  for (const std::string& word : r.words) json.value(word);
  json.end_array().line().key("inputs").begin_array();
  for (const ShardInput& input : r.inputs)
    json.line()
        .begin_object()
        .members("name", input.name, "text", input.text, "here", input.here, "atlas", input.atlas)
        .end_object();
  json.line().end_array().line().end_object();
  return json.text() + "\n";
}

std::optional<ShardRecord> read_record(std::string_view text) try {
  const auto json = nlohmann::json::parse(text.begin(), text.end());
  if (json.at("format") != kFormat) return std::nullopt;
  ShardRecord r;
  json.at("command").get_to(r.command);
  json.at("shard").get_to(r.shard.number);
  json.at("of").get_to(r.shard.of);
  json.at("version").get_to(r.version);
  json.at("sources").get_to(r.sources);
  json.at("finished").get_to(r.finished);
  json.at("settings").get_to(r.settings);
  json.at("words").get_to(r.words);
  for (const auto& one : json.at("inputs")) {
    ShardInput& input = r.inputs.emplace_back();
    one.at("name").get_to(input.name);
    one.at("text").get_to(input.text);
    one.at("here").get_to(input.here);
    one.at("atlas").get_to(input.atlas);
  }
  const Shard& shard = r.shard;
  const bool can_be = 1 <= shard.number && shard.number <= shard.of && shard.of <= Shard::kMost;
  return can_be ? std::optional(std::move(r)) : std::nullopt;
} catch (const nlohmann::json::exception&) {
  return std::nullopt;
}

std::optional<std::string> difference(const ShardRecord& a, const ShardRecord& b) {
  if (a.command != b.command) return differs("the command", a.command, b.command);
  if (a.version != b.version) return differs("the version", a.version, b.version);
  if (a.sources != b.sources) return differs("the program's source hash", a.sources, b.sources);
  if (a.shard.of != b.shard.of)
    return differs("the number of shards", std::to_string(a.shard.of), std::to_string(b.shard.of));
  std::map<std::string, std::string> all = a.settings;
  all.insert(b.settings.begin(), b.settings.end());
  for (const auto& [name, value] : all)
    if (setting(a, name) != setting(b, name))
      return differs("the setting '" + name + "'", setting(a, name), setting(b, name));
  return difference_of_inputs(a, b);
}

ShardFolder::ShardFolder(const std::filesystem::path& path, ShardRecord record)
    : path_(path), record_(std::move(record)) {
  write_file(path_ / kShardFile, to_json(record_));
}

void ShardFolder::finish() {
  if (std::ranges::none_of(record_.inputs, [](const ShardInput& i) { return i.here > 0; }))
    say(fmt::format("shard {} is empty: there is too little for {}", record_.shard.text(),
                    record_.shard.of));
  record_.finished = true;
  write_file(path_ / kShardFile, to_json(record_));
  make_durable(path_);
}

}  // namespace lantern::app
