#include <algorithm>

#include <fmt/format.h>

#include "draw/sample_frames.hpp"

namespace lantern::draw::samples {
namespace {

// All pairs, in turn ruled out, candidates, apart and touching; the last two bodies are static.
Frame ledger(std::uint32_t bodies, bool contacts) {
  Frame frame = base("The pair ledger", {{0, 0}, {32, 18}}, {Panel::world, Panel::ledger});
  for (BodyId id = 0; id < bodies; ++id) {
    const std::string name = id % 3 == 0 ? fmt::format("body {}", id) : fmt::format("b{}", id);
    frame.bodies.push_back(body(id, name, id % 2 == 0 ? Look::ball : Look::ghost,
                                static_cast<int>(id % 8) + 1,
                                {1.0 + 2 * (id % 15), 2.0 + 2 * (id / 15 % 8)}));
    frame.bodies.back().is_static = bodies > 3 && id + 2 >= bodies;
  }
  std::uint32_t turn = 0;
  for (BodyId a = 0; a < bodies; ++a)
    for (BodyId b = a + 1; b < std::min(bodies, a + 12); ++b) {
      if (frame.bodies[a].is_static && frame.bodies[b].is_static) continue;
      const std::uint32_t kind = turn++ * 7 % 5;
      if (kind == 0) continue;
      frame.pairs.push_back({{a, b}, turn % 6 == 0, kind > 1});
      if (contacts && kind > 2) frame.tested.push_back({a, b});
      if (!contacts || kind != 4) continue;
      FrameContact& contact = frame.contacts.emplace_back();
      contact.pair = {a, b};
    }
  if (contacts) frame.add_count("contacts", frame.contacts.size());
  frame.caption = "Every pair has a cell.";
  return frame;
}

}  // namespace

Named ledgers() {
  Named frames;
  for (const std::uint32_t n : {0u, 1u, 2u, 5u, 12u, 40u, 41u, 300u})
    frames.emplace_back(fmt::format("ledger{}", n), ledger(n, true));
  frames.emplace_back("ledger_plain", ledger(6, false));
  Frame broad = ledger(6, true);
  broad.phase = StepPhase::broad;
  broad.contacts.clear();
  broad.tested.clear();
  frames.emplace_back("ledger_broad", broad);
  Frame few = ledger(5, true);  // of nine that will come
  few.cast = 9;
  for (FrameBody& body : few.bodies) body.place = 2 * body.id;
  frames.emplace_back("ledger_few", few);
  few.panels = {Panel::ledger};
  frames.emplace_back("ledger_alone", few);
  Frame long_names = ledger(6, true);
  for (FrameBody& body : long_names.bodies) body.name += " of a very long name indeed";
  frames.emplace_back("ledger_names", long_names);
  Frame beside = ghosts(4);
  beside.panels = {Panel::world, Panel::tree, Panel::ledger};
  beside.pairs = {{{0, 1}, true, true}, {{0, 3}, false, false}, {{1, 3}, false, true}};
  beside.add_count("contacts", 0);
  frames.emplace_back("ledger_under", beside);
  return frames;
}

}  // namespace lantern::draw::samples
