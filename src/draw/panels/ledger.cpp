// The pair ledger: a triangle of all pairs. Bodies stand on its edge in the scenario's order, each
// over its column and at the end of its row; where row and column meet, a mark says how far the
// pair came (frame/pair_state.hpp). Under it or in its free corner stands how many are in each
// state; together they are all. Of many bodies a density takes the place of the cells.
//
//   @ red
//   □ @ green           □ a candidate
//   · ▨ @ blue          ▨ its boxes are apart
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/body_shapes.hpp"
#include "draw/marks.hpp"
#include "draw/number_text.hpp"
#include "draw/panel.hpp"
#include "geometry/elementary.hpp"
#include "language/panel_rules.hpp"

namespace lantern::draw {
namespace {

using frame::PairState;
using frame::PairStates;

constexpr double kLedgerLine = 34;     // from a line of the key to the next
constexpr double kLedgerHeading = 40;  // height
constexpr double kKeyMark = 24;        // side of a mark in the key
constexpr double kKeyGap = 34;         // between two columns of the key
constexpr double kLedgerNameGap = 8;   // between a body and its name
constexpr double kLeastNamed = 27;     // a row of this height has room for a name
constexpr double kMostLedgerCell = 84;
constexpr double kLeastLedgerCell = 5;

// With more bodies than this pairs have no cells of their own.
constexpr std::size_t kMostLedgerBodies = 40;

// Without a structure nobody has looked at a pair; once boxes are compared, a candidate's overlap.
std::string key_text(PairState state, std::uint64_t n, const Frame& frame) {
  const bool looked = frame.structure != StructureKind::none;
  const bool compared =
      frame.count("contacts").has_value() && frame.phase != frame::StepPhase::broad;
  const char* const words[] = {
      "static, never tested",
      looked ? "ruled out" : "not looked at",
      compared ? "box overlap/box overlaps" : "candidate pair/candidate pairs",
      "apart by box",
      "apart by shape",
      "contact/contacts"};
  return number_of(static_cast<double>(n), words[static_cast<std::size_t>(state)]);
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

// A square of bins, its lower left half.
class Density {
 public:
  static constexpr std::size_t kBins = 32;

  explicit Density(const Frame& frame) {
    std::size_t n = 0;
    for (const FrameBody& body : frame.bodies) {
      const std::size_t bin = n++ * kBins / frame.bodies.size();
      bin_of_[body.id] = bin;
      ++bodies_[bin];
      statics_[bin] += body.is_static;
    }
    for (const FramePair& p : frame.pairs) add(p.pair);
  }

  // Of the pairs that a broad phase could hand on, how many it did; none: there are no such pairs.
  double share(std::size_t row, std::size_t column) const {
    const double all = pairs_in(bodies_, row, column) - pairs_in(statics_, row, column);
    return all > 0 ? handed_on_[row * kBins + column] / all : 0;
  }

 private:
  using Numbers = std::array<double, kBins>;

  static double pairs_in(const Numbers& of, std::size_t row, std::size_t column) {
    return row == column ? of[row] * (of[row] - 1) / 2 : of[row] * of[column];
  }
  void add(const Pair& pair) {
    const auto a = bin_of_.find(pair.a), b = bin_of_.find(pair.b);
    if (a == bin_of_.end() || b == bin_of_.end()) return;
    const auto [column, row] = std::minmax(a->second, b->second);
    ++handed_on_[row * kBins + column];
  }

  std::unordered_map<BodyId, std::size_t> bin_of_;
  Numbers bodies_{}, statics_{};
  std::array<double, kBins * kBins> handed_on_{};
};

// The side of the square goes with the logarithm: trees hand on a few pairs in a hundred or in ten
// thousand.
void draw_share(const Vec<2>& center, double share, double cell, DrawList& list) {
  constexpr double kDecades = 3.5;
  if (!(share > 0)) return;
  const double size = 1 + geometry::log10(std::min(1.0, share)) / kDecades;
  const double half = 0.46 * cell * std::max(0.12, size);
  list.rect(Box<2>::around(center, Vec<2>(half)), Role::pair);
}

class Ledger : PanelPicture {
 public:
  explicit Ledger(const PanelPicture& on) : PanelPicture(on), pairs_(frame_) {
    for (const FrameBody& body : frame_.bodies) bodies_.push_back(&body);
    std::ranges::sort(bodies_, {},
                      [](const FrameBody* body) { return std::pair(body->place, body->id); });
    keeps_rows_ = frame_.cast > 0 && frame_.cast <= kMostLedgerBodies;
    rows_ = keeps_rows_ ? std::max<std::size_t>(frame_.cast, bodies_.size()) : bodies_.size();
    states_ = states_of(pairs_);
    for (const PairState state : states_)
      key_width_ = std::max(
          key_width_,
          kKeyMark + 10 + text_width(key_text(state, pairs_.all() + 1, frame_), kPlain) + 2);
  }

  void draw() {
    heading(number_of(static_cast<double>(pairs_.all()), "pair/pairs"));
    if (rows_ < 2) return;
    if (rows_ > kMostLedgerBodies) {
      draw_density({area().lo, panel_.hi - Vec<2>(0, key_height(false) + 14)});
      return draw_key(false);
    }
    const LedgerPlan plan = best_plan();
    if (plan.cell == 0) return;
    draw_cells(plan);
    draw_bodies(plan);
    draw_key(plan.corner);
  }

 private:
  Box<2> area() const { return {panel_.lo + Vec<2>(0, kLedgerHeading), panel_.hi}; }

  // Bodies keep their rows when others come and go, unless too many will come.
  std::size_t row_of(std::size_t i) const { return keeps_rows_ ? bodies_[i]->place : i; }

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
      if (plan.named) right += kLedgerNameGap + text_width(bodies_[i]->called(), kPlain);
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
      draw_icon(&body, shrunk(box, 0.04 * plan.cell), list_);
      if (!plan.named) continue;
      write(body.called(), centred({box.hi.x + kLedgerNameGap, box.center().y}, kPlain, 0));
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
      write(key_text(states_[k], n, frame_), centred({mark.hi.x + 10, mark.center().y}, kPlain, 0));
    }
  }

  // All pairs in bins of bodies that follow each other: a square on each, the larger the greater
  // the share of its pairs that the broad phase handed on, and a scale beside it.
  void draw_density(const Box<2>& place) {
    const double cell = std::floor(std::min(place.size().x, place.size().y) / Density::kBins);
    if (cell < 3 || frame_.bodies.empty()) return;
    const Density density(frame_);
    const auto center = [&](std::size_t row, std::size_t column) {
      return place.lo +
             (Vec<2>(static_cast<double>(column), static_cast<double>(row)) + 0.5) * cell;
    };
    const double side = cell * Density::kBins;
    list_.polygon({place.lo, place.lo + Vec<2>(side, side), place.lo + Vec<2>(0, side)},
                  Role::panel, {Role::rule, 1.4});
    for (std::size_t row = 0; row < Density::kBins; ++row)
      for (std::size_t column = 0; column <= row; ++column)
        draw_share(center(row, column), density.share(row, column), cell, list_);
    // In the free corner, right of the edge that goes down beside it.
    constexpr double kScales[] = {1.0, 0.1, 0.01, 0.001}, kRowHeight = 34, kWidth = 130;
    const double x = place.lo.x + kRowHeight * 5 + 24;
    if (x + kWidth > place.hi.x) return;
    double y = place.lo.y + 24;
    labels_.try_add(word("tested"), {{{x, y}, 0}}, kPlain, place);
    for (const double share : kScales) {
      y += kRowHeight;
      draw_share({x + 12, y - 8}, share, 24, list_);
      labels_.try_add(fmt::format("{:g} %", 100 * share), {{{x + 36, y}, 0}}, kPlain, place);
    }
  }

  PairStates pairs_;
  std::vector<const FrameBody*> bodies_;  // in the scenario's order
  bool keeps_rows_ = false;
  std::size_t rows_ = 0;  // of bodies that are there and of those that are not
  std::vector<PairState> states_;
  double key_width_ = 0;
};

// Three lines that lean right, on a grid of the cell's own.
void hatch_cell(const Box<2>& cell, const Stroke& stroke, DrawList& list) {
  const Vec<2> size = cell.size();
  for (const double share : {0.55, 1.0, 1.45}) {
    const double sum = share * size.x;  // where x and the height above the lower edge add up to it
    const double a = std::max(0.0, sum - size.x), b = std::min(size.x, sum);
    list.line({cell.lo.x + a, cell.lo.y + sum - a}, {cell.lo.x + b, cell.lo.y + sum - b}, stroke);
  }
}

}  // namespace

PanelEntry ledger_panel() {
  return {
      {.name = "ledger",
       .words = "the `ledger`, a triangle with a cell for each pair of bodies and how far it came",
       .needs = "it needs a [structure], whose pairs it shows",
       .possible = language::has_structure},
      {.shows = {{"two bodies or more", [](const Frame& f) { return f.bodies.size() > 1; }}}},
      {.draw = draw_as<Ledger>, .weight = 1.1, .inset = 3, .smallest = {200, 120}}};
}

void draw_pair_mark(PairState state, bool is_new, const Box<2>& cell, DrawList& list) {
  const double size = cell.size().x, width = std::clamp(0.07 * size, 0.9, 3.2);
  const Stroke strong{Role::pair, width}, weak{Role::rejected_pair, 0.8 * width};
  const Role ground = is_new ? Role::lit_fill : Role::panel;
  switch (state) {
    case PairState::untestable:
      return list.disc(cell.center(), std::max(0.8, 0.05 * size), Role::cell_line_3);
    case PairState::ruled_out:
      return list.rect(cell, Role::free_space, {Role::rule, std::min(width, 1.4)}, 0.06 * size);
    case PairState::candidate:
      list.rect(cell, ground, strong, 0.06 * size);
      break;
    case PairState::boxes_apart:
      list.rect(cell, ground, weak, 0.06 * size);
      hatch_cell(shrunk(cell, width / 2), weak, list);
      break;
    case PairState::shapes_apart: {
      list.rect(cell, ground, strong, 0.06 * size);
      const Box<2> inner = shrunk(cell, 0.2 * size);
      list.line(inner.lo, inner.hi, strong);
      list.line({inner.lo.x, inner.hi.y}, {inner.hi.x, inner.lo.y}, strong);
      break;
    }
    case PairState::contact:
      list.rect(cell, Role::contact, {Role::contact, width}, 0.06 * size);
      if (is_new) list.rect(shrunk(cell, 1.5 * width), Role::none, {Role::panel, width});
      break;
  }
  if (is_new)
    list.rect(shrunk(cell, -0.6 * width), Role::none, {Role::lit, 1.2 * width}, 0.1 * size);
}

}  // namespace lantern::draw
