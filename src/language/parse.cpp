// A scenario file from its bytes to plain values.
#include <algorithm>
#include <cctype>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/hash.hpp"
#include "language/keys/key.hpp"
#include "language/tables/draft.hpp"

namespace lantern::language {
namespace {

constexpr Place kTop{1, 1};

// "dir/ghosts.toml" is called "ghosts".
std::string stem_of(std::string_view path) {
  const std::string_view name = path.substr(path.rfind('/') + 1);
  const std::size_t dot = name.rfind('.');
  return std::string(name.substr(0, dot == 0 ? name.npos : dot));
}

void read_name(const TableReader& file, const std::string& path, Draft& draft) {
  if (file.has("name")) return;
  const std::string stem = path == kStandardInput ? "stdin" : stem_of(path);
  draft.scenario.name = stem;
  const NamePattern& pattern = *language_table("").find("name")->pattern;
  if (matches(stem, pattern)) return;
  const bool has_some = std::ranges::any_of(stem, [](unsigned char c) { return std::isalnum(c); });
  if (!has_some)
    draft.problems.add(kTop,
                       fmt::format("the file's name {} cannot name a scenario", in_quotes(stem)),
                       "add name = \"…\", or rename the file");
  draft.scenario.name = legal_name(stem, pattern);
  draft.scenario.file_stem = stem;
}

// Can there be those that the file wishes for?
void check_panels(const TableReader& file, Draft& draft) {
  std::size_t i = 0;
  for (const Named& written : file.names("panels"))
    if (const PanelKind& kind = kind_of(draft.scenario.panels[i++]); !kind.possible(draft))
      draft.problems.add(written.where,
                         fmt::format("this scenario cannot have the panel '{}'", written.name),
                         std::string(kind.needs));
}

bool is_blank(std::string_view text) {
  return text.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

// A table or list of tables of a name that there is none of: what is in it is lost, and most other
// mistakes that would be found only follow from that.
bool has_strange_table(const TomlTable& table) {
  return std::ranges::any_of(table, [](const TomlEntry& entry) {
    if (language_table("").find(entry.key) != nullptr) return false;
    const auto* list = std::get_if<TomlArray>(&entry.value.data);
    return std::holds_alternative<TomlTable>(entry.value.data) ||
           (list && !list->empty() && std::holds_alternative<TomlTable>(list->front().data));
  });
}

// A step that repeats stands there as often as it says.
void repeat_steps(TomlTable& file) {
  auto* steps = value_of<TomlArray>(file, "step");
  if (!steps) return;
  TomlArray all;
  for (TomlValue& step : *steps) {
    auto* table = std::get_if<TomlTable>(&step.data);
    const auto* times = table ? value_of<std::int64_t>(*table, "repeat") : nullptr;
    if (times && *times > 1 && *times <= 100) {
      TomlValue again = step;
      std::erase_if(std::get<TomlTable>(again.data), [](const TomlEntry& entry) {
        return entry.key == "ending" || entry.key == "question" || entry.key == "answer" ||
               entry.key == "predict";
      });
      all.insert(all.end(), static_cast<std::size_t>(*times - 1), again);
    }
    all.push_back(std::move(step));
  }
  *steps = std::move(all);
}

void read_all(const TomlTable& table, const std::string& path, Draft& draft) {
  const TableReader file(table, kTop, language_table(""), draft.problems, 0);
  if (has_strange_table(table)) return;
  file.fill(draft.scenario);
  for (const Named& need : file.names("needs"))
    draft.scenario.needs_at.push_back(draft.position(need.where));
  read_name(file, path, draft);
  for (ReadPart* const read : {read_world, read_display, read_bodies, read_links, read_level,
                               read_chart, read_problem, read_atlas, read_script})
    read(file, draft);
  if (draft.has_world) choose_structures(draft);
  check_panels(file, draft);
  check_structures(file, draft);
  if (!draft.problems.any()) notice_idle(file, draft);
}

// What a reading of the file begins with.
void begin(std::string_view text, const std::string& path, Draft& draft) {
  draft.text = without_mark(text);
  draft.scenario.file = path;
  draft.scenario.text = text;
  draft.scenario.text_hash = Hash().add(text).value();
}

Scenario finished(Draft& draft) {
  const Draft* one[] = {&draft};
  if (draft.scenario.panels.empty()) draft.scenario.panels = derived_panels(one);
  return Scenario(std::move(draft.scenario));
}

// A panel that one side has is on the page of all.
void share_panels(std::vector<std::unique_ptr<Draft>>& drafts) {
  if (!drafts[0]->scenario.panels.empty()) return;  // as the file wishes
  const auto all = mapped<const Draft*>(drafts, [](const auto& draft) { return draft.get(); });
  const std::vector<Panel> shared = derived_panels(all);
  for (const auto& draft : drafts) draft->scenario.panels = shared;
}

// The file is read once for each side, as what it says to that one.
Scenario parse_sides(const TomlTable& table, std::string_view text, const std::string& path,
                     Problems& problems) {
  const std::vector<SideFile> files = files_of_sides(table, problems);
  std::vector<std::string> names = mapped(files, &SideFile::name);
  std::vector<std::unique_ptr<Draft>> drafts;
  std::vector<std::pair<std::string, const Problems*>> readings;
  for (const SideFile& side : files) {
    Draft& draft = *drafts.emplace_back(std::make_unique<Draft>());
    begin(text, path, draft);
    draft.scenario.side = side.name;
    draft.scenario.side_title = side.title;
    draft.sides = names;
    read_all(side.file, path, draft);
    readings.emplace_back(side.name, &draft.problems);
  }
  problems.add_readings(readings);
  problems.raise(path, without_mark(text));
  share_panels(drafts);
  ScenarioSpec whole;
  for (const auto& draft : drafts) {
    auto side = std::make_shared<const Scenario>(finished(*draft));
    if (whole.sides.empty()) whole = *side;
    if (side->chart) whole.chart = side->chart;
    if (!whole.sides.empty()) whole.world_steps += side->world_steps;
    whole.sides.push_back(std::move(side));
  }
  whole.side.clear();
  whole.side_title.clear();
  if (whole.chart) whole.chart = chart_of_sides(table, *whole.chart, names);
  whole.noticed = noticed_on(whole.sides);
  Draft all;
  all.scenario = std::move(whole);
  notice_empty_expectations(table, all);
  return Scenario(std::move(all.scenario));
}

// Every index that the spec holds.
class Indices {
 public:
  explicit Indices(const ScenarioSpec& spec) : spec_(spec) {}

  void check() const {
    for (const BodySpec& b : spec_.bodies)
      if (b.brain == Brain::follow) body(b.follows);
    for (const LinkSpec& link : spec_.links) {
      body(link.a);
      if (link.b) body(*link.b);
    }
    for (const BodyMeasureSpec& measure : spec_.body_measures) body(measure.body);
    for (const Step& step : spec_.steps)
      std::visit([&](const auto& verb) { see(verb); }, step.verb);
  }

 private:
  void body(std::size_t i) const { LANTERN_CHECK(i, <, spec_.bodies.size()); }

  // Verbs name bodies, one body, textures, or none.
  void see(const auto& verb) const {
    if constexpr (requires { verb.bodies; })
      for (const std::size_t i : verb.bodies) body(i);
    if constexpr (requires { verb.body; }) body(verb.body);
    if constexpr (requires { verb.textures; })
      for (const std::size_t i : verb.textures) LANTERN_CHECK(i, <, spec_.textures.size());
    if constexpr (std::is_same_v<std::decay_t<decltype(verb)>, Wait>)
      for (const std::size_t i : verb.others) body(i);
  }

  const ScenarioSpec& spec_;
};

}  // namespace

void refuse_size(const std::string& path, std::uint64_t bytes) {
  Diagnostic too_large;
  too_large.where.file = path;
  too_large.message = fmt::format("the file has {} bytes, the limit is {}", bytes, kMostFileBytes);
  too_large.suggestion = "use [[pattern]] for many bodies";
  throw ScenarioError(too_large);
}

Scenario parse_scenario(std::string_view text, const std::string& path) {
  if (text.size() > kMostFileBytes) refuse_size(path, text.size());
  Draft draft;
  begin(text, path, draft);
  TomlTable table;
  if (is_blank(draft.text)) {
    draft.problems.add(kTop, "the file is empty",
                       "a scenario needs at least a title and one step: title = \"…\", then "
                       "[[step]] with do = \"show\"");
  } else {
    table = read_toml(draft.text, draft.problems);
    repeat_steps(table);
    if (entry_of(table, "side") && !draft.problems.any())
      return parse_sides(table, text, path, draft.problems);
    if (!draft.problems.any()) read_all(table, path, draft);
  }
  draft.problems.raise(path, draft.text);
  notice_empty_expectations(table, draft);
  return finished(draft);
}

bool ScenarioSpec::is_quiet(Warning kind) const {
  const std::vector<Warning>& quiet = atlas ? atlas->quiet : world.quiet;
  return std::ranges::find(quiet, kind) != quiet.end();
}

bool ScenarioSpec::has_forces() const {
  return world.gravity != Vec<3>(0.0) || world.gravitation > 0 || !links.empty();
}

bool ScenarioSpec::has_joints() const {
  return std::ranges::any_of(
      links, [](const LinkSpec& link) { return link.kind != LinkSpec::Kind::spring; });
}

bool ScenarioSpec::tells_sleepers() const {
  return has_contacts() || world.may_sleep || structure.split_static;
}

bool ScenarioSpec::has_body_of(BodyKind kind) const {
  return std::ranges::find(bodies, kind, &BodySpec::kind) != bodies.end();
}

bool ScenarioSpec::shows_trails() const {
  return display.trail > 0 || std::ranges::any_of(steps, [](const Step& step) {
           return step.display && step.display->trail > 0;
         });
}

std::vector<const StructureSpec*> ScenarioSpec::structures() const {
  std::vector<const StructureSpec*> all = {&structure};
  for (const Step& step : steps)
    if (const auto* rebuild = std::get_if<Rebuild>(&step.verb)) all.push_back(&rebuild->structure);
  return all;
}

Scenario::Scenario(ScenarioSpec spec) : ScenarioSpec(std::move(spec)) { Indices(*this).check(); }

std::optional<ScenarioName> ScenarioName::of(std::string_view text) {
  return matches(text, kFilePattern) ? std::optional(ScenarioName(text)) : std::nullopt;
}

ScenarioName name_of(const Scenario& scenario) {
  const auto name = ScenarioName::of(scenario.name);
  LANTERN_CHECK(name ? scenario.name : "a scenario's name", ==, scenario.name);
  return *name;
}

}  // namespace lantern::language
