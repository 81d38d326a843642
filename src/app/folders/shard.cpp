#include "app/folders/shard.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "app/folders/kept_files.hpp"
#include "app/progress.hpp"
#include "app/run_scenario.hpp"
#include "app/terminal.hpp"
#include "base/number.hpp"
#include "base/printable.hpp"
#include "draw/theme.hpp"
#include "embedded/version.hpp"

namespace lantern::app {

std::string Shard::text() const { return fmt::format("{}/{}", number, of); }

std::optional<Shard> parse_shard(const std::string& words) {
  if (words.empty()) return std::nullopt;
  const auto found = two_numbers_in<std::uint32_t>(words, '/');
  if (!found || found->first < 1 || found->first > found->second || found->second > Shard::kMost)
    throw UsageError(
        "--shard {}: give I/N, the I-th of N parts, as 2/4: I from 1 to N, N at most {}", words,
        Shard::kMost);
  return Shard{found->first, found->second};
}

std::uint64_t Part::count(std::uint64_t frames) const {
  return is_none() || frames <= first ? 0 : (frames - first - 1) / nth + 1;
}

std::vector<Part> parts_of(const Shard& shard,
                           const std::vector<std::optional<std::uint64_t>>& frames) {
  constexpr std::uint64_t kPieces = 4;  // a whole scenario is at most this part of a share
  const auto total = sum_of<std::uint64_t>(frames, [](const auto& n) { return n.value_or(0); });
  std::vector<Part> parts(frames.size(), Part{0, 0});
  std::vector<std::size_t> whole;
  std::uint64_t dealt = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i] && *frames[i] <= total / (kPieces * shard.of)) {
      whole.push_back(i);
      continue;
    }
    // The dealing goes on where it stopped, so that remainders do not all fall to the first.
    const std::uint64_t first = (shard.number - 1 + shard.of - dealt % shard.of) % shard.of;
    const Part part{shard.of, first};
    if (!frames[i] || part.count(*frames[i]) > 0) parts[i] = part;
    dealt += frames[i].value_or(0);
  }
  std::vector<std::uint64_t> load(shard.of, dealt / shard.of);
  for (std::uint64_t i = 0; i < dealt % shard.of; ++i) ++load[i];
  std::ranges::stable_sort(whole, std::greater(), [&](std::size_t i) { return *frames[i]; });
  for (const std::size_t i : whole) {
    const auto least = std::ranges::min_element(load);
    *least += *frames[i];
    if (static_cast<std::uint64_t>(least - load.begin()) + 1 == shard.number) parts[i] = Part();
  }
  return parts;
}

std::string command_for(Words words, const Shard& shard) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0 && words[i - 1] == "--shard") words[i] = shard.text();
    if (words[i].starts_with("--shard=")) words[i] = "--shard=" + shard.text();
  }
  return command_text(words);
}

namespace {

constexpr std::string_view kShardFormat = "lantern.shard/1";
constexpr std::string_view kCommand = "render";  // no other is divided
constexpr std::uint64_t kMostFrames = std::numeric_limits<std::uint32_t>::max();

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
    const std::string &first = a.inputs[i].name.text(), &second = b.inputs[i].name.text();
    if (first != second) return differs(fmt::format("input {}", i + 1), first, second);
    if (a.inputs[i].text != b.inputs[i].text)
      return fmt::format("'{}' has another text in the second", first);
  }
  return std::nullopt;
}

// That they are as a run of this program writes them: settings_of().
void require_possible(const JsonMembers& settings) {
  settings.picture_size("size");
  if (!theme_named(settings.text("theme"))) settings.refuse("theme", "there is no such theme");
  settings.word<FileKind>("format", kPictureKinds);
  settings.word<PngEffort>("png", kPngEfforts);
  static constexpr std::pair<std::string_view, bool> kYesOrNo[] = {{"no", false}, {"yes", true}};
  settings.word<bool>("transparent", kYesOrNo);
  if (!settings.text("pace").empty()) settings.word<Pace>("pace", kPaces);
  for (const char* text : {"tween", "switches"}) settings.text(text);
  try {
    Selection(settings.text("frames"), settings.text("at"), std::nullopt);
  } catch (const UsageError& why) {
    settings.refuse("frames", why.what());
  }
  static constexpr std::string_view kAll[] = {"at",          "format", "frames",      "pace",
                                              "png",         "size",   "switches",    "theme",
                                              "transparent", "tween",  "tween digits"};
  for (const std::string& name : settings.names())
    if (std::ranges::find(kAll, name) == std::end(kAll))
      settings.refuse(name.c_str(), "there is no such setting");
}

// How many frames of each are chosen, at most; nothing where only the run can tell.
std::vector<std::optional<std::uint64_t>> chosen_frames(const RenderOptions& options,
                                                        const std::vector<Scenario>& scenarios) {
  std::vector<std::optional<std::uint64_t>> frames;
  for (const Scenario& scenario : scenarios) {
    const auto extent = extent_of(scenario, pace_of(options.pace, scenario)).frames;
    const Selection selection(options.frames, options.at, extent);
    frames.push_back(selection.most() ? selection.most() : extent);
  }
  return frames;
}

// What the folder of one run would depend on: as its manifest says it, and the choice of frames.
std::map<std::string, std::string> settings_of(const RenderJob& job, const Scenario& scenario) {
  const Manifest m = job.manifest(scenario, pace_of(job.options.pace, scenario));
  std::map<std::string, std::string> settings = settings_told_by(m);
  settings["frames"] = job.options.frames;
  settings["at"] = job.options.at;
  settings["pace"] = job.options.pace;
  settings["tween digits"] = std::to_string(m.in_between_digits);
  return settings;
}

}  // namespace

ShardRecord new_record(const Shard& shard) {
  return {shard, std::string(kVersion), std::string(kSourceHash), {}, {}, command_line_words()};
}

std::string to_json(const ShardRecord& r) {
  JsonWriter json;
  json.begin_object().lines("format", kShardFormat, "command", kCommand, "shard", r.shard.number,
                            "of", r.shard.of, "version", r.version, "sources", r.sources,
                            "finished", r.finished);
  json.line().key("settings").begin_object();
  for (const auto& [name, value] : r.settings) json.member(name, value);
  json.end_object().line().member("words", r.words).line().key("inputs").begin_array();
  for (const ShardInput& input : r.inputs)
    json.line().object("name", input.name.text(), "text", input.text, "here", input.here, "chosen",
                       input.chosen, "atlas", input.atlas);
  json.line().end_array().line().end_object();
  return json.text() + "\n";
}

ShardRecord read_record(std::string_view text) {
  const JsonMembers json(text);
  json.is("format", kShardFormat);
  json.is("command", kCommand);
  ShardRecord r;
  r.shard.of = static_cast<std::uint32_t>(json.whole("of", 1, Shard::kMost));
  r.shard.number = static_cast<std::uint32_t>(json.whole("shard", 1, r.shard.of));
  r.version = json.text("version");
  r.sources = json.text("sources");
  r.finished = json.flag("finished");
  const JsonMembers settings = json.object("settings");
  for (const std::string& name : settings.names()) r.settings[name] = settings.text(name.c_str());
  settings.text("frames"), settings.text("at");  // what a merge asks for
  const bool is_ours = r.version == kVersion && r.sources == kSourceHash;
  if (is_ours) require_possible(settings);
  const std::string digits = setting(r, "tween digits");
  if (digits.size() != 1 || digits[0] < '2' || digits[0] > '9')
    settings.refuse("tween digits", "it is a whole number from 2 to 9");
  r.words = json.texts("words");
  if (r.words.empty() || r.words.front() != kCommand)
    json.refuse("words", "they begin with render");
  std::set<std::string> names;
  for (const JsonMembers& one : json.objects("inputs")) {
    one.hash("text");
    const std::uint64_t here = one.whole("here", 0, kMostFrames);
    const std::uint64_t chosen = is_ours ? one.whole("chosen", here, kMostFrames) : here;
    r.inputs.push_back(
        {one.scenario_name("name"), one.text("text"), here, chosen, one.flag("atlas")});
    if (!names.insert(one.text("name")).second) one.refuse("name", "it is listed before");
  }
  if (r.inputs.empty()) json.refuse("inputs", "a run has one or more");
  if (is_ours) require_as_written(text, to_json(r));
  return r;
}

std::map<std::string, std::string> settings_told_by(const Manifest& m) {
  return {{"pace", std::string(word_for(m.pace, kPaces))},
          {"size", m.size},
          {"theme", m.theme},
          {"format", std::string(word_for(m.format, kPictureKinds))},
          {"png", std::string(word_for(m.png, kPngEfforts))},
          {"tween", m.in_betweens},
          {"transparent", m.transparent ? "yes" : "no"},
          {"switches", fmt::format("{}", fmt::join(m.switches, " "))}};
}

std::optional<std::string> contradiction(const Manifest& manifest, const ShardRecord& record) {
  for (const auto& [name, told] : settings_told_by(manifest)) {
    const std::string recorded = setting(record, name);
    const bool is_each_scenarios_own = name == "pace" && recorded.empty();
    if (told != recorded && !is_each_scenarios_own)
      return fmt::format("{} is \"{}\", the record's settings say \"{}\"", name, printable(told),
                         printable(recorded));
  }
  return std::nullopt;
}

int in_between_digits(const ShardRecord& record) {
  return setting(record, "tween digits")[0] - '0';
}

std::optional<std::string> difference(const ShardRecord& a, const ShardRecord& b) {
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

RenderOptions options_of_shard(const RenderOptions& options) {
  const auto shard = parse_shard(options.shard);
  if (!shard) return options;
  if (Destination(options.output, !options.sheet.empty()).kind() != OutputKind::folder)
    throw UsageError(
        "--shard divides a folder of frames, and -o {} is none; make the file "
        "on one machine, without --shard",
        options.output);
  RenderOptions of_shard = options;
  const std::string folder = fmt::format("shard-{}-of-{}", shard->number, shard->of);
  of_shard.output = (fs::path(options.output) / folder).string();
  return of_shard;
}

Folder output_folder(const RenderOptions& options) {
  const fs::path path = options.output;
  const bool is_shard = !options.shard.empty();
  const Folder folder = is_shard ? Folder::made(path.parent_path()).inside(path.filename().string())
                                 : Folder::made(path);
  require_kept_for(is_shard ? KeptFor::shard : KeptFor::frames, folder);
  return folder;
}

RenderShard::RenderShard(const RenderJob& job, const std::vector<Scenario>& scenarios)
    : parts_(scenarios.size()) {
  const auto shard = parse_shard(job.options.shard);
  if (!shard || scenarios.empty()) return;
  parts_ = parts_of(*shard, chosen_frames(job.options, scenarios));
  record_ = new_record(*shard);
  record_.settings = settings_of(job, scenarios.front());
  for (const Scenario& s : scenarios)
    record_.inputs.push_back({name_of(s), fmt::format("{:016x}", s.text_hash)});
  folder_ = output_folder(job.options);
  lock_.emplace(*folder_);
  folder_->remove_leftovers();
  if (is_foreign(*folder_, kShardFile))
    warn(fmt::format("'{}' is replaced, though it was not as Lantern made it",
                     folder_->path(kShardFile).string()));
  write_file({*folder_, kShardFile}, to_json(record_));
}

void RenderShard::drawn(std::size_t scenario, std::uint64_t here, std::uint64_t chosen,
                        bool atlas) {
  if (!folder_) return;
  ShardInput& input = record_.inputs[scenario];
  input.here = here;
  input.chosen = chosen;
  input.atlas = atlas;
}

void RenderShard::finish() {
  if (!folder_) return;
  if (std::ranges::none_of(record_.inputs, [](const ShardInput& i) { return i.here > 0; }))
    say(fmt::format("shard {} is empty: there is too little for {}", record_.shard.text(),
                    record_.shard.of));
  record_.finished = true;
  write_file({*folder_, kShardFile}, to_json(record_));
  folder_->settle();
}

}  // namespace lantern::app
