// manifest.json, written and read back.
#include <limits>

#include "app/frame_folder.hpp"
#include "app/in_betweens.hpp"
#include "app/json_members.hpp"
#include "base/json_writer.hpp"
#include "base/printable.hpp"
#include "draw/theme.hpp"
#include "embedded/version.hpp"

namespace lantern::app {
namespace {

constexpr const char* kFormat = "lantern.manifest/2";
constexpr std::string_view kFactsFormat = "lantern.frame/";
constexpr std::uint64_t kMostWhole = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint64_t kMostIndex = std::numeric_limits<std::uint32_t>::max();

// A frame's entry, whose files must be those of that frame.
ListedFrame read_frame(const JsonMembers& json, const Manifest& m, std::uint32_t index) {
  json.is("file", frame_file(m.scenario, index, m.format));
  json.is("facts", frame_file(m.scenario, index, FileKind::json));
  ListedFrame frame;
  frame.step = static_cast<std::uint32_t>(json.whole("step", 0, kMostIndex));
  frame.event = json.text("event");
  frame.time = json.number("time");
  frame.caption = json.text("caption");
  frame.hash = json.hash("hash");
  if (!m.in_betweens.empty())
    frame.in_betweens = json.whole("in_betweens", 0, InBetweens::kMostPictures);
  return frame;
}

void read_frames(const JsonMembers& json, Manifest& m) {
  std::uint64_t pictures = 0;
  for (const JsonMembers& one : json.objects("frames")) {
    const auto index = static_cast<std::uint32_t>(one.whole("frame", 0, kMostIndex));
    ListedFrame frame = read_frame(one, m, index);
    pictures += frame.in_betweens;
    if (pictures > InBetweens::kMostPictures)
      one.refuse("in_betweens", "there are too many of them in all");
    if (!m.frames.emplace(index, std::move(frame)).second)
      one.refuse("frame", "it is listed before");
  }
}

}  // namespace

std::string to_json(const Manifest& m) {
  JsonWriter json;
  json.begin_object().lines(
      "format", kFormat, "scenario", m.scenario.text(), "title", m.title, "version", kVersion,
      "sources", kSourceHash, "scenario_hash", fmt::format("{:016x}", m.scenario_hash), "seed",
      m.seed, "pace", word_for(m.pace, kPaces), "size", m.size, "theme", m.theme, "facts_format",
      fmt::format("{}{}", kFactsFormat, kFactsVersion), "picture_format",
      word_for(m.format, kPictureKinds), "png", word_for(m.png, kPngEfforts), "transparent",
      m.transparent, "finished", m.finished, "expectations", m.expectations, "unmet", m.unmet);
  json.line().key("switches").begin_array();
  for (const std::string& name : m.switches) json.value(name);
  json.end_array();
  if (!m.in_betweens.empty()) json.line().member("tween", m.in_betweens);
  json.line().key("frames").begin_array();
  for (const auto& [index, frame] : m.frames) {
    json.line().begin_object().members(
        "frame", index, "file", frame_file(m.scenario, index, m.format), "facts",
        frame_file(m.scenario, index, FileKind::json), "step", frame.step, "event", frame.event,
        "time", frame.time, "caption", frame.caption, "hash", fmt::format("{:016x}", frame.hash));
    if (!m.in_betweens.empty()) json.member("in_betweens", frame.in_betweens);
    json.end_object();
  }
  json.line().end_array().line().end_object();
  return json.text() + "\n";
}

Manifest read_manifest(std::string_view text) {
  const JsonMembers json(text);
  json.is("format", kFormat);
  json.is("version", kVersion);
  json.is("sources", kSourceHash);
  Manifest m(json.scenario_name("scenario"));
  m.title = json.text("title");
  if (!is_printable(m.title)) json.refuse("title", "no scenario has such a title");
  m.seed = json.whole("seed", 0, kMostWhole);
  m.pace = json.word<Pace>("pace", kPaces);
  m.size = json.picture_size("size");
  m.theme = json.text("theme");
  if (!theme_named(m.theme)) json.refuse("theme", "there is no such theme");
  m.format = json.word<FileKind>("picture_format", kPictureKinds);
  m.png = json.word<PngEffort>("png", kPngEfforts);
  json.is("facts_format", fmt::format("{}{}", kFactsFormat, kFactsVersion));
  m.transparent = json.flag("transparent");
  m.finished = json.flag("finished");
  m.expectations = json.whole("expectations", 0, kMostWhole);
  m.unmet = json.whole("unmet", 0, kMostWhole);
  m.switches = json.texts("switches");
  if (json.has("tween")) m.in_betweens = json.text("tween");
  m.scenario_hash = json.hash("scenario_hash");
  read_frames(json, m);
  require_as_written(text, to_json(m));
  return m;
}

}  // namespace lantern::app
