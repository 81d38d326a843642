// The frame as `lantern.frame/2`, or as the version before.
#include <algorithm>
#include <concepts>
#include <iterator>
#include <type_traits>

#include <fmt/format.h>

#include "base/json_writer.hpp"
#include "base/stop.hpp"
#include "scenario/frame.hpp"

namespace lantern::scenario {
namespace {

// Points have as many numbers as the world has dimensions.
class FrameWriter {
 public:
  FrameWriter(const Frame& frame, FactsVersion version)
      : frame_(frame), whole_way_(version == FactsVersion::v2) {}

  std::string written() {
    json_.begin_object();
    lines("format", whole_way_ ? "lantern.frame/2" : "lantern.frame/1", "scenario", frame_.scenario,
          "frame", frame_.index, "time", frame_.time, "step", frame_.step, "event", frame_.event,
          "caption", frame_.caption, "seed", frame_.seed);
    if (frame_.ending) lines("ending", true);
    if (!frame_.headline.empty()) lines("headline", frame_.headline);
    if (whole_way_ && frame_.question) lines("question", *frame_.question);
    if (!frame_.sides.empty()) write_list("sides", frame_.sides);
    write_facts(frame_);
    json_.line().end_object();
    return json_.text() + "\n";
  }

 private:
  void write_facts(const Frame& frame) {
    if (whole_way_ && frame.phase != StepPhase::whole)
      lines("phase", kPhases[static_cast<std::size_t>(frame.phase)]);
    if (whole_way_ && frame.view) lines("view", *frame.view);
    if (whole_way_ && frame.camera) lines("camera", *frame.camera);
    if (whole_way_ && !frame.notes.empty()) write_list("notes", frame.notes);
    write_list("bodies", frame.bodies);
    write_list("nodes", frame.nodes);
    std::vector<Pair> pairs, overlaps;
    for (const FramePair& p : frame.pairs) {
      pairs.push_back(p.pair);
      if (p.overlaps) overlaps.push_back(p.pair);
    }
    lines("pairs", pairs);
    if (whole_way_) lines("overlaps", overlaps);
    if (whole_way_ && frame.count("pairs_tested")) lines("tested", frame.tested);
    write_list("contacts", frame.contacts);
    if (!frame.links.empty()) write_list("links", frame.links);
    if (whole_way_ && !frame.islands.empty()) write_list("islands", frame.islands);
    if (!frame.forces.empty()) write_list("forces", frame.forces);
    if (!frame.rulers.empty()) write_list("rulers", frame.rulers);
    if (whole_way_ && !frame.looks.empty()) write_list("looks", frame.looks);
    if (!frame.rays.empty()) write_list("rays", frame.rays);
    if (!frame.views.empty()) write_list("views", frame.views);
    if (!frame.queries.empty()) write_list("queries", frame.queries);
    if (whole_way_) write_narrow(frame);
    if (!frame.walls.empty()) write_list("walls", frame.walls);
    if (!frame.portals.empty()) write_list("portals", frame.portals);
    if (!frame.sights.empty()) write_list("sights", frame.sights);
    if (!frame.matrix.rows.empty()) lines("matrix", frame.matrix.rows);
    if (!frame.textures.empty()) write_list("textures", frame.textures);
    if (!frame.comparison.rows.empty()) write_list("comparison", frame.comparison.rows);
    if (frame.code) lines("code", *frame.code);
    if (frame.collisions) write_list("collisions", frame.collisions->rows);
    if (whole_way_ && !frame.screen.elements.empty()) lines("screen", frame.screen);
    json_.line().key("counts").begin_object();
    for (const auto& [name, number] : frame.counts)
      if (whole_way_ || std::ranges::find(kNewCounts, name) == std::end(kNewCounts))
        lines(name, number);
    if (!frame.counts.empty()) json_.line();
    json_.end_object();
    if (!frame.measures.empty()) {
      json_.line().key("measures").begin_object();
      for (const auto& [name, number] : frame.measures) lines(name, number);
      json_.line().end_object();
    }
    if (whole_way_ && frame.since_last_frame) lines("since_last_frame", *frame.since_last_frame);
    lines("hash", fmt::format("{:016x}", frame.hash));
  }

  // How two bodies were measured.
  void write_narrow(const Frame& frame) {
    if (frame.separation) {
      write_list("axes", frame.separation->axes);
      if (frame.separation->answer) lines("answer", *frame.separation->answer);
    }
    if (frame.search) write_list("searches", frame.search->steps);
    if (frame.difference)
      lines("difference", frame.difference->corners, "radius", frame.difference->radius);
  }

  // Names and values in turn: within a line, each on a line of its own, or as an object.
  template <class V, class... More>
  void members(std::string_view name, const V& value, const More&... more) {
    json_.key(name);
    write(value);
    if constexpr (sizeof...(more) > 0) members(more...);
  }
  template <class V, class... More>
  void lines(std::string_view name, const V& value, const More&... more) {
    json_.line();
    members(name, value);
    if constexpr (sizeof...(more) > 0) lines(more...);
  }
  template <class... Members>
  void object(const Members&... all) {
    json_.begin_object();
    members(all...);
    json_.end_object();
  }

  // One element a line.
  template <class T>
  void write_list(std::string_view name, const std::vector<T>& elements) {
    json_.line().key(name).begin_array();
    for (const T& element : elements) {
      stop_if_asked();
      json_.line();
      write(element);
    }
    if (!elements.empty()) json_.line();
    json_.end_array();
  }

  template <class V>
  requires(std::is_arithmetic_v<V> ||
           std::convertible_to<V, std::string_view>) void write(const V& value) {
    json_.value(value);
  }

  template <class T>
  void write(const std::vector<T>& elements) {
    json_.begin_array();
    for (const T& element : elements) write(element);
    json_.end_array();
  }

  void write(const Vec<2>& v) { json_.begin_array().value(v.x).value(v.y).end_array(); }
  void write(const Vec<3>& v) {
    json_.begin_array().value(v.x).value(v.y);
    if (frame_.dimension == 3) json_.value(v.z);
    json_.end_array();
  }
  void write(const Box<2>& box) { object("min", box.lo, "max", box.hi); }
  void write(const Camera& camera) { object("eye", camera.eye, "target", camera.target); }
  void write(const FrameQuestion& question) {
    object("asked", question.asked, "answer", question.answer);
  }
  void write(const FrameNote& note) {
    json_.begin_object();
    members("text", note.text);
    if (note.of == NoteOf::body) members("body", note.bodies.at(0));
    if (note.of == NoteOf::pair) members("pair", note.bodies);
    if (note.of == NoteOf::node) members("node", note.node);
    if (note.of == NoteOf::count) members("count", note.count);
    if (note.of == NoteOf::point) members("point", note.point);
    json_.end_object();
  }
  void write(const Box<3>& box) { object("min", box.lo, "max", box.hi); }
  void write(const Pair& pair) { json_.begin_array().value(pair.a).value(pair.b).end_array(); }

  void write(const WorldWork& work) {
    json_.begin_object();
    for (const WorldCounter& counter : kWorldCounters) members(counter.name, work.*counter.count);
    json_.end_object();
  }

  void write(const Sphere& s) { object("kind", "sphere", "radius", s.radius); }
  void write(const AxisBox<3>& s) { object("kind", "box", "half_size", s.half_size); }
  void write(const OrientedBox<3>& s) { object("kind", "oriented_box", "half_size", s.half_size); }
  void write(const Capsule& s) {
    object("kind", "capsule", "radius", s.radius, "half_length", s.half_length);
  }
  void write(const HalfSpace<3>& s) { object("kind", "half_space", "normal", s.normal); }

  // A side has the same facts as a frame without sides.
  void write(const Frame& side) {
    json_.begin_object();
    lines("name", side.side, "title", side.side_title, "held", side.held, "time", side.time,
          "event", side.event, "caption", side.caption);
    write_facts(side);
    json_.line().end_object();
  }

  void write(const FrameBody& body) {
    json_.begin_object();
    members("id", body.id, "name", body.name);
    json_.key("shape");
    std::visit([&](const auto& shape) { write(shape); }, body.shape);
    members("position", body.position);
    if (frame_.dimension == 2) {
      members("orientation", body.angle, "velocity", body.velocity, "angular_momentum",
              body.angular_momentum.z);
    } else {
      const auto& q = body.orientation.q;
      members("orientation", std::vector{q.w, q.x, q.y, q.z}, "velocity", body.velocity,
              "angular_momentum", body.angular_momentum);
    }
    if (whole_way_ && frame_.dimension == 2) members("spin", body.angular_velocity.z);
    if (whole_way_ && frame_.dimension == 3) members("spin", body.angular_velocity);
    members("box", body.box);
    if (whole_way_ && body.stored_box && !(*body.stored_box == body.box))
      members("stored_box", *body.stored_box);
    members("static", body.is_static, "asleep", body.asleep);
    json_.end_object();
  }

  void write(const FrameNode& node) {
    json_.begin_object();
    members("id", node.id);
    json_.key("parent");
    node.parent == kNone ? json_.null() : json_.value(node.parent);
    members("depth", node.depth, "label", node.label);
    if (node.plane) {
      json_.key("plane");
      object("name", node.plane_name, "normal", node.plane->normal, "offset", node.plane->offset);
    } else {
      members("box", node.box);
    }
    if (!node.region.empty()) members("region", node.region);
    members("leaf", node.leaf, "bodies", node.bodies);
    if (node.first != kNone) members("first", node.first, "room", node.room);
    if (node.pool_slot != kNone) members("pool_slot", node.pool_slot, "reused", node.reused);
    if (node.of_static) members("of_static", true);
    if (node.solid) members("solid", true);
    if (node.order != kNone) members("order", node.order);
    if (node.unseen) members("unseen", true);
    if (node.met != kNone) members("met", node.met);
    if (node.skipped) members("skipped", true);
    members("awake", node.awake);
    json_.end_object();
  }

  void write(const FrameContact::Point& p) {
    object("position", p.position, "separation", p.separation, "impulse", p.impulse);
  }
  void write(const FrameContact& c) {
    object("pair", c.pair, "normal", c.normal, "points", c.points, "begins", c.begins, "crushes",
           c.crushes);
  }
  void write(const FrameLink& link) {
    static constexpr std::string_view kKinds[] = {"spring", "distance", "pin"};
    object("kind", kKinds[static_cast<int>(link.kind)], "from", link.from, "to", link.to, "strain",
           link.strain);
  }
  void write(const FrameIsland& island) {
    object("number", island.number, "bodies", island.bodies, "asleep", island.asleep);
  }
  void write(const FrameForce& f) {
    object("body", f.body, "at", f.at, "force", f.force, "of_spring", f.of_spring);
  }
  void write(const FrameRuler& ruler) {
    json_.begin_object();
    members("from", ruler.from, "to", ruler.to, "length", ruler.length);
    if (ruler.before) members("before", *ruler.before);
    json_.end_object();
  }
  void write(const FramePlace& place) {
    frame_.dimension == 2 ? object("position", place.position, "orientation", place.angle)
                          : object("position", place.position);
  }
  void write(const FrameLook& look) {
    object("pair", look.pair, "a", look.a, "b", look.b, "time", look.time, "gap", look.gap,
           "free_until", look.free_until, "meets", look.meets);
  }
  void write(const FrameRay::Hit& hit) { object("body", hit.body, "position", hit.position); }
  void write(const FrameRay& ray) { object("from", ray.from, "to", ray.to, "hits", ray.hits); }
  void write(const FrameView& view) { object("eye", view.eye, "corners", view.corners); }
  void write(const FrameQuery& query) { object("box", query.box, "radius", query.radius); }

  void write(const FrameAxis& axis) {
    json_.begin_object();
    members("direction", axis.direction, "separation", axis.separation);
    if (axis.across) members("across", *axis.across);
    json_.end_object();
  }
  void write(const SupportPair& p) { object("a", p.a, "b", p.b); }
  void write(const GjkStep& step) {
    object("direction", step.direction, "found", step.found, "simplex", step.simplex, "nearest",
           step.nearest);
  }

  void write(const FrameWall& wall) {
    json_.begin_object();
    members("wall", wall.wall, "from", wall.from, "to", wall.to);
    if (wall.node != kNone) members("node", wall.node);
    json_.end_object();
  }

  void write(const FrameComparison::Cell& cell) {
    object("kind", to_string(cell.kind), "build", cell.work.build, "renew", cell.work.renew, "pair",
           cell.work.pair, "pairs", cell.work.pairs, "overlaps", cell.work.overlaps);
  }
  void write(const FrameComparison::Row& row) {
    object("row", row.name, "answer", row.answer, "bodies", row.bodies, "testable_pairs",
           row.testable, "kinds", row.cells);
  }

  void write(const FramePortal& p) {
    object("from", p.from, "to", p.to, "nodes", std::vector{p.a, p.b});
  }

  void write(const FrameTexture& t) {
    json_.begin_object();
    members("id", t.id, "name", t.name, "size", std::vector{t.width, t.height});
    json_.key("position");
    t.packed ? write(std::vector{t.x, t.y}) : static_cast<void>(json_.null());
    members("refused", t.refused);
    json_.end_object();
  }

  // Where it stands, and which lines of it the frame is about.
  void write(const FrameCode& code) {
    std::vector<std::uint32_t> lit;
    for (const FrameCode::Line& line : code.lines)
      if (line.lit) lit.push_back(line.number);
    object("file", code.file, "function", code.function, "lit", lit);
  }
  void write(const FrameCollision::Moment& m) {
    object("step", m.step, "frames_left", m.frames_left, "touches", m.touches, "begins", m.begins);
  }
  void write(const FrameCollision& c) { object("pair", c.pair, "moments", c.moments); }

  void write(const FrameElement& e) {
    object("texture", e.texture, "position", std::vector{e.x, e.y}, "drawn", e.drawn);
  }
  void write(const FrameDraw& d) { object("element", d.element, "binds", d.binds, "done", d.done); }
  void write(const FrameWay& way) {
    object("from", way.from_atlas ? "atlas" : "textures", "order",
           way.by_texture ? "by_texture" : "as_listed", "bindings", way.bindings, "draws",
           way.draws);
  }
  void write(const FrameScreen& screen) {
    object("size", std::vector{screen.width, screen.height}, "elements", screen.elements, "ways",
           screen.ways);
  }

  static constexpr std::string_view kNewCounts[] = {
      "testable_pairs", "pairs_tested",   "impulses",        "leaves_asleep",    "branches_asleep",
      "islands",        "largest_island", "islands_asleep",  "collisions_alive", "begins_in_all",
      "touches_in_all", "impact_looks",   "impacts_located", "bindings",         "draws"};

  static constexpr std::string_view kPhases[] = {"whole", "broad", "boxes", "narrow", "resolve"};

  const Frame& frame_;
  bool whole_way_;
  JsonWriter json_;
};

}  // namespace

std::string to_json(const Frame& frame, FactsVersion version) {
  return FrameWriter(frame, version).written();
}

}  // namespace lantern::scenario
