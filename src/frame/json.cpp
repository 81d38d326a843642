// The frame as `lantern.frame/2`.
#include <algorithm>

#include <fmt/format.h>

#include "frame/part_fields.hpp"

namespace lantern::frame {
namespace {

class FrameWriter {
 public:
  explicit FrameWriter(const Frame& frame) : frame_(frame), facts_(json_, frame.dimension) {}

  std::string written() {
    json_.begin_object();
    facts_.line("format", fmt::format("lantern.frame/{}", kFactsVersion))
        .line("scenario", frame_.scenario)
        .line("frame", frame_.index)
        .line("time", frame_.time)
        .line("step", frame_.step)
        .line("event", frame_.event)
        .line("caption", frame_.caption)
        .line("seed", frame_.seed);
    if (frame_.ending) facts_.line("ending", true);
    if (!frame_.headline.empty()) facts_.line("headline", frame_.headline);
    write_part(part_type<FrameQuestion>(), frame_);
    if (!frame_.sides.empty())
      facts_.list("sides", frame_.sides, [&](const Frame& side) { write_side(side); });
    write_facts(frame_);
    json_.line().end_object();
    return json_.text() + "\n";
  }

 private:
  // A side has the same facts as a frame without sides.
  void write_side(const Frame& side) {
    const FrameSide& own = side.get<FrameSide>();
    json_.begin_object();
    facts_.line("name", own.name)
        .line("title", own.title)
        .line("held", own.held)
        .line("time", side.time)
        .line("event", side.event)
        .line("caption", side.caption);
    write_facts(side);
    json_.line().end_object();
  }

  void write_facts(const Frame& frame) {
    if (frame.phase != StepPhase::whole)
      facts_.line("phase", kPhases[static_cast<std::size_t>(frame.phase)]);
    facts_.line("view", frame.view).line("camera", frame.camera);
    if (!frame.notes.empty())
      facts_.list("notes", frame.notes, [&](const FrameNote& note) { write(note); });
    facts_.list("bodies", frame.bodies, [&](const FrameBody& body) { write(body); });
    facts_.list("nodes", frame.nodes, [&](const FrameNode& node) { write(node); });
    std::vector<Pair> pairs, overlaps;
    for (const FramePair& p : frame.pairs) {
      pairs.push_back(p.pair);
      if (p.overlaps) overlaps.push_back(p.pair);
    }
    facts_.line("pairs", pairs).line("overlaps", overlaps);
    if (frame.count("pairs_tested")) facts_.line("tested", frame.tested);
    facts_.line("contacts", frame.contacts);
    write_parts(frame);
    write_numbers("counts", frame.counts);
    if (!frame.measures.empty()) write_numbers("measures", frame.measures);
    if (frame.since_last_frame) {
      json_.line().key("since_last_frame").begin_object();
      for (const WorldCounter& counter : kWorldCounters)
        facts_.member(counter.name, *frame.since_last_frame.*counter.count);
      json_.end_object();
    }
    facts_.line("hash", fmt::format("{:016x}", frame.hash));
  }

  void write_part(const PartType& type, const Frame& frame) {
    frame.each_part([&](const PartType& of, const std::any& part) {
      if (&of == &type) type.write(part, frame_.dimension, json_);
    });
  }

  void write_parts(const Frame& frame) {
    std::vector<const PartType*> others;
    for (const PartType* type : part_order()) write_part(*type, frame);
    frame.each_part([&](const PartType& type, const std::any&) {
      const bool told = &type == &part_type<FrameQuestion>();  // above the sides
      if (!told && std::ranges::count(part_order(), &type) == 0) others.push_back(&type);
    });
    std::ranges::sort(others, {}, &PartType::name);
    for (const PartType* type : others) write_part(*type, frame);
  }

  template <class V>
  void write_numbers(std::string_view name, const std::vector<std::pair<std::string, V>>& numbers) {
    json_.line().key(name).begin_object();
    for (const auto& [of, number] : numbers) facts_.line(of, number);
    if (!numbers.empty()) json_.line();
    json_.end_object();
  }

  void write(const FrameNote& note) {
    json_.begin_object();
    facts_.member("text", note.text);
    if (note.of == NoteOf::body) facts_.member("body", note.bodies.at(0));
    if (note.of == NoteOf::pair) facts_.member("pair", note.bodies);
    if (note.of == NoteOf::node) facts_.member("node", note.node);
    if (note.of == NoteOf::count) facts_.member("count", note.count);
    if (note.of == NoteOf::point) facts_.member("point", note.point);
    json_.end_object();
  }

  void write(const Sphere& s) { facts_.member("kind", "sphere").member("radius", s.radius); }
  void write(const AxisBox<3>& s) { facts_.member("kind", "box").member("half_size", s.half_size); }
  void write(const OrientedBox<3>& s) {
    facts_.member("kind", "oriented_box").member("half_size", s.half_size);
  }
  void write(const Capsule& s) {
    facts_.member("kind", "capsule")
        .member("radius", s.radius)
        .member("half_length", s.half_length);
  }
  void write(const HalfSpace<3>& s) {
    facts_.member("kind", "half_space").member("normal", s.normal);
  }

  void write(const FrameBody& body) {
    json_.begin_object();
    facts_.member("id", body.id).member("name", body.name);
    json_.key("shape").begin_object();
    std::visit([&](const auto& shape) { write(shape); }, body.shape);
    json_.end_object();
    facts_.member("position", body.position);
    if (frame_.dimension == 2) {
      facts_.member("orientation", body.angle)
          .member("velocity", body.velocity)
          .member("angular_momentum", body.angular_momentum.z)
          .member("spin", body.angular_velocity.z);
    } else {
      const auto& q = body.orientation.q;
      facts_.member("orientation", std::vector{q.w, q.x, q.y, q.z})
          .member("velocity", body.velocity)
          .member("angular_momentum", body.angular_momentum)
          .member("spin", body.angular_velocity);
    }
    facts_.member("box", body.box);
    if (body.stored_box && !(*body.stored_box == body.box))
      facts_.member("stored_box", *body.stored_box);
    facts_.member("static", body.is_static).member("asleep", body.asleep);
    json_.end_object();
  }

  void write(const FrameNode& node) {
    json_.begin_object();
    FieldWriter v(facts_, false);
    v("id", node.id)
        .or_null(node.parent != kNone, "parent", node.parent)("depth", node.depth)("label",
                                                                                   node.label);
    if (node.plane) {
      json_.key("plane").begin_object();
      v("name", node.plane_name)("normal", node.plane->normal)("offset", node.plane->offset);
      json_.end_object();
    } else {
      v("box", node.box);
    }
    v.when(!node.region.empty(), "region", node.region)("leaf", node.leaf)("bodies", node.bodies);
    if (node.first != kNone) v("first", node.first)("room", node.room);
    if (node.pool_slot != kNone) v("pool_slot", node.pool_slot)("reused", node.reused);
    v.when(node.of_static, "of_static", true)
        .when(node.solid, "solid", true)
        .when(node.order != kNone, "order", node.order)
        .when(node.unseen, "unseen", true)
        .when(node.met != kNone, "met", node.met)
        .when(node.skipped, "skipped", true)("awake", node.awake);
    json_.end_object();
  }

  static constexpr std::string_view kPhases[] = {"whole", "broad", "boxes", "narrow", "resolve"};

  const Frame& frame_;
  JsonWriter json_;
  FactsWriter facts_;
};

}  // namespace

std::string to_json(const Frame& frame) { return FrameWriter(frame).written(); }

}  // namespace lantern::frame
