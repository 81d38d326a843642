#include "app/json_members.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "app/selection.hpp"
#include "app/terminal.hpp"
#include "base/printable.hpp"
#include "render/renderer.hpp"

namespace lantern::app {

using Json = nlohmann::json;

namespace {

// Lantern's own are less deep; the rest is read, and dropped.
bool is_near(int depth, Json::parse_event_t, const Json&) {
  constexpr int kDeepest = 8;
  return depth <= kDeepest;
}

}  // namespace

JsonMembers::JsonMembers(std::string_view text)
    : json_(std::make_shared<const Json>(Json::parse(text.begin(), text.end(), is_near, false))) {
  if (!json_->is_object()) throw RefusedFile("it is no JSON object, or it is damaged");
}

const Json& JsonMembers::at(const char* member) const {
  const auto found = json_->find(member);
  if (found == json_->end()) throw RefusedFile(fmt::format("{}{} is missing", place_, member));
  return *found;
}

void JsonMembers::refuse(const char* member, std::string_view must) const {
  constexpr std::size_t kMostShown = 60;
  // What is no UTF-8 becomes U+FFFD.
  std::string value = at(member).dump(-1, ' ', true, Json::error_handler_t::replace);
  if (value.size() > kMostShown) value = value.substr(0, kMostShown) + "…";
  throw RefusedFile(fmt::format("{}{} is {}: {}", place_, member, value, must));
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
    const auto [width, height] = parse_size(size, Renderer::kMostPixels);
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
  std::vector<std::string> names;
  for (const auto& [name, value] : json_->items()) names.push_back(name);
  return names;
}

void require_as_written(std::string_view file, std::string_view written) {
  if (file == written) return;
  constexpr std::size_t kMostShown = 120;
  const auto here = std::ranges::mismatch(file, written).in1;
  const auto line = 1 + std::count(file.begin(), here, '\n');
  const std::size_t start = file.rfind('\n', static_cast<std::size_t>(here - file.begin()));
  std::string_view text = file.substr(start == file.npos ? 0 : std::min(start + 1, file.size()));
  text = text.substr(0, std::min(text.find('\n'), kMostShown));
  throw RefusedFile(fmt::format("line {} is not as Lantern writes it: {}", line, printable(text)));
}

}  // namespace lantern::app
