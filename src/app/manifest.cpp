#include "app/manifest.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/json_writer.hpp"
#include "embedded/version.hpp"

namespace lantern {

std::string Manifest::key() const {
  Hash hash;
  hash.add(kSourceHash).add(scenario_hash).add(pace).add(size).add(theme).add(format).add(png);
  return fmt::format("{:016x}", hash.add(std::uint64_t{transparent}).value());
}

std::string Manifest::facts_key() const {
  return fmt::format("{:016x}", Hash().add(kSourceHash).add(scenario_hash).add(pace).value());
}

std::optional<OldManifest> read_manifest(const std::filesystem::path& file) try {
  constexpr std::size_t kMostBytes = 1u << 28;
  const auto json = nlohmann::json::parse(read_file(file, kMostBytes));
  OldManifest old{json.at("key"), json.at("facts_key"), json.at("finished"), {}};
  for (const auto& frame : json.at("frames")) old.frames.push_back(frame.at("frame"));
  return old;
} catch (const IoError&) {
  return std::nullopt;
} catch (const nlohmann::json::exception&) {
  return std::nullopt;
}

std::string frame_file(const std::string& scenario, std::uint32_t index,
                       const std::string& ending) {
  return fmt::format("{}_{:04}.{}", scenario, index, ending);
}

std::string to_json(const Manifest& m) {
  JsonWriter json;
  json.begin_object().line().member("format", "lantern.manifest/1");
  json.line().member("scenario", m.scenario).line().member("title", m.title);
  json.line().member("version", kVersion).line().member("scenario_hash", m.scenario_hash);
  json.line().member("seed", m.seed).line().member("pace", m.pace);
  json.line().member("size", m.size).line().member("theme", m.theme);
  json.line().member("picture_format", m.format).line().member("png", m.png);
  json.line().member("transparent", m.transparent).line().member("key", m.key());
  json.line().member("facts_key", m.facts_key()).line().member("finished", m.finished);
  json.line().member("expectations", m.expectations).line().member("unmet", m.unmet);
  json.line().key("frames").begin_array();
  for (const auto& [index, frame] : m.frames) {
    json.line().begin_object().member("frame", index);
    json.member("file", frame_file(m.scenario, index, m.format));
    json.member("facts", frame_file(m.scenario, index, "json"));
    json.member("step", frame.step).member("event", frame.event).member("time", frame.time);
    json.member("caption", frame.caption).member("hash", fmt::format("{:016x}", frame.hash));
    json.end_object();
  }
  json.line().end_array().line().end_object();
  return json.text() + "\n";
}

}  // namespace lantern
