#include "app/folders/kept_files.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "app/folders/goldens.hpp"
#include "app/folders/shard.hpp"
#include "app/report_folder.hpp"
#include "app/terminal.hpp"
#include "base/printable.hpp"

namespace lantern::app {

namespace {

using Json = nlohmann::json;

struct Kept {
  const char* list;         // the file that says so
  std::string_view format;  // which its first line has
  KeptFor what;
  const char* words;
};
constexpr std::array kKept = {
    Kept{kManifest, "\"lantern.manifest/", KeptFor::frames, "the frames of a run"},
    Kept{kGoldenList, "lantern.golden_frames/", KeptFor::goldens, "the golden frames"},
    Kept{kShardFile, "\"lantern.shard/", KeptFor::shard, "the frames of a part"},
};

// What stands at the list's name: `unknown` is a link, a folder, a device, an empty file, or one
// that cannot be read, and may be the list all the same.
enum class Standing { nothing, list, other, unknown };

Standing standing(const Folder& folder, const Kept& kept) try {
  constexpr std::size_t kFirst = 200;  // bytes
  const auto start = folder.read(kept.list, kFirst, false);
  if (!start) return Standing::nothing;
  if (start->empty()) return Standing::unknown;
  return start->find(kept.format) != start->npos ? Standing::list : Standing::other;
} catch (const IoError&) {
  return Standing::unknown;
}

bool may_be(Standing found) { return found == Standing::list || found == Standing::unknown; }

// Of whatever scenario: the folder may have been given another name since.
bool is_some_frame(std::string_view file) {
  for (std::size_t end = file.find('_'); end != file.npos; end = file.find('_', end + 1))
    if (is_frame_file(file, file.substr(0, end))) return true;
  return false;
}

std::string lower_ending(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

[[noreturn]] void refuse(const fs::path& file, std::string_view what) {
  throw UsageError("'{}' is {}; name another file", file.string(), what);
}

// Lantern's own are less deep; the rest is read, and dropped.
bool is_near(int depth, Json::parse_event_t, const Json&) {
  constexpr int kDeepest = 8;
  return depth <= kDeepest;
}

}  // namespace

void require_kept_for(KeptFor wanted, const Folder& folder) {
  for (const Kept& kept : kKept) {
    const Standing found = kept.what == wanted ? Standing::nothing : standing(folder, kept);
    if (!may_be(found)) continue;
    const bool can_be_read = found == Standing::list;
    throw UsageError("'{}' {} {}, of which {} tells{}; give another folder", folder.path().string(),
                     can_be_read ? "holds" : "may hold", kept.words, kept.list,
                     can_be_read ? "" : ", which is empty or cannot be read");
  }
}

bool is_foreign(const Folder& folder, const char* list) {
  return folder.has(list) && std::ranges::none_of(kKept, [&](const Kept& kept) {
           return std::string_view(kept.list) == list && standing(folder, kept) == Standing::list;
         });
}

void require_free(const fs::path& file) {
  std::error_code none;
  const fs::path name = file.filename();
  if (fs::is_directory(file, none) || name.empty() || name == "." || name == "..")
    refuse(file, "a folder");
  if (fs::is_other(file, none)) refuse(file, "a device or a pipe");
  if (lower_ending(file) == ".toml") refuse(file, "called as scenarios are");
  if (name == kMeasurement) refuse(file, "called as a measurement is");
  for (const Kept& kept : kKept)
    if (name == kept.list) refuse(file, fmt::format("called as the list of {} is", kept.words));
  if (!fs::is_directory(folder_of(file), none)) return;
  if (is_input(file)) refuse(file, "read by this run, so it cannot be its output");
  const Folder folder(folder_of(file));
  for (const Kept& kept : kKept)
    if (is_some_frame(name.string()) && may_be(standing(folder, kept)))
      refuse(file, fmt::format("called as one of {} there", kept.words));
  constexpr std::string_view kTables[] = {".csv", ".html", ".svg", ".png"};
  const bool is_some_page = std::ranges::find(kTables, lower_ending(name)) != std::end(kTables);
  if (is_some_page && folder.has(kMeasurement) && folder.has(name.string()))
    refuse(file, "one of the tables and pages of a measurement there");
}

JsonMembers::JsonMembers(std::string_view text)
    : json_(std::make_shared<const Json>(Json::parse(text.begin(), text.end(), is_near, false))) {
  if (!json_->is_object()) throw RefusedFile("it is no JSON object, or it is damaged");
}

const Json& JsonMembers::at(const char* member) const {
  const auto found = json_->find(member);
  if (found == json_->end()) throw RefusedFile("{}{} is missing", place_, member);
  return *found;
}

void JsonMembers::refuse(const char* member, std::string_view must) const {
  constexpr std::size_t kMostShown = 60;
  // What is no UTF-8 becomes U+FFFD.
  std::string value = at(member).dump(-1, ' ', true, Json::error_handler_t::replace);
  if (value.size() > kMostShown) value = value.substr(0, kMostShown) + "…";
  throw RefusedFile("{}{} is {}: {}", place_, member, value, must);
}

std::string JsonMembers::text(const char* member) const {
  if (!at(member).is_string()) refuse(member, "it is a text");
  return at(member).get<std::string>();
}

std::vector<std::string> JsonMembers::texts(const char* member) const {
  std::vector<std::string> texts;
  const Json& list = at(member);
  if (!list.is_array()) refuse(member, "it is a list of texts");
  for (const Json& one : list) {
    if (!one.is_string()) refuse(member, "it is a list of texts");
    texts.push_back(one.get<std::string>());
  }
  return texts;
}

double JsonMembers::number(const char* member) const {
  if (!at(member).is_number() || !std::isfinite(at(member).get<double>()))
    refuse(member, "it is a finite number");
  return at(member).get<double>();
}

bool JsonMembers::flag(const char* member) const {
  if (!at(member).is_boolean()) refuse(member, "it is true or false");
  return at(member).get<bool>();
}

std::uint64_t JsonMembers::whole(const char* member, std::uint64_t least,
                                 std::uint64_t most) const {
  const Json& json = at(member);
  const bool fits = json.is_number_unsigned() && json.get<std::uint64_t>() >= least &&
                    json.get<std::uint64_t>() <= most;
  if (!fits) refuse(member, fmt::format("it is a whole number from {} to {}", least, most));
  return json.get<std::uint64_t>();
}

std::uint64_t JsonMembers::hash(const char* member) const {
  const std::string digits = text(member);
  std::uint64_t hash = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, hash, 16);
  if (digits.size() != 16 || error != std::errc() || stop != end)
    refuse(member, "it is a hash of 16 hexadecimal digits");
  return hash;
}

ScenarioName JsonMembers::scenario_name(const char* member) const {
  const std::optional<ScenarioName> name = ScenarioName::of(text(member));
  if (!name) refuse(member, "a scenario's name is 1 to 64 of a–z, 0–9 and _");
  return *name;
}

std::string JsonMembers::picture_size(const char* member) const {
  const std::string size = text(member);
  try {
    const auto [width, height] = parse_size(size, render::kMostSide);
    if (fmt::format("{}x{}", width, height) == size) return size;
  } catch (const UsageError&) {
    // refused below
  }
  refuse(member, "it is a picture's size, as 1600x900");
}

void JsonMembers::is(const char* member, std::string_view text) const {
  if (this->text(member) != text) refuse(member, fmt::format("it is \"{}\"", text));
}

JsonMembers JsonMembers::object(const char* member) const {
  if (!at(member).is_object()) refuse(member, "it is an object");
  return {*this, at(member), fmt::format("{}{}.", place_, member)};
}

std::vector<JsonMembers> JsonMembers::objects(const char* member) const {
  const Json& list = at(member);
  if (!list.is_array()) refuse(member, "it is a list");
  std::vector<JsonMembers> objects;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list[i].is_object()) refuse(member, "it is a list of objects");
    objects.push_back({*this, list[i], fmt::format("{}{}[{}].", place_, member, i)});
  }
  return objects;
}

std::vector<std::string> JsonMembers::names() const {
  return mapped(json_->items(), [](const auto& item) { return item.key(); });
}

void require_as_written(std::string_view file, std::string_view written) {
  if (file == written) return;
  constexpr std::size_t kMostShown = 120;
  const auto here = std::ranges::mismatch(file, written).in1;
  const auto line = 1 + std::count(file.begin(), here, '\n');
  const std::size_t start = file.rfind('\n', static_cast<std::size_t>(here - file.begin()));
  std::string_view text = file.substr(start == file.npos ? 0 : std::min(start + 1, file.size()));
  text = text.substr(0, std::min(text.find('\n'), kMostShown));
  throw RefusedFile("line {} is not as Lantern writes it: {}", line, printable(text));
}

}  // namespace lantern::app
