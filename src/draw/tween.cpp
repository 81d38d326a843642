#include "draw/tween.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include "base/stop.hpp"
#include "draw/tween_plan.hpp"
#include "draw/tween_shapes.hpp"

namespace lantern::draw {
namespace {

struct BeatSpans {
  BeatSpan eased, steady;
};

// In the order of the beats.
constexpr std::array<BeatSpans, static_cast<std::size_t>(Beat::count_beats)> kSpans{{
    {{0, 0}, {0, 0, false}},                     // always
    {{0, 0.35}, {0, 0.5, false}},                // out
    {{0.1, 0.75}, {0, 1, false}},                // move
    {{0.65, 1}, {0.5, 1, false}},                // in
    {{0.2, 0.5}, {0.2, 0.5, false}},             // over
    {{0.4, 0.7}, {0.5, 0.8, false}},             // under
    {{0.2, 0.85}, {0, 1, false}},                // grow
    {{0.2, 0.45}, {0, 0.4, false}},              // dawn
    {{0, 0.65}, {0, 1, false}},                  // fold
    {{0.4, 0.65}, {0.6, 1, false}},              // dusk
    {{0.5, 0.501, false}, {0.5, 0.501, false}},  // swap
}};

class Passages {
 public:
  Passages(const DrawList& a, const DrawList& b) : a_(a), b_(b), plan_(plan_tween(a, b)) {
    swap_texts();
  }

  // What goes is painted before what lay on it; what is handed on passes over all else.
  std::vector<Passage> made() {
    std::size_t next = 0;  // of a, that is not yet painted if it goes
    for (std::size_t i = 0; i < b_.shapes.size(); ++i) {
      if (plan_.of_b[i].kind == Fate::meets)
        for (; next < plan_.of_b[i].mate; ++next) add_old(next);
      add_new(i);
    }
    for (; next < a_.shapes.size(); ++next) add_old(next);
    for (std::size_t i = 0; i < a_.shapes.size(); ++i)
      if (plan_.of_a[i].kind == Fate::handed) add({i, plan_.of_a[i].mate, Beat::fold});
    for (std::size_t i = 0; i < b_.shapes.size(); ++i)
      if (plan_.of_b[i].kind == Fate::handed) add({plan_.of_b[i].mate, i, Beat::grow});
    return std::move(out_);
  }

 private:
  // The text of this shape if it comes or goes where it stands, or with its thing.
  static const TextShape* text_alone(const DrawList& list, const std::vector<Fate>& fates,
                                     std::size_t i) {
    const bool alone = fates[i].kind == Fate::fades || fates[i].kind == Fate::follows;
    return alone ? std::get_if<TextShape>(&list.shapes[i]) : nullptr;
  }

  // A text in the place of another one of its style: one of the two is always seen.
  void swap_texts() {
    std::vector<std::size_t> coming;
    for (std::size_t i = 0; i < b_.shapes.size(); ++i)
      if (text_alone(b_, plan_.of_b, i)) coming.push_back(i);
    for (std::size_t i = 0; i < a_.shapes.size(); ++i) {
      const TextShape* old = text_alone(a_, plan_.of_a, i);
      if (!old) continue;
      const auto next = std::find_if(coming.begin(), coming.end(), [&](std::size_t k) {
        const auto& text = std::get<TextShape>(b_.shapes[k]);
        return text.size == old->size && text.weight == old->weight && text.align == old->align &&
               std::abs(text.at.y - old->at.y) < 1 && std::abs(text.at.x - old->at.x) < old->size;
      });
      if (next == coming.end()) continue;
      swapped_a_.insert(i);
      swapped_b_.insert(*next);
      coming.erase(next);
    }
  }

  void add(const Passage& passage) { out_.push_back(passage); }

  void add_new(std::size_t i) {
    const Fate& fate = plan_.of_b[i];
    const bool swaps = swapped_b_.contains(i);
    const Beat seen = swaps ? Beat::swap : is_text(b_.shapes[i]) ? Beat::in : Beat::over;
    switch (fate.kind) {
      case Fate::handed:  // painted last
      case Fate::hidden:
        return;
      case Fate::stands:
        return add({{}, i});
      case Fate::fades:
        return add({{}, i, Beat::always, swaps ? Beat::swap : Beat::in});
      case Fate::follows:
        return add({{}, i, Beat::move, seen, false, fate.own, fate.other, fate.own});
      case Fate::emerges:
        return add({{}, i, Beat::grow, Beat::dawn, false, fate.own, fate.other, fate.own});
      case Fate::meets:
        return add({fate.mate, i, Beat::move});
    }
  }

  void add_old(std::size_t i) {
    const Fate& fate = plan_.of_a[i];
    const bool swaps = swapped_a_.contains(i);
    const Beat seen = swaps ? Beat::swap : is_text(a_.shapes[i]) ? Beat::out : Beat::under;
    switch (fate.kind) {
      case Fate::meets:   // painted with its mate
      case Fate::handed:  // painted last
      case Fate::hidden:
        return;
      case Fate::stands:
        return add({i, {}});
      case Fate::fades:
        return add({i, {}, Beat::always, swaps ? Beat::swap : Beat::out, true});
      case Fate::follows:
        return add({i, {}, Beat::move, seen, true, fate.own, fate.own, fate.other});
      case Fate::emerges:
        return add({i, {}, Beat::fold, Beat::dusk, true, fate.own, fate.own, fate.other});
    }
  }

  static bool is_text(const DrawShape& shape) { return std::holds_alternative<TextShape>(shape); }

  const DrawList &a_, &b_;
  TweenPlan plan_;
  std::set<std::size_t> swapped_a_, swapped_b_;
  std::vector<Passage> out_;
};

// The shape of a passage when it is so far on its way, and how it is painted but for its opacity.
std::pair<DrawShape, Tint> on_the_way(const Passage& p, const DrawList& a, const DrawList& b,
                                      double share) {
  if (p.a && p.b) {
    const DrawShape &from = a.shapes[*p.a], &to = b.shapes[*p.b];
    return from == to ? std::pair(to, Tint{}) : blend(from, to, share);
  }
  const DrawShape& shape = p.a ? a.shapes[*p.a] : b.shapes[*p.b];
  return {put(shape, p.own, mix(p.start, p.end, share)), {}};
}

}  // namespace

// Smootherstep (Perlin, 2002): at both ends neither speed nor acceleration.
double eased(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (t * (6 * t - 15) + 10);
}

BeatSpan span_of(Beat beat, Motion motion) {
  const BeatSpans& spans = kSpans[static_cast<std::size_t>(beat)];
  return motion == Motion::eased ? spans.eased : spans.steady;
}

double progress(Beat beat, double t, Motion motion) {
  if (beat == Beat::always) return 1;
  const BeatSpan span = span_of(beat, motion);
  const double part = std::clamp((t - span.from) / (span.to - span.from), 0.0, 1.0);
  return span.is_eased ? eased(part) : part;
}

std::vector<Passage> passages(const DrawList& a, const DrawList& b) {
  return Passages(a, b).made();
}

DrawList between(const DrawList& a, const DrawList& b, double t, Motion motion) {
  if (t <= 0) return a;
  if (t >= 1) return b;
  DrawList list;
  list.page = b.page;
  for (const Passage& passage : passages(a, b)) {
    stop_if_asked();
    const double seen = progress(passage.fade, t, motion);
    const double opacity = passage.leaves ? 1 - seen : seen;
    if (!(opacity > 0)) continue;
    auto [shape, tint] = on_the_way(passage, a, b, progress(passage.move, t, motion));
    tint.opacity = std::clamp(opacity, 0.0, 1.0);
    list.shapes.push_back(std::move(shape));
    list.tints.push_back(tint);
  }
  return list;
}

}  // namespace lantern::draw
