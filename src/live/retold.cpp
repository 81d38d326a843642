#include "live/retold.hpp"

#include <algorithm>
#include <set>
#include <string>

#include <fmt/format.h>

#include "live/play.hpp"

namespace lantern::live {

using language::Step;

namespace {

// All that a step's pictures and questions say in words of the script.
void for_each_words(auto& step, const auto& f) {
  f(step.caption);
  f(step.after);
  f(step.answer);
  for (auto& note : step.notes) f(note.text);
  for (auto& ruler : step.rulers) f(ruler.text);
  if (auto* compare = std::get_if<language::Compare>(&step.verb)) f(compare->verdict);
  if (step.plot) f(*step.plot);
}

void keep_own(language::Scenario& scenario, const std::set<std::string>& known) {
  for (std::size_t i = 0; i < scenario.steps.size(); ++i) {
    Step& step = scenario.steps[i];
    if (step.lit && known.contains(step.caption)) step.lit->clear();
    for_each_words(step, [&](std::string& words) {
      if (known.contains(words)) words.clear();
    });
    std::erase_if(step.notes, [](const auto& note) { return note.text.empty(); });
    if (step.plot && step.plot->empty()) step.plot = fmt::format("step {}", i + 1);
  }
  for (auto& side : scenario.sides) {
    language::Scenario own = *side;
    keep_own(own, known);
    side = std::make_shared<const language::Scenario>(std::move(own));
  }
}

bool is_same(const Frame& a, const Frame& b) {
  return a.step == b.step && a.hash == b.hash && a.counts == b.counts && a.measures == b.measures &&
         std::ranges::equal(a.sides, b.sides, is_same);
}

}  // namespace

// In order. One whose words somebody has changed is known by its place, verb and name.
std::vector<int> steps_in(const language::Scenario& lesson, const language::Scenario& scenario) {
  std::vector<int> found;
  auto next = lesson.steps.begin();
  for (const Step& step : scenario.steps) {
    auto like = next;
    if (!step.caption.empty())
      like = std::find_if(next, lesson.steps.end(),
                          [&](const Step& its) { return its.caption == step.caption; });
    if (like == lesson.steps.end()) like = next;
    const bool is_there = like != lesson.steps.end() && like->verb.index() == step.verb.index() &&
                          like->name == step.name && like->caption.empty() == step.caption.empty();
    found.push_back(is_there ? static_cast<int>(like - lesson.steps.begin()) : -1);
    if (is_there) next = like + 1;
  }
  return found;
}

void keep_own_words(language::Scenario& scenario, const language::Scenario& lesson) {
  std::set<std::string> known;
  const auto know = [&](const language::Scenario& of) {
    for (const Step& step : of.steps)
      for_each_words(step, [&](const std::string& words) { known.insert(words); });
  };
  know(lesson);
  for (const auto& side : lesson.sides) know(*side);
  known.erase("");
  keep_own(scenario, known);
}

bool is_same_world(const Play& a, const Play& b) {
  return std::ranges::equal(a.frames(), b.frames(), is_same);
}

}  // namespace lantern::live
