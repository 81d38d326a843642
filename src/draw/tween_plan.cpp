#include "draw/tween_plan.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "draw/tween_shapes.hpp"

namespace lantern::draw {
namespace {

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

class Planner {
 public:
  Planner(const DrawList& a, const DrawList& b)
      : a_(a),
        b_(b),
        in_a_(things_of(a)),
        in_b_(things_of(b)),
        of_a_(a.shapes.size()),
        of_b_(b.shapes.size()) {}

  TweenPlan made() {
    for (const auto& [key, thing] : in_b_) come(key, thing);
    for (const auto& [key, thing] : in_a_)
      if (!in_b_.contains(key)) go(key, thing);
    return {std::move(of_a_), std::move(of_b_)};
  }

 private:
  using Shapes = std::vector<std::size_t>;

  void come(const std::string& key, const Thing& thing) {
    const auto before = in_a_.find(key);
    if (key.starts_with(kPage)) {
      if (before != in_a_.end()) set(before->second, Fate::hidden, of_a_);
      return set(thing, Fate::stands, of_b_);
    }
    if (key.empty()) return match_equal(in_a_.at(key).shapes, thing.shapes);
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
    if (key.starts_with(kPage)) return set(thing, Fate::hidden, of_a_);
    if (of_a_[thing.shapes[0]].kind == Fate::hidden) return;
    const auto* end = origin_of(thing.from, in_b_);
    if (end && !in_a_.contains(end->first) && pair_up(end->second, thing, of_a_))
      return set(end->second, Fate::hidden, of_b_);
    leave(key, thing, end, of_a_);
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

  const DrawList &a_, &b_;
  Things in_a_, in_b_;
  std::vector<Fate> of_a_, of_b_;
};

}  // namespace

TweenPlan plan_tween(const DrawList& a, const DrawList& b) { return Planner(a, b).made(); }

}  // namespace lantern::draw
