#include "app/folders/frame_folder.hpp"

#include <limits>

#include <fmt/format.h>

#include "app/folders/kept_files.hpp"
#include "app/output/render_job.hpp"
#include "base/error.hpp"
#include "base/hash.hpp"
#include "base/json_writer.hpp"
#include "base/number.hpp"
#include "base/printable.hpp"
#include "draw/theme.hpp"
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
  return std::ranges::all_of(text, [](char c) { return '0' <= c && c <= '9'; });
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

// Was the folder's last run made by this very build? Two builds of one version may draw
// differently. False if the manifest is missing, damaged or cannot be read; as to_json() writes it:
// within a text of the file, a quote has a backslash before it.
bool is_of_this_build(const Folder& folder) try {
  const auto manifest = folder.read(kManifest, kMostFrameBytes);
  return manifest &&
         manifest->find(fmt::format("\n\"sources\": \"{}\"", kSourceHash)) != std::string::npos;
} catch (const IoError&) {
  return false;
}

constexpr const char* kManifestFormat = "lantern.manifest/2";
constexpr std::string_view kFactsFormat = "lantern.frame/";
constexpr std::uint64_t kMostWhole = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint64_t kMostIndex = std::numeric_limits<std::uint32_t>::max();

// A frame's entry, whose files must be those of that frame.
ListedFrame read_frame(const JsonMembers& json, const Manifest& m, std::uint32_t index) {
  json.is("file", frame_file(m.scenario, index, m.format));
  json.is("facts", frame_file(m.scenario, index, FileKind::json));
  ListedFrame frame{.step = static_cast<std::uint32_t>(json.whole("step", 0, kMostIndex)),
                    .event = json.text("event"),
                    .time = json.number("time"),
                    .caption = json.text("caption"),
                    .hash = json.hash("hash")};
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
  return is_frame_file(file, scenario) ? number_in<std::uint32_t>(*part_of(file, scenario))
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

FrameFolder::FrameFolder(const Folder& output, const Manifest& wanted, bool whole)
    : folder_(output.inside(wanted.scenario.text())), wanted_(wanted), lock_(folder_) {
  require_kept_for(KeptFor::frames, folder_);
  require_writable({folder_, kManifest});
  folder_.remove_leftovers();
  if (is_foreign(folder_, kManifest)) strange_.push_back(kManifest);
  const bool same_build = is_of_this_build(folder_);
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
    standing_.insert(name);
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

void FrameFolder::tell_of_strange(const std::set<std::string>& written) const {
  std::vector<std::string> left, replaced;
  for (const std::string& name : strange_)
    (written.contains(name) ? replaced : left).push_back(name);
  const std::string& scenario = wanted_.scenario.text();
  if (!left.empty())
    warn(about_files(scenario, "left alone, since it is not as Lantern made it", left));
  if (!replaced.empty())
    warn(about_files(scenario, "replaced, though it was not as Lantern made it", replaced));
}

bool FrameFolder::is_wanted(const std::string& name, FileKind kind, const MadeFrom& found,
                            bool whole) const {
  const std::string_view part = *part_of(name, wanted_.scenario.text());
  MadeFrom now;
  const std::size_t bar = part.find('_');
  if (part == kAtlas) {
    now = wanted_.atlas_from();
  } else {
    const auto index = number_in<std::uint32_t>(part.substr(0, bar));
    if (!index) return false;
    if (bar != part.npos) {
      const auto number = number_in<std::uint64_t>(part.substr(bar + 1));
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

std::uint64_t FrameFolder::in_betweens_standing(std::uint32_t index) const {
  const std::string start = fmt::format("{}_{:04}_", wanted_.scenario.text(), index);
  return static_cast<std::uint64_t>(std::ranges::count_if(
      standing_, [&](const std::string& file) { return file.starts_with(start); }));
}

bool FrameFolder::stands(std::uint32_t index, FileKind kind) const {
  return stands(frame_file(wanted_.scenario, index, kind));
}

std::string to_json(const Manifest& m) {
  JsonWriter json;
  json.begin_object().lines(
      "format", kManifestFormat, "scenario", m.scenario.text(), "title", m.title, "version",
      kVersion, "sources", kSourceHash, "scenario_hash", fmt::format("{:016x}", m.scenario_hash),
      "seed", m.seed, "pace", word_for(m.pace, kPaces), "size", m.size, "theme", m.theme,
      "facts_format", fmt::format("{}{}", kFactsFormat, kFactsVersion), "picture_format",
      word_for(m.format, kPictureKinds), "png", word_for(m.png, kPngEfforts), "transparent",
      m.transparent, "finished", m.finished, "expectations", m.expectations, "unmet", m.unmet);
  json.line().member("switches", m.switches);
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
  json.is("format", kManifestFormat);
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
