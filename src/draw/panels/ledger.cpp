// The pair ledger: a triangle of all pairs. Bodies stand on its edge, each over its column and at
// the end of its row; where row and column meet, a mark says how far the pair came.
//
//   @ red
//   □ @ green           □ a candidate
//   · ▨ @ blue          ▨ its boxes are apart
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "draw/body_shapes.hpp"
#include "draw/number_text.hpp"
#include "draw/panel.hpp"
#include "draw/world/ledger_marks.hpp"
#include "frame/pair_state.hpp"

namespace lantern::draw {
namespace {

using frame::PairState;
using frame::PairStates;

constexpr double kLedgerText = 24;
constexpr double kLedgerLine = 34;     // from a line of the key to the next
constexpr double kLedgerHeading = 40;  // height
constexpr double kKeyMark = 24;        // side of a mark in the key
constexpr double kKeyGap = 34;         // between two columns of the key
constexpr double kLedgerNameGap = 8;   // between a body and its name
constexpr double kLeastNamed = 27;     // a row of this height has room for a name
constexpr double kMostLedgerCell = 84;
constexpr double kLeastLedgerCell = 5;

const TextStyle kLedgerStyle{kLedgerText, Weight::regular, Role::ink};

// Without a structure nobody has looked at a pair; once boxes are compared, a candidate's overlap.
std::string key_text(PairState state, std::uint64_t n, const Frame& frame) {
  const bool looked = frame.structure != StructureKind::none;
  const bool compared =
      frame.count("contacts").has_value() && frame.phase != frame::StepPhase::broad;
  const bool one = n == 1;
  const char* const overlap = one ? "box overlap" : "box overlaps";
  const char* const candidate = one ? "candidate" : "candidates";
  const char* const words[] = {"static, never tested",
                               looked ? "ruled out" : "not looked at",
                               compared ? overlap : candidate,
                               "apart by box",
                               "apart by shape",
                               one ? "contact" : "contacts"};
  return fmt::format("{} {}", number_text(static_cast<double>(n)),
                     words[static_cast<std::size_t>(state)]);
}

// The states that pairs of this scene may be in, in the order of a step.
std::vector<PairState> states_of(const PairStates& pairs) {
  std::vector<PairState> states;
  if (pairs.count(PairState::untestable) > 0) states.push_back(PairState::untestable);
  states.insert(states.end(), {PairState::ruled_out, PairState::candidate});
  if (pairs.has_contacts())
    states.insert(states.end(),
                  {PairState::boxes_apart, PairState::shapes_apart, PairState::contact});
  return states;
}

// How the ledger lies on its panel.
struct LedgerPlan {
  double cell = 0;      // 0: none has room
  bool named = false;   // names beside the bodies
  bool corner = false;  // the key stands in the free corner, else below
};

class Ledger : PanelPicture {
 public:
  explicit Ledger(const PanelPicture& on) : PanelPicture(on), pairs_(frame_) {
    for (const FrameBody& body : frame_.bodies) bodies_.push_back(&body);
    std::ranges::sort(bodies_, {},
                      [](const FrameBody* body) { return std::pair(body->place, body->id); });
    rows_ = std::max<std::size_t>(frame_.cast, bodies_.size());
    states_ = states_of(pairs_);
    for (const PairState state : states_)
      key_width_ = std::max(
          key_width_,
          kKeyMark + 10 + text_width(key_text(state, pairs_.all() + 1, frame_), kLedgerStyle) + 2);
  }

  void draw() {
    draw_heading();
    if (rows_ < 2) return;
    if (rows_ > kMostLedgerBodies) return draw_density();
    const LedgerPlan plan = best_plan();
    if (plan.cell == 0) return;
    draw_cells(plan);
    draw_bodies(plan);
    draw_key(plan.corner);
  }

 private:
  Box<2> area() const { return {panel_.lo + Vec<2>(0, kLedgerHeading), panel_.hi}; }

  // Bodies keep their rows when others come and go.
  std::size_t row_of(std::size_t i) const { return frame_.cast > 0 ? bodies_[i]->place : i; }

  std::size_t key_columns() const {
    const double room = panel_.size().x + kKeyGap;
    return std::max<std::size_t>(1, static_cast<std::size_t>(room / (key_width_ + kKeyGap)));
  }
  double key_height(bool corner) const {
    const std::size_t columns = corner ? 1 : key_columns();
    return kLedgerLine * static_cast<double>((states_.size() + columns - 1) / columns);
  }

  bool fits(const LedgerPlan& plan) const {
    const double side = plan.cell * static_cast<double>(rows_);
    Vec<2> room = area().size();
    if (!plan.corner) room.y -= key_height(false) + 14;
    if (side > room.x || side > room.y) return false;
    const double key_bottom = key_height(true) - kLedgerHeading + 8;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const auto row = static_cast<double>(row_of(i));
      double right = (row + 1) * plan.cell;
      if (plan.named) right += kLedgerNameGap + text_width(bodies_[i]->name, kLedgerStyle);
      const bool beside_key = plan.corner && row * plan.cell < key_bottom;
      if (right + 2 > room.x - (beside_key ? key_width_ + kKeyGap : 0)) return false;
    }
    // Of bodies to come nothing but their number is known.
    return !plan.corner || side <= room.x - key_width_ - kKeyGap || side > key_bottom;
  }

  // The largest cells, and names if they do not cost too much.
  LedgerPlan best_plan() const {
    constexpr double kWorthOfNames = 1.45;
    LedgerPlan best;
    double most = 0;
    for (const bool named : {true, false})
      for (const bool corner : {true, false})
        for (double cell = kMostLedgerCell; cell >= (named ? kLeastNamed : kLeastLedgerCell);
             --cell) {
          const LedgerPlan plan{cell, named, corner};
          if (!fits(plan)) continue;
          if (cell * (named ? kWorthOfNames : 1) > most) {
            best = plan;
            most = cell * (named ? kWorthOfNames : 1);
          }
          break;
        }
    return best;
  }

  Box<2> cell_at(std::size_t row, std::size_t column, double cell) const {
    const Vec<2> lo =
        area().lo + Vec<2>(static_cast<double>(column), static_cast<double>(row)) * cell;
    return shrunk({lo, lo + cell}, std::clamp(0.06 * cell, 0.5, 3.0));
  }

  void draw_cells(const LedgerPlan& plan) {
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Pair pair{std::min(bodies_[i]->id, bodies_[j]->id),
                        std::max(bodies_[i]->id, bodies_[j]->id)};
        const DrawList::Scope scope(list_, fmt::format("ledger/{}-{}", pair.a, pair.b));
        draw_pair_mark(pairs_.state_of(pair), pairs_.is_new(pair),
                       cell_at(row_of(i), row_of(j), plan.cell), list_);
      }
  }

  void draw_bodies(const LedgerPlan& plan) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const FrameBody& body = *bodies_[i];
      const DrawList::Scope scope(list_, fmt::format("ledger/body/{}", body.id));
      const Box<2> box = cell_at(row_of(i), row_of(i), plan.cell);
      draw_character(body, icon_box(body, shrunk(box, 0.04 * plan.cell)), false, list_);
      if (!plan.named) continue;
      labels_.add(body.name, centred({box.hi.x + kLedgerNameGap, box.center().y}, kLedgerStyle, 0),
                  kLedgerStyle, panel_);
    }
  }

  // A line for each state that occurs. Each has its place, so that none moves when another appears.
  void draw_key(bool corner) {
    const std::size_t columns = corner ? 1 : key_columns();
    const Vec<2> origin = corner ? Vec<2>(panel_.hi.x - key_width_, panel_.lo.y)
                                 : Vec<2>(panel_.lo.x, panel_.hi.y - key_height(false));
    for (std::size_t k = 0; k < states_.size(); ++k) {
      const std::uint64_t n = pairs_.count(states_[k]);
      if (n == 0) continue;
      const Vec<2> at = origin + Vec<2>(static_cast<double>(k % columns) * (key_width_ + kKeyGap),
                                        static_cast<double>(k / columns) * kLedgerLine);
      const DrawList::Scope scope(list_, fmt::format("ledger/key/{}", k));
      const Box<2> mark{at + Vec<2>(0, 4), at + Vec<2>(kKeyMark, 4 + kKeyMark)};
      draw_pair_mark(states_[k], false, shrunk(mark, 1), list_);
      labels_.add(key_text(states_[k], n, frame_),
                  centred({mark.hi.x + 10, mark.center().y}, kLedgerStyle, 0), kLedgerStyle,
                  panel_);
    }
  }

  void draw_heading() {
    const TextStyle style{kLedgerText, Weight::semibold, Role::ink};
    const std::uint64_t n = pairs_.all();
    const std::string text =
        fmt::format("{} pair{}", number_text(static_cast<double>(n)), n == 1 ? "" : "s");
    labels_.add(shortened(text, panel_.size().x, style),
                {{panel_.lo.x, panel_.lo.y + 0.8 * kLedgerText}, 0}, style, panel_);
  }

  void draw_density() {
    draw_pair_density(frame_, density_place(), list_, labels_);
    draw_key(false);
  }
  Box<2> density_place() const {
    Box<2> place = area();
    place.hi.y -= key_height(false) + 14;
    return place;
  }

  PairStates pairs_;
  std::vector<const FrameBody*> bodies_;  // in the scenario's order
  std::size_t rows_ = 0;                  // of bodies that are there and of those that are not
  std::vector<PairState> states_;
  double key_width_ = 0;
};

void draw_ledger(const Frame& frame, const Staging& staging, const Box<2>& panel, DrawList& list,
                 Labels& labels) {
  const Box<2> place = shrunk(panel, 3);
  if (place.size().x < 200 || place.size().y < 120) return;
  Ledger({frame, staging, place, list, labels}).draw();
}

}  // namespace

// The pair ledger: a triangle with a cell for each pair of bodies, marked by how far the pair came
// from all pairs to contacts (frame/pair_state.hpp), and under it or in its free corner how many
// are in each state; together they are all. Bodies stand on the triangle's edge, in the scenario's
// order. Of many bodies a density takes the place of the cells.
PanelView ledger_panel() { return {.name = "ledger", .draw = draw_ledger, .weight = 1.1}; }

}  // namespace lantern::draw
