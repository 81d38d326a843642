#include "frame/frame.hpp"

#include <fmt/format.h>

#include "frame/pair_state.hpp"
#include "frame/panel.hpp"
#include "frame/part_fields.hpp"
#include "frame/parts/asked.hpp"
#include "frame/parts/atlas.hpp"
#include "frame/parts/ground.hpp"
#include "frame/parts/level.hpp"
#include "frame/parts/motion.hpp"
#include "frame/parts/panels.hpp"
#include "language/counts.hpp"
#include "spatial/pairs.hpp"

namespace lantern::frame {
namespace {

void add(Hash& hash, const Vec<3>& v, int dimension) {
  for (int i = 0; i < dimension; ++i) hash.add(v[i]);
}

void add(Hash& hash, const FrameBody& body, int dimension) {
  hash.add(std::uint64_t{body.id});
  add(hash, body.position, dimension);
  add(hash, body.velocity, dimension);
  if (dimension == 2) {
    hash.add(body.angle).add(body.angular_momentum.z);
    return;
  }
  const auto& q = body.orientation.q;
  for (const double x : {q.w, q.x, q.y, q.z}) hash.add(x);
  add(hash, body.angular_momentum, dimension);
}

// What `get` finds in the side that the name begins with.
auto in_side(const Frame& frame, std::string_view name, const auto& get)
    -> decltype(get(frame, name)) {
  const std::size_t dot = name.find('.');
  const Frame* side =
      dot == std::string_view::npos ? nullptr : frame.side_named(name.substr(0, dot));
  return side ? get(*side, name.substr(dot + 1)) : std::nullopt;
}

template <class V>
std::optional<V> value_of(std::string_view name,
                          const std::vector<std::pair<std::string, V>>& list) {
  for (const auto& [key, value] : list)
    if (key == name) return value;
  return std::nullopt;
}

}  // namespace

Camera usual_camera(const Box<3>& bounds) {
  const double size = glm::length(bounds.size());
  Camera camera;
  camera.target = bounds.center();
  camera.eye =
      camera.target + glm::normalize(Vec<3>(0.52, 0.52, 1)) * (2.2 * (size > 0 ? size : 1));
  return camera;
}

std::uint64_t state_hash(const Frame& frame) {
  Hash hash;
  hash.add(frame.time);
  for (const Frame& side : frame.sides) hash.add(side.hash);
  for (const FrameBody& body : frame.bodies) add(hash, body, frame.dimension);
  for (const FrameNode& n : frame.nodes) {
    hash.add(std::uint64_t{n.parent}).add(std::uint64_t{n.slot}).add(std::uint64_t{n.leaf});
    add(hash, n.box.lo, frame.dimension);
    add(hash, n.box.hi, frame.dimension);
    for (const BodyId id : n.bodies) hash.add(std::uint64_t{id});
  }
  for (const FramePair& p : frame.pairs)
    hash.add(std::uint64_t{p.pair.a}).add(std::uint64_t{p.pair.b});
  frame.each_part([&](const PartType& type, const std::any& part) { type.add_state(part, hash); });
  return hash.value();
}

std::size_t estimated_bytes(const Frame& frame) {
  ListBytes lists;
  lists.drawn(frame.bodies, frame.nodes, frame.pairs, frame.tested, frame.contacts, frame.counts,
              frame.measures);
  for (const FrameNode& node : frame.nodes) lists.drawn(node.bodies, node.region);
  std::size_t bytes = sizeof(Frame) + lists.bytes;
  frame.each_part([&](const PartType& type, const std::any& part) { bytes += type.bytes(part); });
  for (const Frame& side : frame.sides) bytes += estimated_bytes(side);
  return bytes;
}

const FrameBody* Frame::body_of(BodyId id) const {
  const auto found = std::ranges::find(bodies, id, &FrameBody::id);
  return found == bodies.end() ? nullptr : &*found;
}

const Frame* Frame::side_named(std::string_view name) const {
  const auto found = std::ranges::find(sides, name, [](const Frame& side) -> std::string_view {
    return side.get<FrameSide>().name;
  });
  return found == sides.end() ? nullptr : &*found;
}

std::optional<std::int64_t> Frame::count(std::string_view name) const {
  if (!sides.empty())
    return in_side(*this, name, [](const Frame& f, std::string_view n) { return f.count(n); });
  return value_of(name, counts);
}

std::optional<double> Frame::measure(std::string_view name) const {
  if (!sides.empty())
    return in_side(*this, name, [](const Frame& f, std::string_view n) { return f.measure(n); });
  return value_of(name, measures);
}

std::unordered_map<BodyId, Stored> stored_bodies(const Frame& frame) {
  std::unordered_map<BodyId, Stored> stored;
  for (const FrameNode& node : frame.nodes)
    for (const BodyId id : node.bodies) {
      Stored& of_body = stored[id];
      ++of_body.leaves;
      of_body.depth = std::max(of_body.depth, node.depth);
    }
  return stored;
}

std::optional<double> Frame::number(std::string_view name) const {
  if (const auto counted = count(name)) return static_cast<double>(*counted);
  return measure(name);
}

// The types of parts, and what parts answer of themselves.

template const PartType& part_type<FrameLinks>();
template const PartType& part_type<FrameIslands>();
template const PartType& part_type<FrameForces>();
template const PartType& part_type<FrameRulers>();
template const PartType& part_type<FrameLooks>();
template const PartType& part_type<FrameFinding>();
template const PartType& part_type<FrameSeparation>();
template const PartType& part_type<FrameSearch>();
template const PartType& part_type<FrameDifference>();
template const PartType& part_type<FrameLevel>();
template const PartType& part_type<FrameMatrix>();
template const PartType& part_type<FrameTextures>();
template const PartType& part_type<FrameComparison>();
template const PartType& part_type<FrameCode>();
template const PartType& part_type<FrameCollisions>();
template const PartType& part_type<FrameScreen>();
template const PartType& part_type<FrameStructure>();
template const PartType& part_type<FrameLand>();
template const PartType& part_type<FramePaints>();
template const PartType& part_type<FrameChart>();
template const PartType& part_type<FrameTrace>();
template const PartType& part_type<FrameQuestion>();
template const PartType& part_type<FrameSide>();

namespace {

template <class... P>
std::vector<const PartType*> types_of() {
  return {&part_type<P>()...};
}

std::vector<PanelRun>& runs() {
  static std::vector<PanelRun> all;
  return all;
}

// The frame as `lantern.frame/2`.
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
    if (!frame_.words.empty()) {
      json_.line().key("words").begin_object();
      for (const auto& [name, words] : frame_.words) facts_.member(name, words);
      json_.end_object();
    }
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
    if (!body.label.empty()) facts_.member("label", body.label);
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

const std::vector<const PartType*>& part_order() {
  static const auto order =
      types_of<FrameLinks, FrameIslands, FrameForces, FrameRulers, FrameLooks, FrameFinding,
               FrameSeparation, FrameSearch, FrameDifference, FrameLevel, FrameMatrix,
               FrameTextures, FrameComparison, FrameCode, FrameCollisions, FrameScreen>();
  return order;
}

double FrameSeparation::gap() const {
  if (axes.empty()) return 0;
  return std::max(0.0, axes[answer.value_or(axes.size() - 1)].separation);
}

double FrameSeparation::overlap() const {
  if (axes.empty() || gap() > 0) return 0;
  if (answer) return -axes[*answer].separation;
  return -std::ranges::max(axes, {}, &FrameAxis::separation).separation;
}

void FrameTextures::add_state(Hash& hash) const {
  for (const FrameTexture& t : textures)
    for (const int x : {int{t.packed}, int{t.refused}, t.x, t.y, t.width, t.height})
      hash.add(static_cast<std::uint64_t>(x));
}

const PanelRun& run_of(Panel panel) { return runs().at(static_cast<std::size_t>(panel)); }

void add_panel(PanelKind kind, PanelRun run) {
  language::add_panel(std::move(kind));
  language::add_counts(run.counts);
  runs().push_back(std::move(run));
}

PairStates::PairStates(const Frame& frame)
    : all_(all_pairs(frame.bodies.size())), has_contacts_(frame.count("contacts").has_value()) {
  for (const FrameBody& body : frame.bodies)
    if (body.is_static) statics_.push_back(body.id);
  std::ranges::sort(statics_);
  // Without contacts nobody compares boxes, and in the broad phase nobody has yet.
  const bool compared = has_contacts_ && frame.phase != StepPhase::broad;
  for (const FramePair& p : frame.pairs)
    found_.push_back(
        {p.pair, compared && !p.overlaps ? PairState::boxes_apart : PairState::candidate, p.lit});
  std::ranges::sort(found_, {}, &Found::pair);
  const auto raise = [&](const Pair& pair, PairState from, PairState to) {
    const Found* found = find(pair);
    if (found && found->state <= from)
      found_[static_cast<std::size_t>(found - found_.data())].state = to;
    return found != nullptr;
  };
  for (const Pair& pair : frame.tested) raise(pair, PairState::candidate, PairState::shapes_apart);
  std::vector<Found> others;  // that touch, and are no candidates: both sleep, or they have parted
  for (const FrameContact& contact : frame.contacts)
    if (!raise(contact.pair, PairState::shapes_apart, PairState::contact))
      others.push_back({contact.pair, PairState::contact, false});
  found_.insert(found_.end(), others.begin(), others.end());
  std::ranges::sort(found_, {}, &Found::pair);
  const std::uint64_t untestable = all_pairs(statics_.size());
  const auto count = [&](PairState state) -> std::uint64_t& {
    return counts_[static_cast<std::size_t>(state)];
  };
  for (const Found& found : found_) ++count(found.state);
  count(PairState::untestable) = untestable;
  count(PairState::ruled_out) = all_ - std::min(all_, untestable + found_.size());
}

const PairStates::Found* PairStates::find(const Pair& pair) const {
  const auto at = std::ranges::lower_bound(found_, pair, {}, &Found::pair);
  return at != found_.end() && at->pair == pair ? &*at : nullptr;
}

PairState PairStates::state_of(const Pair& pair) const {
  if (const Found* found = find(pair)) return found->state;
  const bool both =
      std::ranges::binary_search(statics_, pair.a) && std::ranges::binary_search(statics_, pair.b);
  return both ? PairState::untestable : PairState::ruled_out;
}

bool PairStates::is_new(const Pair& pair) const {
  const Found* found = find(pair);
  return found && found->is_new;
}

std::vector<Pair> missed_pairs(const Frame& frame) {
  const auto rests = [](const FrameBody& body) { return body.is_static || body.asleep; };
  std::set<Pair> missed;
  const bool may_miss = frame.as_printed || traits_of(frame.structure).is_own;
  for (const FrameBody& a : frame.bodies) {
    if (!may_miss && (!a.stored_box || united(*a.stored_box, a.box) == *a.stored_box)) continue;
    for (const FrameBody& b : frame.bodies)
      if (a.id != b.id && a.has_volume && b.has_volume && overlap(a.box, b.box) &&
          !(rests(a) && rests(b)))
        missed.insert({std::min(a.id, b.id), std::max(a.id, b.id)});
  }
  for (const FramePair& named : frame.pairs) missed.erase(named.pair);
  return {missed.begin(), missed.end()};
}

std::string to_json(const Frame& frame) { return FrameWriter(frame).written(); }

}  // namespace lantern::frame
