#include "app/manifest.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/json_writer.hpp"
#include "embedded/version.hpp"

namespace lantern {
namespace {

std::string text_of(const Hash& hash) { return fmt::format("{:016x}", hash.value()); }

Hash facts_of(const Manifest& m) {
  return Hash().add(kVersion).add(m.scenario).add(m.scenario_hash).add(m.pace).add(m.facts);
}

// `png`, the effort of encoding, counts only where it shows.
Hash style_of(const Manifest& m) {
  Hash hash = Hash().add(m.theme).add(m.format).add(std::uint64_t{m.transparent});
  if (m.format == "png") hash.add(m.png);
  return hash;
}

}  // namespace

MadeFrom Manifest::frame_from(std::uint32_t index) const {
  return {text_of(facts_of(*this).add(std::uint64_t{index})),
          text_of(style_of(*this).add(size).add(std::uint64_t{index}))};
}

MadeFrom Manifest::atlas_from() const {
  return {text_of(facts_of(*this).add("atlas")), text_of(style_of(*this).add("atlas"))};
}

// As to_json() writes it: within a text of the file, a quote has a backslash before it.
bool is_of_this_build(const std::filesystem::path& manifest) try {
  constexpr std::size_t kMostBytes = 1u << 28;
  const std::string text = read_file(manifest, kMostBytes);
  return text.find(fmt::format("\n\"sources\": \"{}\"", kSourceHash)) != text.npos;
} catch (const IoError&) {
  return false;
}

std::string frame_file(const std::string& scenario, std::uint32_t index, std::string_view ending) {
  return fmt::format("{}_{:04}.{}", scenario, index, ending);
}

std::string to_json(const Manifest& m) {
  JsonWriter json;
  json.begin_object().line().member("format", "lantern.manifest/2");
  json.line().member("scenario", m.scenario).line().member("title", m.title);
  json.line().member("version", kVersion).line().member("sources", kSourceHash);
  json.line().member("scenario_hash", fmt::format("{:016x}", m.scenario_hash));
  json.line().member("seed", m.seed).line().member("pace", m.pace);
  json.line().member("size", m.size).line().member("theme", m.theme);
  json.line().member("facts_format", "lantern.frame/" + m.facts);
  json.line().member("picture_format", m.format).line().member("png", m.png);
  json.line().member("transparent", m.transparent).line().member("finished", m.finished);
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
