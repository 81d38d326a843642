// A scenario file from its bytes to plain values.
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "base/file.hpp"
#include "base/hash.hpp"
#include "scenario/draft.hpp"
#include "scenario/needs.hpp"

namespace lantern {
namespace {

constexpr Place kTop{1, 1};

[[noreturn]] void refuse_size(const std::string& path, std::uintmax_t bytes) {
  Diagnostic too_large;
  too_large.where.file = path;
  too_large.message = fmt::format("the file has {} bytes, the limit is {}", bytes, kMostFileBytes);
  too_large.suggestion = "use [[pattern]] for many bodies";
  throw ScenarioError(too_large);
}

void read_name(const TableReader& file, const std::string& path, Draft& draft) {
  if (file.has("name")) {
    draft.scenario.name = file.text("name").value_or("");
    return;
  }
  const std::string stem = std::filesystem::path(path).stem().string();
  draft.scenario.name = stem;
  const NamePattern& pattern = *language_table("").find("name")->pattern;
  if (matches(stem, pattern)) return;
  draft.problems.add(
      kTop, fmt::format("the file's name {} cannot name a scenario", in_quotes(stem)),
      fmt::format("add name = \"{}\", or rename the file", legal_name(stem, pattern)));
}

void read_panels(const TableReader& file, Draft& draft) {
  Scenario& s = draft.scenario;
  const Needs needs = needs_of(s);
  if (!file.has("panels")) {
    if (needs.world_panel) s.panels.push_back(Panel::world);
    if (needs.atlas_panel) s.panels.push_back(Panel::atlas);
    if (needs.tree_panel) s.panels.push_back(Panel::tree);
    if (needs.chart_panel) s.panels.push_back(Panel::chart);
    return;
  }
  const bool possible[] = {draft.has_world, needs.structure || needs.level || needs.atlas,
                           needs.atlas, needs.chart, needs.structure};
  constexpr const char* kMissing[] = {
      "it needs a [world]", "it needs a [structure], a [level] or an [atlas]",
      "it needs an [atlas]", "it needs a [chart]", "it needs a [structure]"};
  const std::vector<Named> written = file.texts("panels");
  const std::vector<std::size_t> chosen = file.choices("panels");
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    s.panels.push_back(static_cast<Panel>(chosen[i]));
    if (!possible[chosen[i]])
      draft.problems.add(written[i].where,
                         fmt::format("this scenario cannot have the panel '{}'", written[i].name),
                         kMissing[chosen[i]]);
  }
}

void read_file_keys(const TableReader& file, const std::string& path, Draft& draft) {
  Scenario& s = draft.scenario;
  s.title = file.text("title").value_or("");
  s.source = file.text("source").value_or("");
  s.seed = static_cast<std::uint64_t>(file.whole("seed").value_or(1));
  s.pace = static_cast<Pace>(file.choice("pace").value_or(0));
  read_name(file, path, draft);
}

bool is_blank(std::string_view text) {
  return text.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

void read_all(const TomlTable& table, const std::string& path, Draft& draft) {
  const TableReader file(table, kTop, language_table(""), draft.problems, 0);
  read_file_keys(file, path, draft);
  read_world(file, draft);
  read_bodies(file, draft);
  read_links(file, draft);
  read_level(file, draft);
  read_chart(file, draft);
  read_problem(file, draft);
  read_atlas(file, draft);
  read_script(file, draft);
  read_panels(file, draft);
}

}  // namespace

Scenario parse_scenario(std::string_view text, const std::string& path) {
  if (text.size() > kMostFileBytes) refuse_size(path, text.size());
  Draft draft;
  draft.text = without_mark(text);
  draft.scenario.file = path;
  draft.scenario.text = text;
  draft.scenario.text_hash = Hash().add(text).value();
  TomlTable table;
  if (is_blank(draft.text)) {
    draft.problems.add(kTop, "the file is empty",
                       "a scenario needs at least a title and one step: title = \"…\", then "
                       "[[step]] with do = \"show\"");
  } else {
    table = read_toml(draft.text, draft.problems);
    if (!draft.problems.any()) read_all(table, path, draft);
  }
  draft.problems.raise(path, draft.text);
  return std::move(draft.scenario);
}

Scenario load_scenario(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error)) {
    const std::uintmax_t bytes = std::filesystem::file_size(path, error);
    if (!error && bytes > kMostFileBytes) refuse_size(path, bytes);
  }
  return parse_scenario(read_file(path, kMostFileBytes), path);
}

std::string_view to_string(StructureKind kind) {
  return language_table("structure").find("kind")->choices[static_cast<std::size_t>(kind)];
}

std::string_view to_string(Children children) {
  return children == Children::eager ? "eager" : "lazy";
}

}  // namespace lantern
