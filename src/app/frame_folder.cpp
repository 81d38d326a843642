#include "app/frame_folder.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include <fmt/format.h>

#include "app/kept_files.hpp"
#include "app/terminal.hpp"
#include "base/error.hpp"
#include "base/hash.hpp"
#include "embedded/version.hpp"

namespace lantern::app {
namespace {

constexpr std::string_view kAtlas = "atlas";
constexpr std::size_t kMostFrameBytes = std::size_t{1} << 30;

constexpr std::pair<std::string_view, FileKind> kFileKinds[] = {
    {"png", FileKind::png}, {"svg", FileKind::svg}, {"json", FileKind::json}};

// By the ending of a file's name.
std::optional<FileKind> kind_of(std::string_view file) {
  const std::size_t dot = std::min(file.find('.'), file.size() - 1);
  for (const auto& [ending, kind] : kFileKinds)
    if (file.substr(dot + 1) == ending) return kind;
  return std::nullopt;
}

bool are_digits(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return '0' <= c && c <= '9'; });
}

// What stands between "<scenario>_" and the ending: a frame's number of at least four digits, that
// and an in-between's of at least two, or "atlas". Nothing for files that are none of ours by their
// name.
std::optional<std::string_view> part_of(std::string_view name, std::string_view scenario) {
  if (!name.starts_with(std::string(scenario) + "_")) return std::nullopt;
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
  return Hash()
      .add(kVersion)
      .add(m.scenario.text())
      .add(m.scenario_hash)
      .add(word_for(m.pace, kPaces))
      .add(kFactsVersion);
}

// `png`, the effort of encoding, counts only where it shows.
Hash style_of(const Manifest& m) {
  Hash hash = Hash().add(m.theme).add(word_for(m.format, kPictureKinds));
  hash.add(std::uint64_t{m.transparent});
  if (m.format == FileKind::png) hash.add(word_for(m.png, kPngEfforts));
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

std::string frame_file(const ScenarioName& scenario, std::uint32_t index, FileKind kind) {
  return fmt::format("{}_{:04}.{}", scenario.text(), index, word_for(kind, kFileKinds));
}

bool is_frame_file(std::string_view file, std::string_view scenario) {
  return part_of(file, scenario) && kind_of(file);
}

std::optional<std::uint32_t> frame_of(std::string_view file, std::string_view scenario) {
  return is_frame_file(file, scenario) ? number_of<std::uint32_t>(*part_of(file, scenario))
                                       : std::nullopt;
}

bool is_as_made(std::string_view file, std::string_view bytes) {
  const auto kind = kind_of(file);
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

std::string atlas_file(const ScenarioName& scenario, FileKind kind) {
  return fmt::format("{}_{}.{}", scenario.text(), kAtlas, word_for(kind, kFileKinds));
}

std::string in_between_file(const Manifest& m, std::uint32_t index, std::uint64_t number) {
  return fmt::format("{}_{:04}_{:0{}}.{}", m.scenario.text(), index, number, m.in_between_digits,
                     word_for(m.format, kFileKinds));
}

namespace {

// The text of the folder's manifest; empty if it is missing or cannot be read.
std::string manifest_in(const Folder& folder) try {
  return folder.read(kManifest, kMostFrameBytes).value_or("");
} catch (const IoError&) {
  return {};
}

// Was the folder's last run made by this very build? Two builds of one version may draw
// differently. False if the manifest is missing or damaged; as to_json() writes it: within a text
// of the file, a quote has a backslash before it.
bool is_of_this_build(std::string_view manifest) {
  return manifest.find(fmt::format("\n\"sources\": \"{}\"", kSourceHash)) != manifest.npos;
}

}  // namespace

FrameFolder::FrameFolder(const Folder& output, const Manifest& wanted, bool whole)
    : folder_(output.inside(wanted.scenario.text())), wanted_(wanted), lock_(folder_) {
  require_kept_for(KeptFor::frames, folder_);
  require_writable({folder_, kManifest});
  folder_.remove_leftovers();
  if (is_foreign(folder_, kManifest)) strange_.push_back(kManifest);
  const bool same_build = is_of_this_build(manifest_in(folder_));
  for (const std::string& name : folder_.names()) look_at(name, same_build, whole);
}

void FrameFolder::look_at(const std::string& name, bool same_build, bool whole) {
  if (!is_frame_file(name, wanted_.scenario.text())) return;
  const FileKind kind = *kind_of(name);
  std::string bytes;
  try {
    bytes = folder_.read(name, kMostFrameBytes).value_or("");
  } catch (const IoError&) {
    strange_.push_back(name);
    return;
  }
  const std::optional<MadeFrom> found = made_from(kind, bytes);
  if (!found && !is_of_the_first_version(kind, bytes)) {
    strange_.push_back(name);
  } else if (found && same_build && is_wanted(name, kind, *found, whole)) {
    standing_[name] = *found;
  } else {
    old_.push_back(name);
  }
}

void FrameFolder::remove_old() const {
  std::vector<std::string> removed;
  for (const std::string& name : old_)
    if (folder_.remove(name)) removed.push_back(name);
  if (!removed.empty())
    say(about_files(wanted_.scenario.text(), "removed what an earlier run has left", removed));
}

bool FrameFolder::is_wanted(const std::string& name, FileKind kind, const MadeFrom& found,
                            bool whole) const {
  const std::string_view part = *part_of(name, wanted_.scenario.text());
  MadeFrom now;
  const std::size_t bar = part.find('_');
  if (part == kAtlas) {
    now = wanted_.atlas_from();
  } else {
    const auto index = number_of<std::uint32_t>(part.substr(0, bar));
    if (!index) return false;
    if (bar != part.npos) {
      const auto number = number_of<std::uint64_t>(part.substr(bar + 1));
      return number && kind == wanted_.format &&
             name == in_between_file(wanted_, *index, *number) &&
             found == wanted_.in_between_from(*index, *number);
    }
    if (name != frame_file(wanted_.scenario, *index, kind)) return false;
    now = wanted_.frame_from(*index);
  }
  const bool is_json = kind == FileKind::json;
  if (kind == wanted_.format || (part == kAtlas && is_json)) return found == now;
  return found.facts == now.facts && (is_json || !whole);
}

bool FrameFolder::in_between_stands(std::uint32_t index, std::uint64_t number) const {
  return stands(in_between_file(wanted_, index, number));
}

std::uint64_t FrameFolder::in_betweens_standing(std::uint32_t index) const {
  const std::string start = fmt::format("{}_{:04}_", wanted_.scenario.text(), index);
  return static_cast<std::uint64_t>(std::ranges::count_if(
      standing_, [&](const auto& file) { return file.first.starts_with(start); }));
}

bool FrameFolder::stands(std::uint32_t index, FileKind kind) const {
  return stands(frame_file(wanted_.scenario, index, kind));
}

bool FrameFolder::atlas_stands(FileKind kind) const {
  return stands(atlas_file(wanted_.scenario, kind));
}

}  // namespace lantern::app
