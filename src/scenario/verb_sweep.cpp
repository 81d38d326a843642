// `sweep`: a sort and sweep finds its pairs, interval by interval.
#include <algorithm>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "scenario/key.hpp"
#include "scenario/script_reading.hpp"
#include "scenario/script_run.hpp"

namespace lantern::scenario {
namespace {

double begin_of(const FrameBody& body, int axis) {
  return body.stored_box.value_or(body.box).lo[axis];
}

// In the order of the sweep.
std::vector<BodyId> in_order(const Frame& frame) {
  std::vector<const FrameBody*> bodies;
  for (const FrameBody& body : frame.bodies) bodies.push_back(&body);
  std::ranges::sort(bodies, {}, [&](const FrameBody* body) {
    return std::pair(begin_of(*body, frame.get<FrameStructure>().sweep_axis), body->id);
  });
  std::vector<BodyId> order;
  for (const FrameBody* body : bodies) order.push_back(body->id);
  return order;
}

// With what of those that begin later, and before it ends, it was compared.
std::string text_of(const std::string& name, const std::vector<std::string>& others) {
  if (others.empty()) return fmt::format("Nobody begins before {} ends: nothing to compare.", name);
  return fmt::format("Before {} ends, {} begin{}: {} to compare.", name, fmt::join(others, " and "),
                     others.size() == 1 ? "s" : "",
                     others.size() == 1 ? "1 pair" : fmt::format("{} pairs", others.size()));
}

}  // namespace

TableDoc Sweep::table() {
  return {.doc =
              "A `sort_and_sweep` finds its pairs: one frame for each body, in the order in which "
              "they begin on the axis, then one of all.",
          .keys = {},
          .example = R"([[step]]
do = "rebuild"
kind = "sort_and_sweep"

[[step]]
do = "sweep"
caption = "{pairs:pair} compared, {overlaps:overlap}."
)"};
}

void Sweep::read(const TableReader& table, ScriptReading& script) {
  if (!traits_of(script.state.structure.kind).has(Setting::axis))
    table.bad_value("do", "there is no sort_and_sweep at this step",
                    "rebuild with kind = \"sort_and_sweep\" first");
  script.frames = 1 + script.draft.scenario.bodies.size();
}

void Sweep::act(ScriptRun& run) const {
  Frame whole = run.frames.picture(run.frames.touched, "sweep");
  std::vector<Pair> met;
  run.engine().each_swept([&](BodyId a, BodyId b) { met.push_back({a, b}); });
  const auto name_of = [&](BodyId id) { return whole.body_of(id)->name; };
  std::set<Pair> found;
  std::size_t next = 0;
  for (const BodyId at : in_order(whole)) {
    std::vector<std::string> others;
    for (; next < met.size() && met[next].a == at; ++next) {
      found.insert({std::min(at, met[next].b), std::max(at, met[next].b)});
      others.push_back(name_of(met[next].b));
    }
    Frame frame = whole;
    frame.add<FrameStructure>().swept_to = at;
    std::erase_if(frame.pairs, [&](const FramePair& p) { return !found.contains(p.pair); });
    for (FramePair& pair : frame.pairs) pair.lit = pair.pair.a == at || pair.pair.b == at;
    for (auto& [name, number] : frame.counts) {
      if (name == "pairs" || name == "pair_tests") number = std::ssize(frame.pairs);
      if (name == "overlaps") number = std::ranges::count_if(frame.pairs, &FramePair::overlaps);
    }
    for (FrameBody& body : frame.bodies) body.lit = body.id == at;
    frame.caption = text_of(name_of(at), others);
    run.frames.give(std::move(frame), true);
  }
  run.frames.settle("sweep");
}

}  // namespace lantern::scenario
