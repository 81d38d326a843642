// The frame as `lantern.frame/2`, or as the version before.
#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "base/json_writer.hpp"
#include "base/stop.hpp"
#include "scenario/frame.hpp"

namespace lantern {
namespace {

// Points have as many numbers as the world has dimensions.
class FrameWriter {
 public:
  FrameWriter(const Frame& frame, FactsVersion version)
      : frame_(frame), whole_way_(version == FactsVersion::v2) {}

  std::string written() {
    json_.begin_object().line().member("format",
                                       whole_way_ ? "lantern.frame/2" : "lantern.frame/1");
    json_.line().member("scenario", frame_.scenario);
    json_.line().member("frame", frame_.index);
    json_.line().member("time", frame_.time);
    json_.line().member("step", frame_.step);
    json_.line().member("event", frame_.event);
    json_.line().member("caption", frame_.caption);
    json_.line().member("seed", frame_.seed);
    write_list("bodies", frame_.bodies);
    write_list("nodes", frame_.nodes);
    json_.line().key("pairs").begin_array();
    for (const FramePair& p : frame_.pairs) write(p.pair);
    json_.end_array();
    if (whole_way_) {
      json_.line().key("overlaps").begin_array();
      for (const FramePair& p : frame_.pairs)
        if (p.overlaps) write(p.pair);
      json_.end_array();
    }
    write_list("contacts", frame_.contacts);
    if (!frame_.links.empty()) write_list("links", frame_.links);
    if (!frame_.rays.empty()) write_list("rays", frame_.rays);
    if (!frame_.views.empty()) write_list("views", frame_.views);
    if (!frame_.queries.empty()) write_list("queries", frame_.queries);
    if (!frame_.walls.empty()) write_list("walls", frame_.walls);
    if (!frame_.textures.empty()) write_list("textures", frame_.textures);
    json_.line().key("counts").begin_object();
    for (const auto& [name, number] : frame_.counts)
      if (whole_way_ || std::ranges::find(kNewCounts, name) == std::end(kNewCounts))
        json_.line().member(name, number);
    if (!frame_.counts.empty()) json_.line();
    json_.end_object();
    if (!frame_.measures.empty()) {
      json_.line().key("measures").begin_object();
      for (const auto& [name, number] : frame_.measures) json_.line().member(name, number);
      json_.line().end_object();
    }
    if (whole_way_ && frame_.since_last_frame) write(*frame_.since_last_frame);
    json_.line().member("hash", fmt::format("{:016x}", frame_.hash));
    json_.line().end_object();
    return json_.text() + "\n";
  }

 private:
  void write(const Vec<2>& v) { json_.begin_array().value(v.x).value(v.y).end_array(); }

  void write(const Vec<3>& v) {
    json_.begin_array().value(v.x).value(v.y);
    if (frame_.dimension == 3) json_.value(v.z);
    json_.end_array();
  }

  template <class V>
  void member(std::string_view name, const V& value) {
    json_.key(name);
    write(value);
  }

  template <class T>
  void list(std::string_view name, const std::vector<T>& elements) {
    json_.key(name).begin_array();
    for (const T& element : elements) write(element);
    json_.end_array();
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

  void write(const Box<3>& box) {
    json_.begin_object();
    member("min", box.lo);
    member("max", box.hi);
    json_.end_object();
  }

  void write(const WorldWork& work) {
    json_.line().key("since_last_frame").begin_object();
    for (const WorldCounter& counter : kWorldCounters)
      json_.member(counter.name, work.*counter.count);
    json_.end_object();
  }

  void write(const Pair& pair) { json_.begin_array().value(pair.a).value(pair.b).end_array(); }
  void write(BodyId id) { json_.value(id); }

  void write(const Sphere& s) { json_.member("kind", "sphere").member("radius", s.radius); }
  void write(const AxisBox<3>& s) {
    json_.member("kind", "box");
    member("half_size", s.half_size);
  }
  void write(const OrientedBox<3>& s) {
    json_.member("kind", "oriented_box");
    member("half_size", s.half_size);
  }
  void write(const Capsule& s) {
    json_.member("kind", "capsule").member("radius", s.radius);
    json_.member("half_length", s.half_length);
  }
  void write(const HalfSpace<3>& s) {
    json_.member("kind", "half_space");
    member("normal", s.normal);
  }

  void write(const FrameBody& body) {
    json_.begin_object().member("id", body.id).member("name", body.name).key("shape");
    json_.begin_object();
    std::visit([&](const auto& shape) { write(shape); }, body.shape);
    json_.end_object();
    member("position", body.position);
    if (frame_.dimension == 2) {
      json_.member("orientation", body.angle);
    } else {
      const auto& q = body.orientation.q;
      json_.key("orientation").begin_array();
      json_.value(q.w).value(q.x).value(q.y).value(q.z).end_array();
    }
    member("velocity", body.velocity);
    if (frame_.dimension == 2)
      json_.member("angular_momentum", body.angular_momentum.z);
    else
      member("angular_momentum", body.angular_momentum);
    member("box", body.box);
    if (whole_way_ && body.stored_box && !(*body.stored_box == body.box))
      member("stored_box", *body.stored_box);
    json_.member("static", body.is_static).member("asleep", body.asleep).end_object();
  }

  void write(const FrameNode& node) {
    json_.begin_object().member("id", node.id).key("parent");
    if (node.parent == kNone)
      json_.null();
    else
      json_.value(node.parent);
    json_.member("depth", node.depth).member("label", node.label);
    if (node.plane) {
      json_.key("plane").begin_object().member("name", node.plane_name);
      member("normal", node.plane->normal);
      json_.member("offset", node.plane->offset).end_object();
    } else {
      member("box", node.box);
    }
    if (!node.region.empty()) list("region", node.region);
    json_.member("leaf", node.leaf);
    list("bodies", node.bodies);
    if (node.first != kNone) json_.member("first", node.first).member("room", node.room);
    if (node.of_static) json_.member("of_static", true);
    if (node.solid) json_.member("solid", true);
    if (node.order != kNone) json_.member("order", node.order);
    json_.member("awake", node.awake).end_object();
  }

  void write(const FrameContact::Point& point) {
    json_.begin_object();
    member("position", point.position);
    json_.member("separation", point.separation).member("impulse", point.impulse).end_object();
  }

  void write(const FrameContact& contact) {
    json_.begin_object();
    member("pair", contact.pair);
    member("normal", contact.normal);
    list("points", contact.points);
    json_.member("begins", contact.begins).end_object();
  }

  void write(const FrameLink& link) {
    static constexpr const char* kKinds[] = {"spring", "distance", "pin"};
    json_.begin_object().member("kind", kKinds[static_cast<int>(link.kind)]);
    member("from", link.from);
    member("to", link.to);
    json_.member("strain", link.strain).end_object();
  }

  void write(const FrameRay::Hit& hit) {
    json_.begin_object().member("body", hit.body);
    member("position", hit.position);
    json_.end_object();
  }

  void write(const FrameRay& ray) {
    json_.begin_object();
    member("from", ray.from);
    member("to", ray.to);
    list("hits", ray.hits);
    json_.end_object();
  }

  void write(const FrameView& view) {
    json_.begin_object();
    member("eye", view.eye);
    list("corners", view.corners);
    json_.end_object();
  }

  void write(const FrameQuery& query) {
    json_.begin_object();
    member("box", query.box);
    json_.member("radius", query.radius).end_object();
  }

  void write(const FrameWall& wall) {
    json_.begin_object().member("wall", wall.wall);
    member("from", wall.from);
    member("to", wall.to);
    if (wall.node != kNone) json_.member("node", wall.node);
    json_.end_object();
  }

  void write(const FrameTexture& texture) {
    json_.begin_object().member("id", texture.id).member("name", texture.name);
    json_.key("size").begin_array().value(texture.width).value(texture.height).end_array();
    json_.key("position");
    if (texture.packed)
      json_.begin_array().value(texture.x).value(texture.y).end_array();
    else
      json_.null();
    json_.member("refused", texture.refused).end_object();
  }

  static constexpr std::string_view kNewCounts[] = {"testable_pairs", "pairs_tested", "impulses",
                                                    "leaves_asleep", "branches_asleep"};

  const Frame& frame_;
  bool whole_way_;
  JsonWriter json_;
};

}  // namespace

std::string to_json(const Frame& frame, FactsVersion version) {
  return FrameWriter(frame, version).written();
}

}  // namespace lantern
