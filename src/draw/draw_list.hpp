// A frame as shapes in page units, by role: what every renderer takes. The origin is the page's
// upper left corner, y points down, a page is at least 1600 x 900 units. Shapes are painted in
// order.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "draw/theme.hpp"
#include "geometry/box.hpp"

namespace lantern::draw {

// The marks of worlds and trees: one mark, one meaning, in all sequences; in the order of the
// legend.
enum class MarkKind : std::uint8_t {
  lit,
  passed,
  not_made,
  sleeping_cell,
  static_body,
  sleeping_body,
  ruled_out,       // a pale body: culled, or not met by the ray
  refused,         // a stroke through a body: tested, in vain
  candidate,       // a link: this pair is to be tested
  faint_pair,      // the same among many
  boxes_apart,     // a dotted link: ruled out, the boxes do not overlap
  shapes_apart,    // a dotted link with a cross: the boxes overlap, the shapes do not touch
  box_overlap,     // a frame: what two boxes share
  missed,          // the same, crossed, in red: a stale structure does not name the pair
  contact,         // a short bar along the normal: they touch
  contact_begins,  // a ring round it: since this step
  impulse,         // an arrow from a contact: how strongly it pushes
  velocity,        // a thin arrow
  spin,            // a line through a body with an arrow round its end
  longest_axis,    // of a box's own three, lines out of its faces
  middle_axis,
  shortest_axis,
  force,  // a heavy arrow, with its size
  ruler,  // a line between two ticks: a length
  box,    // round a body, in the broad phase
  ray,
  ray_hit,  // a disc on a ray
  met,      // a number on a plate: the order in which a ray meets cells
  view,
  region,
  found,    // a tick: what a view or region has found
  skipped,  // a disc with a cross: left out, with all below
  centre,   // a plus
  spring,
  rod,
  pin,             // a ring with a dot: two points held together
  shadow,          // a bar beside an axis: how far a body reaches along it
  shadow_gap,      // between two ticks: the bodies are apart along this axis
  shadow_overlap,  // a frame: what two shadows share
  support,         // a disc: the point farthest along a search's direction
  simplex,         // discs and lines: points of a search that have the nearest place between them
  origin,          // a ring with a dot, of a Minkowski difference
  portal,          // a strong dashed line: an opening between two sectors
  sight,           // a thin line between two dots: the sectors at its ends see each other
  trail,           // outlines on a line: where a body was, step by step
  ahead,           // a dotted outline: where it would be after the step
  look,            // an outline with a time: a look for the moment of an impact
  count_,
};

inline constexpr auto kMarkKinds = static_cast<unsigned>(MarkKind::count_);

// Those that are on a picture.
class MarkSet {
 public:
  void add(MarkKind kind) { bits_ |= std::uint64_t{1} << static_cast<unsigned>(kind); }
  bool has(MarkKind kind) const { return (bits_ >> static_cast<unsigned>(kind) & 1u) != 0; }
  bool operator==(const MarkSet&) const = default;

 private:
  std::uint64_t bits_ = 0;
};

struct Stroke {
  Role role = Role::none;
  double width = 0;  // page units; centred on the outline
  double dash = 0;   // length of a dash and of the gap after it; 0 is an unbroken line
  bool operator==(const Stroke&) const = default;
};

struct RectShape {
  Box<2> box;
  double radius = 0;  // of the corners; half the smaller side makes a disc or a pill
  Role fill = Role::none;
  Stroke stroke = {};
  bool snapped = false;  // edges on whole pixels: for axis-aligned lines that must be crisp
  bool operator==(const RectShape&) const = default;
};

struct LineShape {
  Vec<2> from{0.0};
  Vec<2> to{0.0};
  Stroke stroke = {};    // round caps
  bool snapped = false;  // a horizontal or vertical line, put on whole pixels
  bool operator==(const LineShape&) const = default;
};

// A simple polygon, convex or not, its corners in order round it.
struct PolygonShape {
  std::vector<Vec<2>> points;
  Role fill = Role::none;
  Stroke stroke = {};
  bool operator==(const PolygonShape&) const = default;
};

// Of the typeface; `code` has letters of one width, for the lines of a program.
enum class Weight { regular, semibold, code };
inline constexpr std::array kWeights = {Weight::regular, Weight::semibold, Weight::code};

struct TextShape {
  std::string text;  // UTF-8, one line
  Vec<2> at{0.0};    // left end, centre or right end of the baseline, by `align`
  double size = 0;   // em, page units
  Weight weight = Weight::regular;
  double align = 0;  // 0 left, 0.5 centre, 1 right
  Role role = Role::ink;
  Role halo = Role::none;  // painted 3 units around the letters when not none
  bool operator==(const TextShape&) const = default;
};

using DrawShape = std::variant<RectShape, LineShape, PolygonShape, TextShape>;

// f(number) for every coordinate, length and size of a shape.
template <class Shape, class F>
void for_each_measure(Shape& shape, const F& f) {
  const auto of_point = [&](auto& p) { f(p.x), f(p.y); };
  if constexpr (requires { shape.box; })
    of_point(shape.box.lo), of_point(shape.box.hi), f(shape.radius);
  if constexpr (requires { shape.from; }) of_point(shape.from), of_point(shape.to);
  if constexpr (requires { shape.points; })
    for (auto& p : shape.points) of_point(p);
  if constexpr (requires { shape.text; }) of_point(shape.at), f(shape.size);
  if constexpr (requires { shape.stroke; }) f(shape.stroke.width), f(shape.stroke.dash);
}

// A text's place, for the layout test: labels overlap neither each other nor their panel's edge.
struct LabelBox {
  Box<2> box;
  Box<2> panel;
  std::string text;
};

// What a run of shapes shows. The same key on the next frame is the same thing: it stands still or
// glides there. One that is new comes out of `from`, and one that is gone goes back into it.
struct KeyedRun {
  std::string key;        // "world/body/blue", "tree/node/1.3"; empty: of the page
  std::string from;       // another key, or empty: it appears where it stands
  std::size_t first = 0;  // of `shapes`; it reaches to the next run's
};

// How a shape of an in-between is painted: on its way from one role's colour to another's, or on
// its way in or out.
struct Tint {
  double opacity = 1;      // of all of it, 0 ... 1
  double share = 0;        // of the roles below in its colours, 0 ... 1; the rest are its own
  Role fill = Role::none;  // beside the shape's fill, or a text's role
  Role line = Role::none;  // beside its stroke's role, or a text's halo
};

// Where a flat world lies on the page, for whoever must find in it what is not painted: its point p
// is at origin + (p.x, -p.y) * scale.
struct WorldMap {
  std::string prefix;  // of its keys
  Box<2> picture;      // the part of the page that the world takes
  Vec<2> origin{0.0};
  double scale = 1;
};

// Where a solid world is on the page: with the frame's bounds and camera, its View3D.
struct SolidPanel {
  std::string prefix;  // of its keys
  Box<2> panel;
};

struct DrawList {
  Vec<2> page{1600.0, 900.0};
  std::vector<DrawShape> shapes;
  std::vector<BodyPaint> paints = {};  // in place of bodies' colours
  std::vector<Tint> tints;  // one for each shape, or none at all: painted as they say themselves
  std::vector<LabelBox> labels;
  std::vector<KeyedRun> runs;  // in the order of the shapes
  std::size_t open_scopes = 0;
  std::string prefix;          // of the keys to come: "eager/" while that side is drawn
  std::vector<WorldMap> maps;  // of the flat worlds on the page
  std::vector<SolidPanel> solids;
  MarkSet marks;     // that are among the shapes, for a legend
  int left_out = 0;  // panels that had no room
  // Counts and measures that the page depicts, so that whoever reads one in the caption finds it.
  std::set<std::string, std::less<>> referents;

  // Leaves room for the runs that open scopes and one more will put back.
  void begin_run(KeyedRun run) {
    const std::size_t room = runs.size() + open_scopes + 2;
    if (room > runs.capacity()) runs.reserve(2 * room);
    runs.push_back(std::move(run));
  }

  // What follows shows this, until the scope ends; then what was shown before goes on. An end needs
  // no memory: each open scope has taken the room for it beforehand.
  class Scope {
   public:
    Scope(DrawList& list, std::string key, std::string from = {}) : list_(list) {
      if (!list.runs.empty()) before_ = {list.runs.back().key, list.runs.back().from, 0};
      for (std::string* name : {&key, &from})
        if (!name->empty()) name->insert(0, list.prefix);
      list.begin_run({std::move(key), std::move(from), list.shapes.size()});
      ++list.open_scopes;
    }
    ~Scope() {
      --list_.open_scopes;
      before_.first = list_.shapes.size();
      list_.runs.push_back(std::move(before_));
    }
    Scope& operator=(Scope&&) = delete;  // nor any other copy or move

   private:
    DrawList& list_;
    KeyedRun before_;
  };

  // What is being shown now, without the prefix, as a scope was told it.
  KeyedRun shown() const {
    if (runs.empty()) return {};
    KeyedRun now = runs.back();
    for (std::string* name : {&now.key, &now.from})
      if (name->starts_with(prefix)) name->erase(0, prefix.size());
    return now;
  }

  void line(const Vec<2>& from, const Vec<2>& to, const Stroke& stroke) {
    shapes.emplace_back(LineShape{from, to, stroke, false});
  }
  void rect(const Box<2>& box, Role fill, const Stroke& stroke = {}, double radius = 0) {
    shapes.emplace_back(RectShape{box, radius, fill, stroke, false});
  }
  // The same on whole pixels: a level or upright line, a rectangle with sharp corners.
  void crisp_line(const Vec<2>& from, const Vec<2>& to, const Stroke& stroke) {
    shapes.emplace_back(LineShape{from, to, stroke, true});
  }
  void crisp_rect(const Box<2>& box, Role fill, const Stroke& stroke = {}) {
    shapes.emplace_back(RectShape{box, 0, fill, stroke, true});
  }
  void disc(const Vec<2>& center, double radius, Role fill, const Stroke& stroke = {}) {
    rect(Box<2>::around(center, Vec<2>(radius)), fill, stroke, radius);
  }
  void polygon(std::vector<Vec<2>> points, Role fill, const Stroke& stroke = {}) {
    shapes.emplace_back(PolygonShape{std::move(points), fill, stroke});
  }
};

inline constexpr double kLeastCaption = 24;  // of 900: nothing that is read is smaller
inline constexpr double kLeastLabel = 24;
inline constexpr double kLabel = 24;
inline constexpr double kLeastDeskLabel = 17.1;  // on pages that are read at a desk
inline constexpr double kDeskLabel = 19;

// The least of `box` that a text or shape `inset` inside it may use.
inline Box<2> shrunk(const Box<2>& box, double inset) {
  return {box.lo + Vec<2>(inset), box.hi - Vec<2>(inset)};
}

inline bool holds(const Box<2>& outer, const Box<2>& inner) {
  return outer.lo.x <= inner.lo.x && outer.lo.y <= inner.lo.y && inner.hi.x <= outer.hi.x &&
         inner.hi.y <= outer.hi.y;
}

// Parts of an area beside each other along an axis, as wide as their shares, with gaps between
// them.
inline std::vector<Box<2>> split(const Box<2>& area, int axis, const std::vector<double>& shares,
                                 double gap) {
  const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
  const double room = area.size()[axis] - gap * (static_cast<double>(shares.size()) - 1);
  std::vector<Box<2>> parts;
  double at = area.lo[axis];
  for (const double share : shares) {
    Box<2>& part = parts.emplace_back(area);
    part.lo[axis] = at;
    part.hi[axis] = at + room * share / all;
    at = part.hi[axis] + gap;
  }
  return parts;
}

}  // namespace lantern::draw
