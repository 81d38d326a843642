// manifest.json, read back.
#include <charconv>
#include <utility>

#include <nlohmann/json.hpp>

#include "app/frame_folder.hpp"
#include "embedded/version.hpp"

namespace lantern::app {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kFactsFormat = "lantern.frame/";

// As 16 hexadecimal digits.
std::optional<std::uint64_t> hash_in(const Json& json) {
  const auto& digits = json.get_ref<const std::string&>();
  std::uint64_t hash = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, hash, 16);
  return digits.size() == 16 && error == std::errc() && stop == end ? std::optional(hash)
                                                                    : std::nullopt;
}

bool read_frames(const Json& json, Manifest& m) {
  for (const Json& one : json.at("frames")) {
    ListedFrame frame;
    one.at("step").get_to(frame.step);
    one.at("event").get_to(frame.event);
    one.at("time").get_to(frame.time);
    one.at("caption").get_to(frame.caption);
    if (!m.in_betweens.empty()) one.at("in_betweens").get_to(frame.in_betweens);
    const auto hash = hash_in(one.at("hash"));
    if (!hash) return false;
    frame.hash = *hash;
    m.frames.emplace(one.at("frame").get<std::uint32_t>(), std::move(frame));
  }
  return true;
}

}  // namespace

std::optional<Manifest> read_manifest(std::string_view text) try {
  const Json json = Json::parse(text.begin(), text.end());
  const std::string facts = json.at("facts_format");
  const auto hash = hash_in(json.at("scenario_hash"));
  if (json.at("format") != "lantern.manifest/2" || json.at("version") != kVersion ||
      json.at("sources") != kSourceHash || !facts.starts_with(kFactsFormat) || !hash)
    return std::nullopt;
  Manifest m;
  json.at("scenario").get_to(m.scenario);
  json.at("title").get_to(m.title);
  json.at("seed").get_to(m.seed);
  json.at("pace").get_to(m.pace);
  json.at("size").get_to(m.size);
  json.at("theme").get_to(m.theme);
  json.at("picture_format").get_to(m.format);
  json.at("png").get_to(m.png);
  m.facts = facts.substr(kFactsFormat.size());
  json.at("transparent").get_to(m.transparent);
  json.at("finished").get_to(m.finished);
  json.at("expectations").get_to(m.expectations);
  json.at("unmet").get_to(m.unmet);
  json.at("switches").get_to(m.switches);
  if (json.contains("tween")) json.at("tween").get_to(m.in_betweens);
  m.scenario_hash = *hash;
  return read_frames(json, m) ? std::optional(std::move(m)) : std::nullopt;
} catch (const Json::exception&) {
  return std::nullopt;
}

}  // namespace lantern::app
