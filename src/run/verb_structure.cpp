// What the verbs about the structure and what it finds do: `rebuild`, `sweep` and `compare`; `ray`,
// `cull` and `query`; `test_shapes`, `separate` and `gjk`. Then those of a level and of an atlas.
#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/number.hpp"
#include "base/words.hpp"
#include "run/event_text.hpp"
#include "run/script_run.hpp"

namespace lantern::run {
namespace {

double begin_of(const FrameBody& body, int axis) {
  return body.stored_box.value_or(body.box).lo[axis];
}

// In the order of the sweep.
std::vector<BodyId> in_order(const Frame& frame) {
  auto bodies = mapped(frame.bodies, [](const FrameBody& body) { return &body; });
  const int axis = frame.get<FrameStructure>().sweep_axis;
  std::ranges::sort(bodies, {}, [&](const FrameBody* body) {
    return std::pair(begin_of(*body, axis), body->id);
  });
  return mapped(bodies, [](const FrameBody* body) { return body->id; });
}

// With what of those that begin later, and before it ends, it was compared.
std::string text_of(const std::string& name, const std::vector<std::string>& others) {
  if (others.empty()) return say("No later body begins before {} ends: nothing to compare.", name);
  const auto n = static_cast<std::int64_t>(others.size());
  return say("Before {} ends, {} {}: {} to compare.", name,
             fmt::format("{}", fmt::join(others, " " + word("and") + " ")), noun("begins/begin", n),
             say_count(n, "pair/pairs"));
}

// What the walk of a finding has brought to light so far, event by event: hits, counts, how far a
// ray reaches, and which nodes were gone through or left out. After the last event it is the
// finding itself.
class RunningFinding {
 public:
  // Of a walk that has not begun. `whole` must outlive this.
  explicit RunningFinding(const Finding& whole) : whole_(whole) {
    so_far_.done = false;
    so_far_.nearest = whole.nearest;
    so_far_.view = whole.view;
    so_far_.region = whole.region;
    so_far_.asked = whole.asked;
    if (whole.ray) so_far_.ray = FrameRay{whole.ray->from, whole.asked, {}};
  }

  // The next event of whole.walk has happened.
  void go_on() {
    using Kind = QueryEvent::Kind;
    const QueryEvent& event = whole_.walk[at_];
    const bool marks = !is_of_static();
    switch (event.kind) {
      case Kind::visit:
        ++so_far_.counts.nodes_visited;
        if (marks) touched_.passed.insert(event.node);
        if (marks && whole_.ray) touched_.met.push_back(event.node);
        break;
      case Kind::skip:
        ++so_far_.counts.nodes_skipped;
        if (marks) touched_.skipped.insert(event.node);
        break;
      case Kind::test:
        ++so_far_.counts.objects_tested;
        so_far_.missed.insert(event.body);
        break;
      case Kind::hit:
        so_far_.missed.erase(event.body);
        so_far_.hits.push_back(event.body);
        break;
    }
    ++at_;
  }

  // Hits of a ray in order along it, else by id.
  Finding so_far() const {
    Finding found = at_ == whole_.walk.size() ? whole_ : so_far_;
    found.missed = so_far_.missed;
    if (found.done) return found;
    const auto order = [&](BodyId id) {
      return std::pair{whole_.ray ? whole_.met.at(id).distance : 0, id};
    };
    std::ranges::sort(found.hits, {}, order);
    if (!whole_.ray) return found;
    if (whole_.nearest && !found.hits.empty()) found.hits.resize(1);
    for (const BodyId id : found.hits) found.ray->hits.push_back({id, whole_.met.at(id).position});
    if (whole_.nearest && !found.hits.empty()) found.ray->to = found.ray->hits[0].position;
    return found;
  }
  // Nodes of the structure of what moves.
  const Touched& touched() const { return touched_; }
  // Is the next event of the other structure, of what never moves?
  bool is_of_static() const { return at_ >= whole_.first_static; }

 private:
  const Finding& whole_;
  Finding so_far_;  // its hits as they were found
  Touched touched_;
  std::size_t at_ = 0;  // in the walk
};

// One frame for each thing that the walk did, of which each knows what was found up to it.
void replay(const Finding& whole, ScriptRun& run) {
  using Kind = QueryEvent::Kind;
  FrameMaker& frames = run.frames;
  const std::vector<QueryEvent>& walk = whole.walk;
  RunningFinding running(whole);
  for (std::size_t i = 0; i < walk.size() && !frames.stopped(); ++i) {
    const QueryEvent& event = walk[i];
    const bool of_static = running.is_of_static();
    running.go_on();
    const bool hit = i + 1 < walk.size() && walk[i + 1].kind == Kind::hit;
    if (hit) running.go_on(), ++i;  // told with its test
    const bool is_test = event.kind == Kind::test;
    const std::string_view name =
        is_test ? (hit ? "hit" : "miss") : (event.kind == Kind::visit ? "visit" : "skip");
    if (!frames.emits(name)) continue;
    frames.show_finding(running.so_far());
    Touched now = running.touched();
    if (event.kind != Kind::skip && !of_static) now.lit.insert(event.node);
    frames.emit(now, name,
                query_text(name, run.engine().label_of(event.node), run.name_of(event.body)),
                is_test ? std::optional(event.body) : std::nullopt);
  }
}

void answer(const Finding& finding, std::string_view verb, ScriptRun& run) {
  if (run.frames.by_event()) replay(finding, run);
  RunningFinding all(finding);
  for (std::size_t i = 0; i < finding.walk.size(); ++i) all.go_on();
  run.frames.touched = all.touched();
  run.frames.show_finding(all.so_far());
  run.frames.settle(verb);
}

std::string own_name(const ScriptRun& run, std::size_t body) {
  return run.scenario.bodies[body].called();
}

// What the verbs of a level and of an atlas do: `compile`, `locate`, `order` and `see`; `pack`,
// `ask_room` and `draw`.
void show(const LevelMoment& moment, FrameMaker& frames) {
  if (frames.emits(moment.event)) frames.emit({}, moment.event, moment.text);
}

void witness(const AtlasEvent& event, ScriptRun& run) {
  FrameMaker& frames = run.frames;
  if (frames.stopped()) return;
  using Kind = AtlasEvent::Kind;
  (event.kind == Kind::cut || event.kind == Kind::store ? frames.touched.lit
                                                        : frames.touched.passed)
      .insert(event.node);
  if (!frames.emits(event_name(event.kind))) return;
  Touched now = frames.touched;
  now.lit = {event.node};
  const FrameTexture& texture = run.stage.atlas->texture(event.texture);
  if (event.kind == Kind::cut || event.kind == Kind::too_small)
    frames.asked = {texture.width, texture.height};
  frames.emit(
      now, event_name(event.kind),
      event_text(event, run.stage.atlas->label_of(event.node),
                 texture.turned ? say("{}, turned", word(texture.name)) : word(texture.name),
                 texture.width, texture.height));
  frames.asked = Vec<2>(0.0);
}

std::string refusal_text(const TextureSpec& texture) {
  return say("No leaf has room for {} ({} × {}): it is refused, the rest is kept.",
             word(texture.name), texture.width, texture.height);
}

// Leaves choose among all textures of the step: these enter in the order in which they are chosen.
void pack_chosen(const Pack& step, ScriptRun& run) {
  FrameMaker& frames = run.frames;
  AtlasStage& atlas = *run.stage.atlas;
  const bool names = !step.free_name.empty();
  const std::vector<std::uint32_t> before =
      names ? atlas.free_leaves() : std::vector<std::uint32_t>();
  std::size_t done = 0;
  const bool watched = step.each || frames.by_event();
  const auto watch = [&](const AtlasEvent& event) {
    const TextureSpec& texture = run.scenario.textures[event.texture];
    const bool refused = event.kind == AtlasEvent::Kind::refuse;
    frames.texture = texture.name;
    if (refused) frames.note_refused(texture.name);
    if (watched) witness(event, run);
    if (!refused && event.kind != AtlasEvent::Kind::store) return;
    const bool last = ++done == step.textures.size();
    if (last && names) atlas.name_free_leaf(step.free_name, before);
    if ((!last && !step.each) || frames.stopped()) return;
    if (!step.each) frames.touched = {};
    frames.settle("pack", last, refused && step.each ? refusal_text(texture) : "");
    frames.touched = {};
  };
  frames.touched = {};
  atlas.pack_all(step.textures, watch);
}

constexpr const char* kBindEvent = "bind";
constexpr const char* kDrawEvent = "draw";

// In event pace: one frame about this element, and, in an atlas, about the leaf it comes from.
void tell_draw(const char* event, std::size_t texture, bool from_atlas, const std::string& text,
               ScriptRun& run) {
  if (!run.frames.emits(event)) return;
  Touched now;
  if (from_atlas) now.lit.insert(run.stage.atlas->leaf_of(texture).value());
  run.frames.emit(now, event, text);
}

}  // namespace

void act(const Rebuild& rebuild, ScriptRun& run) {
  run.engine().rebuild_as(rebuild.structure);
  run.frames.settle("rebuild");
}

void act(const Compare& compare, ScriptRun& run) {
  FrameComparison::Row found = run.engine().compare(compare.bodies, compare.kinds);
  found.name = compare.row;
  found.machine = compare.machine;
  for (FrameComparison::Cell& cell : found.cells)
    for (const auto& [kind, micros] : compare.times)
      if (kind == cell.kind) cell.micros = micros;
  run.frames.add_row(std::move(found), compare.verdict);
  run.frames.settle("compare");
}

void act(const language::Sweep&, ScriptRun& run) {
  FrameMaker& frames = run.frames;
  const Frame whole = frames.picture(frames.touched, "sweep");
  std::vector<Pair> met;
  run.engine().each_swept([&](BodyId a, BodyId b) { met.push_back({a, b}); });
  const auto name_of = [&](BodyId id) { return whole.body_of(id)->called(); };
  SweptSoFar& swept = frames.swept.emplace(SweptSoFar{whole.hash, 0, {}});
  std::size_t next = 0;
  for (const BodyId at : in_order(whole)) {
    std::vector<std::string> others;
    for (; next < met.size() && met[next].a == at; ++next) {
      swept.met.insert({std::min(at, met[next].b), std::max(at, met[next].b)});
      others.push_back(name_of(met[next].b));
    }
    swept.at = at;
    if (!frames.stopped()) frames.emit({}, "sweep", text_of(name_of(at), others), at);
  }
  frames.swept.reset();
  frames.settle("sweep");
}

void act(const CastRay& ray, ScriptRun& run) { answer(run.engine().ask(ray), "ray", run); }
void act(const Cull& cull, ScriptRun& run) { answer(run.engine().ask(cull), "cull", run); }
void act(const Query& query, ScriptRun& run) { answer(run.engine().ask(query), "query", run); }

void act(const TestShapes&, ScriptRun& run) {
  run.frames.narrow.show(run.engine().test_shapes());
  run.frames.settle("test_shapes");
}

void act(const Separate& of, ScriptRun& run) {
  const FrameSeparation whole = run.engine().separate(of.a, of.b);
  for (std::size_t n = 1; n <= whole.axes.size(); ++n) {
    if (!run.frames.emits("axis")) continue;
    FrameSeparation so_far = whole;
    so_far.axes.resize(n);
    so_far.answer.reset();
    const std::string text = axis_text(so_far, own_name(run, of.a), own_name(run, of.b));
    run.frames.narrow.show(std::move(so_far));
    run.frames.emit({}, "axis", text);
  }
  run.frames.narrow.show(whole);
  run.frames.settle("separate");
}

void act(const SearchDistance& of, ScriptRun& run) {
  const FrameSearch whole = run.engine().search(of.a, of.b);
  const auto show = [&](std::size_t steps, bool taken) {
    const std::string_view event = taken ? "simplex" : "support";
    if (!run.frames.emits(event)) return;
    FrameSearch so_far = whole;
    so_far.steps.resize(steps);
    so_far.taken = taken;
    so_far.answer.reset();
    const std::string text = search_text(so_far, own_name(run, of.a), own_name(run, of.b));
    run.frames.narrow.show(std::move(so_far));
    run.frames.emit({}, event, text);
  };
  for (std::size_t n = 1; n <= whole.steps.size(); ++n) {
    show(n, false);
    if (!whole.steps[n - 1].ends) show(n, true);
  }
  run.frames.narrow.show(whole);
  run.frames.settle("gjk");
}

void act(const CompileLevel&, ScriptRun& run) {
  run.stage.level->compile([&](const LevelMoment& moment) { show(moment, run.frames); });
  if (run.stage.engine) {
    const StructureSpec& structure = run.engine().structure();
    if (structure.of_level || structure.kind == StructureKind::none)
      run.engine().rebuild_as(run.stage.level->structure());
  }
  run.frames.settle("compile");
}

void act(const Locate& locate, ScriptRun& run) {
  run.stage.level->locate(locate.point);
  run.frames.settle("locate");
}

void act(const OrderFrom& order, ScriptRun& run) {
  run.stage.level->order_from(order.eye);
  run.frames.settle("order");
}

void act(const See& see, ScriptRun& run) {
  run.stage.level->see(see.eye, [&](const LevelMoment& moment) { show(moment, run.frames); });
  run.frames.settle("see");
}

void act(const Pack& pack, ScriptRun& run) {
  if (run.scenario.atlas->rule == AtlasRule::best_texture) return pack_chosen(pack, run);
  AtlasStage& atlas = *run.stage.atlas;
  FrameMaker& frames = run.frames;
  for (std::size_t i = 0; i < pack.textures.size() && !frames.stopped(); ++i) {
    const TextureSpec& texture = run.scenario.textures[pack.textures[i]];
    if (pack.each) frames.touched = {};
    frames.texture = texture.name;
    const bool last = i + 1 == pack.textures.size();
    const bool names = last && !pack.free_name.empty();
    const std::vector<std::uint32_t> before =
        names ? atlas.free_leaves() : std::vector<std::uint32_t>();
    // Who packs many for one frame looks at none of them.
    AtlasStage::Watch watch;
    if (pack.each || frames.by_event())
      watch = [&](const AtlasEvent& event) { witness(event, run); };
    const bool packed = atlas.pack(pack.textures[i], watch);
    if (!packed) frames.note_refused(texture.name);
    if (names) atlas.name_free_leaf(pack.free_name, before);
    if (!last && !pack.each) continue;
    if (!pack.each) frames.touched = {};
    frames.settle("pack", last, packed ? "" : refusal_text(texture));
  }
}

void act(const AskRoom& ask, ScriptRun& run) {
  run.stage.atlas->ask_room(ask.width, ask.height);
  run.frames.settle("ask_room");
}

void act(const DrawScreen& draw, ScriptRun& run) {
  ScreenStage& screen = *run.stage.screen;
  FrameMaker& frames = run.frames;
  const bool from_atlas = draw.from == DrawScreen::From::atlas;
  std::string bound;
  for (const std::size_t element : screen.begin(draw)) {
    if (frames.stopped()) return;
    const std::size_t texture = screen.texture_of(element);
    frames.texture = run.scenario.textures[texture].name;
    if (from_atlas && !run.stage.atlas->leaf_of(texture))
      throw Refused("the atlas has refused '{}', which its screen shows", frames.texture);
    const std::string image = word(from_atlas ? "the atlas" : frames.texture);
    if (screen.bind(element))
      tell_draw(kBindEvent, texture, from_atlas, bind_text(image, bound, screen.bindings()), run);
    bound = image;
    screen.draw(element);
    tell_draw(kDrawEvent, texture, from_atlas, draw_text(word(frames.texture), from_atlas), run);
  }
  screen.end();
  frames.settle(kDrawEvent);
}

}  // namespace lantern::run
