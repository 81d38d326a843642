#include "fuzz/trial.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/hash.hpp"
#include "base/printable.hpp"
#include "draw/page.hpp"
#include "fuzz/energy.hpp"
#include "language/text/problems.hpp"
#include "measure/plan.hpp"
#include "render/svg.hpp"
#include "run/director.hpp"
#include "run/tally.hpp"
#include "run/warnings.hpp"

namespace lantern::fuzz {
namespace {

constexpr int kWidth = 64, kHeight = 36;     // of a picture
constexpr double kRepeated = 0.1;            // of the scenarios that ran are run again
constexpr double kMeasured = 0.05;           // are measured
constexpr double kQuickRun = 0.02;           // seconds: what is run twice
constexpr std::uint32_t kMostFrames = 3000;  // that are looked at
constexpr std::size_t kMostJson = 1u << 20;  // bytes that are read again
constexpr std::size_t kMostShapes = 20'000;  // of a picture that is drawn

std::uint64_t feature(std::string_view kind, std::string_view what) {
  return Hash().add(kind).add(what).value();
}

void require_utf8(std::string_view what, const std::string& text) {
  if (first_bad_byte(text)) throw Finding(fmt::format("{} is not UTF-8: {}", what, text));
}

// Each mistake has a place inside the file, or right behind its end, and is UTF-8.
void require_sound(const std::vector<Diagnostic>& mistakes, std::string_view text) {
  if (mistakes.empty()) throw Finding("an error without a mistake");
  const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
  for (const Diagnostic& d : mistakes) {
    for (const std::string* part : {&d.message, &d.source_line, &d.suggestion})
      require_utf8("a diagnostic", *part);
    if (d.where.line == 0 && d.where.column == 0) continue;  // of the file as a whole
    const auto width = static_cast<int>(letters(line_of(text, d.where.line)));
    // A line break, CR LF, may be what is wrong.
    if (d.where.line < 1 || d.where.line > lines || d.where.column < 1 ||
        d.where.column > width + 2)
      throw Finding(
          fmt::format("a mistake at {}:{}, outside the file", d.where.line, d.where.column));
  }
}

// Tells of each key of a good file, as "body.radius", with the choice that was made.
class KeyWalk {
 public:
  KeyWalk(const std::function<void(std::string_view)>& used, std::set<std::uint64_t>& features)
      : used_(used), features_(features) {}

  void walk(const TomlTable& entries, const TableDoc& table) {
    for (const TomlEntry& entry : entries) {
      const KeyDoc* key = table.find(entry.key);
      if (!key) continue;
      note(fmt::format("{}.{}", table.name, key->key));
      if (const auto* chosen = std::get_if<std::string>(&entry.value.data);
          chosen && key->type == KeyType::choice)
        note(fmt::format("{}.{} = {}", table.name, key->key, *chosen));
      if (key->type == KeyType::table || key->type == KeyType::tables) go_in(entry.value, key->of);
    }
  }

 private:
  void note(const std::string& what) {
    used_(what);
    features_.insert(feature("key", what));
  }

  void go_in(const TomlValue& value, std::string_view of) {
    if (const auto* list = std::get_if<TomlArray>(&value.data))
      for (const TomlValue& member : *list) go_in(member, of);
    const auto* entries = std::get_if<TomlTable>(&value.data);
    if (!entries) return;
    if (of != "step") return walk(*entries, language_table(of));
    for (const TomlEntry& entry : *entries)
      if (const auto* verb = std::get_if<std::string>(&entry.value.data); verb && entry.key == "do")
        for (const TableDoc& table : language_verbs())
          if (table.name == *verb) {
            note(fmt::format("do = {}", *verb));
            walk(*entries, table);
          }
  }

  const std::function<void(std::string_view)>& used_;
  std::set<std::uint64_t>& features_;
};

void require_json(const Frame& frame) {
  const std::string text = to_json(frame);
  if (text.size() > kMostJson) return;  // the reader is what would take long
  try {
    if (nlohmann::json::parse(text).at("format") != "lantern.frame/2")
      throw Finding("a frame's JSON without its format");
  } catch (const nlohmann::json::exception& e) {
    throw Finding(fmt::format("a frame's JSON cannot be read: {}", e.what()));
  }
}

// Its nodes are a forest in which each knows its place, and its counts have each one name.
void require_sound(const Frame& frame) {
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    const FrameNode& node = frame.nodes[i];
    if (node.id != i) throw Finding(fmt::format("node {} stands in place {}", node.id, i));
    if (node.parent != kNone && node.parent >= i)
      throw Finding(fmt::format("node {} stands before its parent", i));
  }
  std::set<std::string_view> names;
  for (const auto& [name, number] : frame.counts)
    if (!names.insert(name).second) throw Finding(fmt::format("counted twice: '{}'", name));
  for (const auto& [name, number] : frame.measures)
    if (!names.insert(name).second) throw Finding(fmt::format("measured twice: '{}'", name));
}

}  // namespace

std::string kind_of(std::string_view message) {
  std::string kind;
  bool in_quotes = false;
  for (const char c : message) {
    if (c == '\'') in_quotes = !in_quotes;
    if (!in_quotes && !(c >= '0' && c <= '9') && c != '.') kind += c;
  }
  return kind;
}

std::string_view to_string(Stage stage) {
  constexpr std::string_view kNames[] = {"reading", "running", "explaining", "repeating",
                                         "writing", "drawing", "measuring"};
  return kNames[static_cast<std::size_t>(stage)];
}

void require_well_formed(std::string_view svg) {
  require_utf8("an SVG", std::string(svg));
  std::vector<std::string_view> open;
  std::size_t at = 0;
  while ((at = svg.find_first_not_of(" \n", at)) != svg.npos) {
    const std::size_t end = svg.find('>', at);
    if (svg[at] != '<' || end == svg.npos) throw Finding("an SVG with text between elements");
    std::string_view tag = svg.substr(at + 1, end - at - 1);
    at = end + 1;
    if (tag.starts_with('/')) {
      if (open.empty() || open.back() != tag.substr(1))
        throw Finding(fmt::format("an SVG closes what is not open: {}", tag));
      open.pop_back();
      continue;
    }
    if (std::count(tag.begin(), tag.end(), '"') % 2 != 0 || tag.find('<') != tag.npos ||
        tag.find('&') != tag.npos || tag.find("nan") != tag.npos || tag.find("inf") != tag.npos)
      throw Finding(fmt::format("an SVG with a bad element: <{}>", tag));
    if (!tag.ends_with('/')) open.push_back(tag.substr(0, tag.find(' ')));
  }
  if (!open.empty()) throw Finding("an SVG that ends too soon");
}

Trial::Trial(Watch& watch, std::function<void(Stage)> entered,
             std::function<void(std::string_view)> used)
    : watch_(watch),
      entered_(std::move(entered)),
      used_(std::move(used)),
      renderer_(Context::create(Backend::automatic), kWidth, kHeight) {}

TrialResult Trial::run(const std::string& text, Dice& dice) {
  result_ = {};
  shots_.clear();
  scenario_.reset();
  try {
    read_it(text);
    if (!scenario_) return std::move(result_);
    run_it(dice.chance(0.25) ? Pace::event : scenario_->pace, dice);
  } catch (const ScenarioError& error) {
    require_sound(error.diagnostics(), text);
    result_.mistakes = error.diagnostics();
    for (const Diagnostic& d : result_.mistakes)
      result_.features.insert(feature("mistake", kind_of(d.message)));
  }
  for (const Frame& frame : shots_) show(frame);
  if (result_.ran && dice.chance(kMeasured)) measure_it(dice);
  return std::move(result_);
}

void Trial::read_it(const std::string& text) {
  entered_(Stage::reading);
  const bool whole = watch_.bounded(
      [&] { scenario_ = std::make_unique<Scenario>(parse_scenario(text, "fuzz.toml")); });
  result_.stopped = result_.stopped || !whole;
  if (!scenario_) return;
  result_.good = true;
  if (scenario_->steps.empty()) throw Finding("a scenario without a step");
  Problems problems;
  KeyWalk(used_, result_.features)
      .walk(read_toml(without_mark(text), problems), language_table(""));
}

void Trial::run_it(Pace pace, Dice& dice) {
  entered_(Stage::running);
  EnergyMeter energy(*scenario_);
  std::vector<std::uint64_t> hashes;
  const Watch::Clock::time_point start = Watch::Clock::now();
  Work work;
  Tally tally(*scenario_, work);
  DirectorReport report;
  RunWatch warner(*scenario_, shows_a_body);
  const auto bounded_run = [&](RunWatch* warned, const std::function<void(const Frame&)>& look) {
    return watch_.bounded([&] {
      const auto see = [&](const Frame& frame) {
        look(frame);
        return !stop_asked() && frame.index + 1 < kMostFrames;
      };
      report = direct(*scenario_, pace, work, see, warned);
    });
  };
  const bool whole = bounded_run(&warner, [&](const Frame& frame) {
    hashes.push_back(frame.hash);
    energy.look(frame);
    tally.see(frame);
    const Step& step = scenario_->steps[frame.step];
    result_.features.insert(feature(std::to_string(step.verb.index()), frame.event));
    result_.features.insert(feature(std::to_string(step.verb.index()), to_string(frame.structure)));
    // The latest, and one from anywhere before it.
    if (shots_.size() < 2)
      shots_.push_back(frame);
    else if (std::has_single_bit(frame.index) || dice.chance(0.1))
      shots_[dice.index(2)] = frame;
  });
  if (const std::vector<Diagnostic> warnings = warner.warnings(); !warnings.empty()) {
    require_sound(warnings, scenario_->text);
    for (const Diagnostic& d : warnings)
      result_.features.insert(feature("warning", kind_of(d.message)));
  }
  result_.frames = static_cast<std::uint32_t>(hashes.size());
  result_.energy_growth = energy.growth();
  result_.ran = whole;
  entered_(Stage::explaining);
  if (whole)
    for (const StageTally& stage : tally.stages(report))
      if (stage.used()) result_.features.insert(feature("need", stage.stage));
  result_.stopped = result_.stopped || !whole;
  const std::chrono::duration<double> seconds = Watch::Clock::now() - start;
  if (!whole || seconds.count() > kQuickRun || !dice.chance(kRepeated)) return;
  entered_(Stage::repeating);  // unwatched: who looks changes nothing
  std::size_t next = 0;
  const bool again = bounded_run(nullptr, [&](const Frame& frame) {
    if (next >= hashes.size() || frame.hash != hashes[next++])
      throw Finding(fmt::format("frame {} is another one the second time", frame.index));
  });
  if (again && next != hashes.size()) throw Finding("fewer frames the second time");
}

void Trial::show(const Frame& frame) {
  entered_(Stage::writing);
  DrawList list;
  Work work;
  bool whole = watch_.bounded([&] {
    require_sound(frame);
    require_json(frame);
    list = draw_frame(frame, page_for(kWidth, kHeight), work);
    require_well_formed(to_svg(list, *theme_named("dark"), false, kWidth, kHeight));
  });
  if (whole && list.shapes.size() <= kMostShapes) {
    entered_(Stage::drawing);
    Image image;
    whole = watch_.bounded([&] { renderer_.draw(list, *theme_named("light"), false, image); });
    if (whole && (image.width != kWidth || image.height != kHeight))
      throw Finding("a picture of another size");
  }
  result_.drawn = result_.drawn || whole;
  result_.stopped = result_.stopped || !whole;
}

// One method at the coarsest step.
void Trial::measure_it(Dice& dice) {
  static const std::vector<std::string> kMethods = {
      "semi_implicit_euler", "velocity_verlet", "implicit_midpoint",       "splitting_4", "soft:2",
      "impulse:4",           "dormand_prince",  "dormand_prince:adaptive", "kahan_li_8"};
  entered_(Stage::measuring);
  try {
    result_.measured = watch_.bounded([&] {
      PlanOptions options;
      options.scenarios.push_back(*scenario_);
      options.effort = Effort::quick;
      options.peers = false;
      options.longest = 0.01;
      options.methods = {dice.pick(kMethods)};
      Plan plan(options, [](const Scenario&) {});
      if (!plan.jobs().empty() && !plan.is_too_long(plan.jobs().front()))
        plan.run(std::span(plan.jobs()).first(1));
    });
  } catch (const ScenarioError& error) {
    require_sound(error.diagnostics(), scenario_->text);
  } catch (const Refused& refused) {
    require_utf8("a refusal", refused.what());
    result_.features.insert(feature("refused", kind_of(refused.what())));
  }
}

}  // namespace lantern::fuzz
