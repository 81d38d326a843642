#include "app/frame_folder.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "app/terminal.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/json_writer.hpp"
#include "embedded/version.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kAtlas = "atlas";

fs::path made(const fs::path& path) {
  make_folder(path);
  return path;
}

std::optional<FileKind> kind_of(std::string_view ending) {
  if (ending == "png") return FileKind::png;
  if (ending == "svg") return FileKind::svg;
  if (ending == "json") return FileKind::json;
  return std::nullopt;
}

bool are_digits(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return '0' <= c && c <= '9'; });
}

// What stands between "<scenario>_" and the ending: a frame's number of at least four digits, that
// and an in-between's of at least two, or "atlas". Nothing for files that are none of ours by their
// name.
std::optional<std::string_view> part_of(std::string_view name, const std::string& scenario) {
  if (!name.starts_with(scenario + "_")) return std::nullopt;
  name.remove_prefix(scenario.size() + 1);
  const std::string_view part = name.substr(0, name.find('.'));
  const std::size_t bar = std::min(part.find('_'), part.size());
  const bool is_frame = bar >= 4 && are_digits(part.substr(0, bar));
  const bool is_between = bar + 3 <= part.size() && are_digits(part.substr(bar + 1));
  const bool is_ours = part == kAtlas || (is_frame && (bar == part.size() || is_between));
  return is_ours ? std::optional(part) : std::nullopt;
}

// All of the text, or nothing.
template <class Number>
std::optional<Number> number_of(std::string_view text) {
  Number number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole ? std::optional(number) : std::nullopt;
}

// Frames of version 0.1.0 have no seal, but a PNG says who wrote it, and facts have a format. One
// whose seal is broken is not of that version.
bool is_of_the_first_version(FileKind kind, std::string_view bytes) {
  const auto has = [&](std::string_view text) { return bytes.find(text) != bytes.npos; };
  if (kind == FileKind::png)
    return has(std::string_view("tEXtSoftware\0Lantern 0.1.0", 26)) && !has("Made from");
  return kind == FileKind::json && bytes.substr(0, 64).find("\"lantern.") != bytes.npos &&
         bytes.ends_with("\n}\n") && !has("\"made_from\"");
}

std::string text_of(const Hash& hash) { return fmt::format("{:016x}", hash.value()); }

Hash facts_of(const Manifest& m) {
  return Hash().add(kVersion).add(m.scenario).add(m.scenario_hash).add(m.pace).add(m.facts);
}

// `png`, the effort of encoding, counts only where it shows.
Hash style_of(const Manifest& m) {
  Hash hash = Hash().add(m.theme).add(m.format).add(std::uint64_t{m.transparent});
  if (m.format == "png") hash.add(m.png);
  for (const std::string& name : m.switches) hash.add(name);
  return hash;
}

}  // namespace

MadeFrom Manifest::frame_from(std::uint32_t index) const {
  return {text_of(facts_of(*this).add(std::uint64_t{index})),
          text_of(style_of(*this).add(size).add(std::uint64_t{index}))};
}

MadeFrom Manifest::in_between_from(std::uint32_t index, std::uint64_t number) const {
  const auto of = [&](Hash hash) {
    return text_of(hash.add(in_betweens).add(std::uint64_t{index}).add(number));
  };
  return {of(facts_of(*this)), of(style_of(*this).add(size))};
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

std::optional<std::uint32_t> frame_of(std::string_view file, const std::string& scenario) {
  const auto part = part_of(file, scenario);
  const std::size_t dot = file.find('.');
  if (!part || dot == file.npos || !kind_of(file.substr(dot + 1))) return std::nullopt;
  return number_of<std::uint32_t>(*part);
}

bool is_as_made(std::string_view file, std::string_view bytes) {
  const auto kind = kind_of(file.substr(file.find('.') + 1));
  return kind && made_from(*kind, bytes);
}

std::string about_files(const std::string& scenario, const char* what,
                        const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i)
    text += (i > 0 ? ", " : "") + names[i];
  if (names.size() > kMost) text += fmt::format(" and {} more", names.size() - kMost);
  return fmt::format("{}: {}: {}", scenario, what, text);
}

std::string atlas_file(const std::string& scenario, std::string_view ending) {
  return fmt::format("{}_{}.{}", scenario, kAtlas, ending);
}

std::string in_between_file(const Manifest& m, std::uint32_t index, std::uint64_t number) {
  return fmt::format("{}_{:04}_{:0{}}.{}", m.scenario, index, number, m.in_between_digits,
                     m.format);
}

std::string to_json(const Manifest& m) {
  JsonWriter json;
  json.begin_object().lines(
      "format", "lantern.manifest/2", "scenario", m.scenario, "title", m.title, "version", kVersion,
      "sources", kSourceHash, "scenario_hash", fmt::format("{:016x}", m.scenario_hash), "seed",
      m.seed, "pace", m.pace, "size", m.size, "theme", m.theme, "facts_format",
      "lantern.frame/" + m.facts, "picture_format", m.format, "png", m.png, "transparent",
      m.transparent, "finished", m.finished, "expectations", m.expectations, "unmet", m.unmet);
  json.line().key("switches").begin_array();
  for (const std::string& name : m.switches) json.value(name);
  json.end_array();
  if (!m.in_betweens.empty()) json.line().member("tween", m.in_betweens);
  json.line().key("frames").begin_array();
  for (const auto& [index, frame] : m.frames) {
    json.line().begin_object().members(
        "frame", index, "file", frame_file(m.scenario, index, m.format), "facts",
        frame_file(m.scenario, index, "json"), "step", frame.step, "event", frame.event, "time",
        frame.time, "caption", frame.caption, "hash", fmt::format("{:016x}", frame.hash));
    if (!m.in_betweens.empty()) json.member("in_betweens", frame.in_betweens);
    json.end_object();
  }
  json.line().end_array().line().end_object();
  return json.text() + "\n";
}

FrameFolder::FrameFolder(const fs::path& path, const Manifest& wanted, bool whole)
    : path_(made(path)), wanted_(wanted), lock_(path_) {
  remove_leftovers(path_);
  const bool same_build = is_of_this_build(path_ / "manifest.json");
  std::set<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(path_, error), end; !error && it != end; it.increment(error))
    names.insert(it->path().filename().string());
  for (const std::string& name : names) look_at(name, same_build, whole);
}

void FrameFolder::look_at(const std::string& name, bool same_build, bool whole) {
  if (!part_of(name, wanted_.scenario)) return;
  const std::string ending = name.substr(name.find('.') + 1);
  const auto kind = kind_of(ending);
  if (!kind) return;
  std::string bytes;
  try {
    constexpr std::size_t kMostBytes = std::size_t{1} << 30;
    bytes = read_file(path_ / name, kMostBytes);
  } catch (const IoError&) {
    strange_.push_back(name);
    return;
  }
  const std::optional<MadeFrom> found = made_from(*kind, bytes);
  if (!found && !is_of_the_first_version(*kind, bytes)) {
    strange_.push_back(name);
  } else if (found && same_build && is_wanted(name, ending, *found, whole)) {
    standing_[name] = *found;
  } else {
    std::error_code ignored;  // what is written later says so if nothing can be
    if (fs::remove(path_ / name, ignored)) removed_.push_back(name);
  }
}

bool FrameFolder::is_wanted(const std::string& name, std::string_view ending, const MadeFrom& found,
                            bool whole) const {
  const std::string_view part = *part_of(name, wanted_.scenario);
  MadeFrom now;
  const std::size_t bar = part.find('_');
  if (part == kAtlas) {
    now = wanted_.atlas_from();
  } else {
    const auto index = number_of<std::uint32_t>(part.substr(0, bar));
    if (!index) return false;
    if (bar != part.npos) {
      const auto number = number_of<std::uint64_t>(part.substr(bar + 1));
      return number && ending == wanted_.format &&
             name == in_between_file(wanted_, *index, *number) &&
             found == wanted_.in_between_from(*index, *number);
    }
    if (name != frame_file(wanted_.scenario, *index, ending)) return false;
    now = wanted_.frame_from(*index);
  }
  if (ending == wanted_.format || (part == kAtlas && ending == "json")) return found == now;
  return found.facts == now.facts && (ending == "json" || !whole);
}

fs::path FrameFolder::file(std::uint32_t index, std::string_view ending) const {
  return path_ / frame_file(wanted_.scenario, index, ending);
}

fs::path FrameFolder::in_between(std::uint32_t index, std::uint64_t number) const {
  return path_ / in_between_file(wanted_, index, number);
}

bool FrameFolder::in_between_stands(std::uint32_t index, std::uint64_t number) const {
  return standing_.contains(in_between(index, number).filename().string());
}

std::uint64_t FrameFolder::in_betweens_standing(std::uint32_t index) const {
  const std::string start = fmt::format("{}_{:04}_", wanted_.scenario, index);
  return static_cast<std::uint64_t>(std::ranges::count_if(
      standing_, [&](const auto& file) { return file.first.starts_with(start); }));
}

fs::path FrameFolder::atlas(std::string_view ending) const {
  return path_ / atlas_file(wanted_.scenario, ending);
}

bool FrameFolder::stands(std::uint32_t index, std::string_view ending) const {
  return standing_.contains(frame_file(wanted_.scenario, index, ending));
}

bool FrameFolder::atlas_stands(std::string_view ending) const {
  return standing_.contains(atlas(ending).filename().string());
}

}  // namespace lantern::app
