#include "draw/tween.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string_view>
#include <variant>

#include "base/stop.hpp"

namespace lantern::draw {
namespace {

struct BeatSpans {
  BeatSpan eased, steady;
};

// In the order of the beats.
constexpr std::array<BeatSpans, static_cast<std::size_t>(Beat::count_beats)> kSpans{{
    {{0, 0}, {0, 0, false}},                 // always
    {{0, 0.35}, {0, 0.5, false}},            // out
    {{0.1, 0.75}, {0, 1, false}},            // move
    {{0.65, 1}, {0.5, 1, false}},            // in
    {{0.2, 0.5}, {0.2, 0.5, false}},         // over
    {{0.5, 0.8}, {0.5, 0.8, false}},         // under
    {{0.2, 0.85}, {0, 1, false}},            // grow
    {{0.2, 0.45}, {0, 0.4, false}},          // dawn
    {{0, 0.65}, {0, 1, false}},              // fold
    {{0.4, 0.65}, {0.6, 1, false}},          // dusk
    {{0.999, 1, false}, {0.999, 1, false}},  // swap
    {{0.1, 0.5}, {0, 1, false}},             // first
    {{0.25, 0.65}, {0, 1, false}},           // second
    {{0.4, 0.8}, {0, 1, false}},             // third
}};

// What becomes of a shape of either picture.
struct Fate {
  enum Kind {
    fades,    // where it stands
    meets,    // it is `mate` of the other picture
    handed,   // the same, of a thing that it takes over from or gives way to
    follows,  // its thing, from the other picture's place
    emerges,  // out of, or back into, another thing's box or middle, or its own middle
    stands,   // as it is, all the while
    hidden,   // another shape stands for it
  };
  Kind kind = fades;
  std::size_t mate = 0;
  Box<2> own, other;              // where its thing is, and where that was or is to be
  std::optional<Beat> wave = {};  // in which it comes or moves, among many
};

// One for each shape of either picture.
struct TweenPlan {
  std::vector<Fate> of_a, of_b;
};

constexpr std::string_view kPage = "page/";

// All shapes of one key.
struct Thing {
  std::string from;
  std::vector<std::size_t> shapes;
  Box<2> box;
  bool lines = true;  // nothing else
};
using Things = std::map<std::string, Thing, std::less<>>;

Things things_of(const DrawList& list) {
  Things things;
  std::size_t run = 0;
  Thing* thing = &things[""];
  for (std::size_t i = 0; i < list.shapes.size(); ++i) {
    for (; run < list.runs.size() && list.runs[run].first <= i; ++run) {
      const KeyedRun& next = list.runs[run];
      if (run + 1 < list.runs.size() && list.runs[run + 1].first <= i) continue;  // it is empty
      thing = &things[next.key];
      thing->from = next.from;
    }
    const Box<2> box = extent_of(list.shapes[i]);
    thing->box = thing->shapes.empty() ? box : united(thing->box, box);
    thing->shapes.push_back(i);
    thing->lines = thing->lines && std::holds_alternative<LineShape>(list.shapes[i]);
  }
  return things;
}

// What a thing comes out of or goes back into: what it names, or else what stands above that, its
// way cut at the last dot.
const Things::value_type* origin_of(std::string_view from, const Things& things) {
  while (!from.empty()) {
    if (const auto found = things.find(from); found != things.end()) return &*found;
    const std::size_t dot = from.rfind('.'), slash = from.rfind('/');
    if (dot == from.npos || (slash != from.npos && dot < slash)) return nullptr;
    from = from.substr(0, dot);
  }
  return nullptr;
}

// Who is who in two pictures, by their keys: what has none is the same only where it looks the
// same.
class Planner {
 public:
  Planner(const DrawList& a, const DrawList& b)
      : a_(a), b_(b), of_a_(a.shapes.size()), of_b_(b.shapes.size()) {}

  TweenPlan made() {
    for (const auto& [key, thing] : in_b_) come(key, thing);
    for (const auto& [key, thing] : in_a_)
      if (!in_b_.contains(key)) go(key, thing);
    set_waves();
    return {std::move(of_a_), std::move(of_b_)};
  }

 private:
  using Shapes = std::vector<std::size_t>;

  void come(const std::string& key, const Thing& thing) {
    const auto before = in_a_.find(key);
    if (key.starts_with(kPage)) {
      set(thing, Fate::hidden, of_b_);
      if (before == in_a_.end()) return;
      set(before->second, Fate::stands, of_a_);
      return match_equal(before->second.shapes, thing.shapes);
    }
    if (key.empty()) {
      match_equal(in_a_.at(key).shapes, thing.shapes);
      return match_close(in_a_.at(key), thing);
    }
    if (before != in_a_.end()) {
      follow(thing, before->second.box, of_b_);
      follow(before->second, thing.box, of_a_);
      return match(before->second.shapes, thing.shapes);
    }
    const auto* origin = origin_of(thing.from, in_a_);
    if (origin && !in_b_.contains(origin->first) && pair_up(origin->second, thing, of_b_))
      return set(origin->second, Fate::hidden, of_a_);
    leave(key, thing, origin, of_b_);
  }

  void go(const std::string& key, const Thing& thing) {
    if (key.starts_with(kPage)) return set(thing, Fate::stands, of_a_);
    if (of_a_[thing.shapes[0]].kind == Fate::hidden) return;
    const auto* end = origin_of(thing.from, in_b_);
    if (end && !in_a_.contains(end->first) && pair_up(end->second, thing, of_a_))
      return set(end->second, Fate::hidden, of_b_);
    leave(key, thing, end, of_a_);
  }

  // New nodes of a tree, and textures on their way into an atlas, in the order of their painting.
  // What is of one node or texture, which the end of its key names, goes together.
  void set_waves() {
    constexpr std::size_t kMany = 4, kWaves = 3;
    std::map<std::string, std::size_t> ranks;
    const auto name_of = [](const std::string& key) { return key.substr(key.rfind('/') + 1); };
    for (const KeyedRun& run : b_.runs) {
      const bool atlas = run.key.find("atlas/") != run.key.npos;
      const auto found = in_b_.find(run.key);
      if (found == in_b_.end() || (!atlas && run.key.find("tree/") == run.key.npos)) continue;
      const std::size_t i = found->second.shapes[0];
      const bool moves = of_b_[i].kind == Fate::meets && a_.shapes[of_b_[i].mate] != b_.shapes[i];
      if (of_b_[i].kind == Fate::emerges || (atlas && moves))
        ranks.emplace(name_of(run.key), ranks.size());
    }
    if (ranks.size() < kMany) return;
    const auto set_wave = [&](const Things& things, std::vector<Fate>& fates) {
      for (const auto& [key, thing] : things)
        if (const auto rank = ranks.find(name_of(key)); rank != ranks.end())
          for (const std::size_t i : thing.shapes)
            fates[i].wave = static_cast<Beat>(static_cast<std::size_t>(Beat::first) +
                                              rank->second * kWaves / ranks.size());
    };
    set_wave(in_a_, of_a_), set_wave(in_b_, of_b_);
  }

  static void set(const Thing& thing, Fate::Kind kind, std::vector<Fate>& fates) {
    for (const std::size_t i : thing.shapes) fates[i].kind = kind;
  }

  static void follow(const Thing& thing, const Box<2>& other, std::vector<Fate>& fates) {
    for (const std::size_t i : thing.shapes) fates[i] = {Fate::follows, 0, thing.box, other};
  }

  static void leave(const std::string& key, const Thing& thing, const Things::value_type* origin,
                    std::vector<Fate>& fates) {
    if (thing.from != key && !origin) return;
    Box<2> other = origin ? origin->second.box : thing.box;
    if (!origin || thing.lines) other = {other.center(), other.center()};
    for (const std::size_t i : thing.shapes) fates[i] = {Fate::emerges, 0, thing.box, other};
  }

  // A thing that another one takes over from: `thing` starts, or ends, as all of `other`. `fates`
  // are of the picture of `thing`.
  bool pair_up(const Thing& other, const Thing& thing, std::vector<Fate>& fates) const {
    const bool comes = &fates == &of_b_;
    const DrawList &theirs = comes ? a_ : b_, &ours = comes ? b_ : a_;
    if (other.shapes.size() != thing.shapes.size()) return false;
    for (std::size_t k = 0; k < thing.shapes.size(); ++k)
      if (!can_blend(theirs.shapes[other.shapes[k]], ours.shapes[thing.shapes[k]])) return false;
    for (std::size_t k = 0; k < thing.shapes.size(); ++k)
      fates[thing.shapes[k]] = {Fate::handed, other.shapes[k], {}, {}};
    return true;
  }

  void meet(std::size_t a, std::size_t b) {
    of_a_[a] = {Fate::meets, b, {}, {}};
    of_b_[b] = {Fate::meets, a, {}, {}};
  }

  // Of one thing: shape by shape if they are of the same kinds; otherwise those of one style, in
  // order, as many as can be (longest common subsequence).
  void match(const Shapes& a, const Shapes& b) {
    bool same = a.size() == b.size();
    for (std::size_t k = 0; same && k < a.size(); ++k)
      same = a_.shapes[a[k]].index() == b_.shapes[b[k]].index();
    if (same) {
      for (std::size_t k = 0; k < a.size(); ++k)
        if (can_blend(a_.shapes[a[k]], b_.shapes[b[k]])) meet(a[k], b[k]);
      return;
    }
    constexpr std::size_t kMost = 400;  // shapes of one thing; the work goes by the square
    const std::size_t n = std::min(a.size(), kMost), m = std::min(b.size(), kMost);
    std::vector<std::string> styles;
    for (std::size_t j = 0; j < m; ++j) styles.push_back(style_of(b_.shapes[b[j]]));
    std::vector<std::vector<std::uint32_t>> common(n + 1, std::vector<std::uint32_t>(m + 1));
    for (std::size_t i = n; i-- > 0;) {
      const std::string style = style_of(a_.shapes[a[i]]);
      for (std::size_t j = m; j-- > 0;)
        common[i][j] = style == styles[j] ? common[i + 1][j + 1] + 1
                                          : std::max(common[i + 1][j], common[i][j + 1]);
    }
    for (std::size_t i = 0, j = 0; i < n && j < m;) {
      if (common[i][j] == common[i + 1][j])
        ++i;
      else if (common[i][j] == common[i][j + 1])
        ++j;
      else
        meet(a[i++], b[j++]);
    }
  }

  // Of no thing in particular: what is the same in both stands still.
  void match_equal(const Shapes& a, const Shapes& b) {
    using Look = std::pair<std::string, std::vector<double>>;
    const auto look_of = [](DrawShape shape) {
      Look look{style_of(shape), {}};
      const auto add = [&](double measure) { look.second.push_back(measure); };
      std::visit([&](auto& s) { for_each_measure(s, add); }, shape);
      return look;
    };
    std::map<Look, Shapes> waiting;
    for (auto i = a.rbegin(); i != a.rend(); ++i) waiting[look_of(a_.shapes[*i])].push_back(*i);
    for (const std::size_t j : b) {
      const auto same = waiting.find(look_of(b_.shapes[j]));
      if (same == waiting.end() || same->second.empty()) continue;
      meet(same->second.back(), j);
      same->second.pop_back();
    }
  }

  // What comes in the place of its like: a wall that is lit or cut, a ground, is never gone.
  void match_close(const Thing& a, const Thing& b) {
    const auto is_free = [](const DrawList& list, const std::vector<Fate>& fates, std::size_t i) {
      return fates[i].kind != Fate::meets && !std::holds_alternative<TextShape>(list.shapes[i]);
    };
    for (const std::size_t j : b.shapes) {
      if (!is_free(b_, of_b_, j)) continue;
      for (const std::size_t i : a.shapes) {
        const DrawShape &old = a_.shapes[i], &next = b_.shapes[j];
        if (!is_free(a_, of_a_, i) || !(lies_on(old, next) || lies_on(next, old))) continue;
        of_a_[i] = {Fate::follows, 0, a.box, a.box};
        of_b_[j] = {Fate::follows, 0, b.box, b.box};
      }
    }
  }

  // Is the middle of one line on the other, or that of a ground on another one of its colour?
  static bool lies_on(const DrawShape& shape, const DrawShape& other) {
    const Vec<2> middle = extent_of(shape).center();
    if (shape.index() != other.index() || !contains(shrunk(extent_of(other), -0.1), middle))
      return false;
    const auto* line = std::get_if<LineShape>(&other);
    if (!line) return style_of(shape) == style_of(other);
    return glm::distance(middle, line->from) + glm::distance(middle, line->to) <
           glm::distance(line->from, line->to) + 0.1;
  }

  const DrawList &a_, &b_;
  Things in_a_ = things_of(a_), in_b_ = things_of(b_);
  std::vector<Fate> of_a_, of_b_;
};

class Passages {
 public:
  Passages(const DrawList& a, const DrawList& b) : a_(a), b_(b), plan_(Planner(a, b).made()) {
    swap_texts();
  }

  // What goes is painted before what lay on it; what is handed on passes over all else.
  std::vector<Passage> made() {
    std::size_t next = 0;  // of a, that is not yet painted if it goes
    for (std::size_t i = 0; i < b_.shapes.size(); ++i) {
      if (plan_.of_b[i].kind == Fate::meets)
        for (; next < plan_.of_b[i].mate; ++next) add(next, true);
      add(i, false);
    }
    for (; next < a_.shapes.size(); ++next) add(next, true);
    for (std::size_t i = 0; i < a_.shapes.size(); ++i)
      if (plan_.of_a[i].kind == Fate::handed) out_.push_back({i, plan_.of_a[i].mate, Beat::fold});
    for (std::size_t i = 0; i < b_.shapes.size(); ++i)
      if (plan_.of_b[i].kind == Fate::handed) out_.push_back({plan_.of_b[i].mate, i, Beat::grow});
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
      const auto next = std::ranges::find_if(coming, [&](std::size_t k) {
        const auto& text = std::get<TextShape>(b_.shapes[k]);
        return text.size == old->size && text.weight == old->weight && text.align == old->align &&
               std::abs(text.at.y - old->at.y) < 1 && std::abs(text.at.x - old->at.x) < old->size;
      });
      if (next == coming.end()) continue;
      swapped_a_.insert(i);
      swapped_b_.insert(*next);
      coming.erase(next);
    }
    swap_numbers(a_, plan_.of_a, swapped_a_), swap_numbers(b_, plan_.of_b, swapped_b_);
  }

  // All digits of a number give way at once, or what is left of it would be another number.
  static void swap_numbers(const DrawList& list, const std::vector<Fate>& fates,
                           std::set<std::size_t>& swapped) {
    const auto digit = [&](std::size_t i) {
      const TextShape* text = text_alone(list, fates, i);
      return text && text->text.size() == 1 && std::isdigit(text->text[0]) ? text : nullptr;
    };
    const auto go_on = [&](std::size_t from, std::size_t to) {
      const TextShape *here = digit(from), *there = digit(to);
      if (swapped.contains(from) && here && there && here->at.y == there->at.y &&
          std::abs(here->at.x - there->at.x) < here->size)
        swapped.insert(to);
    };
    for (std::size_t i = 1; i < list.shapes.size(); ++i) go_on(i - 1, i);
    for (std::size_t i = list.shapes.size(); i-- > 1;) go_on(i, i - 1);
  }

  // What becomes of a shape of b, or of one of a, which leaves.
  void add(std::size_t i, bool leaves) {
    const Fate& fate = (leaves ? plan_.of_a : plan_.of_b)[i];
    const bool swaps = (leaves ? swapped_a_ : swapped_b_).contains(i);
    const bool is_text = std::holds_alternative<TextShape>((leaves ? a_ : b_).shapes[i]);
    Passage passage{.leaves = leaves, .own = fate.own, .start = fate.own, .end = fate.own};
    (leaves ? passage.a : passage.b) = i;
    (leaves ? passage.end : passage.start) = fate.other;
    switch (fate.kind) {
      case Fate::handed:  // painted last
      case Fate::hidden:
        return;
      case Fate::meets:
        if (leaves) return;  // painted with its mate
        passage = {.a = fate.mate, .b = i, .move = fate.wave.value_or(Beat::move)};
        break;
      case Fate::stands:
        passage = {.a = passage.a, .b = passage.b};
        break;
      case Fate::fades:
        passage = {.a = passage.a, .b = passage.b, .leaves = leaves};
        passage.fade = swaps ? Beat::swap : leaves ? Beat::out : Beat::in;
        break;
      case Fate::follows:
        passage.move = fate.wave.value_or(Beat::move);
        passage.fade = swaps     ? Beat::swap
                       : is_text ? (leaves ? Beat::out : Beat::in)
                                 : (leaves ? Beat::under : Beat::over);
        break;
      case Fate::emerges:
        passage.move = leaves ? Beat::fold : fate.wave.value_or(Beat::grow);
        passage.fade = leaves ? Beat::dusk : fate.wave.value_or(Beat::dawn);
        break;
    }
    out_.push_back(passage);
  }

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
bool is_one_movement(const Frame& a, const Frame& b) {
  const double passed = b.time - a.time;
  return passed > 0 && passed < kChangeSeconds;
}

Motion motion_between(const Frame& a, const Frame& b) {
  return is_one_movement(a, b) ? Motion::steady : Motion::eased;
}

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

DrawList between(const DrawList& a, const DrawList& b, std::span<const Passage> passages, double t,
                 Motion motion) {
  if (t <= 0) return a;
  if (t >= 1) return b;
  DrawList list;
  list.page = b.page;
  for (const Passage& passage : passages) {
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
