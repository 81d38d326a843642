#include "live/grip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "draw/projection.hpp"
#include "frame/parts/atlas.hpp"
#include "live/edit.hpp"
#include "publish/lesson_frames.hpp"

namespace lantern::live {
namespace {

using draw::DrawList;
using draw::WorldMap;

constexpr double kNear = 24;   // page units from a corner that still take it
constexpr double kGoesOn = 2;  // seconds that a script without any is run after a throw

// In as many digits as a hand can tell apart, where a page unit is 1/scale.
std::string number_text(double x, double scale) {
  int digits = 0;
  double tens = 1;
  for (; tens < scale && digits < 6; tens *= 10) ++digits;
  const double whole = std::round(x * tens);
  std::string text = fmt::format("{:.{}f}", whole == 0 ? 0.0 : whole / tens, digits);
  if (digits > 0) text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::string point_text(const Vec<3>& p, int dimension, double scale) {
  std::string text;
  for (int i = 0; i < dimension; ++i) text += (i > 0 ? ", " : "[") + number_text(p[i], scale);
  return text + "]";
}

// From ways on the page to ways in a world, about a point of it.
struct Ways {
  Vec<3> right{1, 0, 0}, down{0, -1, 0};  // a page unit
  double scale = 1;                       // page units of a world unit

  Vec<3> of(const Vec<2>& page) const { return right * page.x + down * page.y; }
};

Ways ways_of(const WorldMap& map) {
  return {Vec<3>(1, 0, 0) / map.scale, Vec<3>(0, -1, 0) / map.scale, map.scale};
}

// Nothing where that world is not on the page.
std::optional<Ways> ways_at(const Vec<3>& p, const Frame& frame, const Frame& whole,
                            const DrawList& list, const std::string& prefix) {
  for (const WorldMap& map : list.maps)
    if (map.prefix == prefix) return ways_of(map);
  for (const draw::SolidPanel& solid : list.solids) {
    if (solid.prefix != prefix) continue;
    const draw::View3D view(whole.bounds, frame.camera, solid.panel);
    const double scale = view.scale_at(p);
    return Ways{view.right() / scale, -view.up() / scale, scale};
  }
  return std::nullopt;
}

class BodyGrip : public Grip {
 public:
  BodyGrip(std::string_view text, const Play& play, std::size_t index, const FrameBody& body,
           const Ways& ways, const Vec<2>& at)
      : text_(text),
        body_(body),
        ways_(ways),
        at_(at),
        bounds_(play.frames()[index].bounds),
        dimension_(play.frames()[index].dimension) {
    moment = play.moment_of(index);
    const language::BodySpec& spec = play.scenario().bodies.at(body.place);
    const auto& steps = play.scenario().steps;
    const auto* put = std::get_if<language::Move>(&steps.at(moment.step).verb);
    const auto table = live::index_of(text, "body", body.name);
    std::uint32_t next = moment.step + 1;
    if (table && body.position == spec.position && !time_has_passed(steps)) {
      table_ = table;
      body_.angle = spec.angle;  // it may have turned
      if (!moment.is_last) next = moment.step;
    } else if (!put || put->body != body.place || !put->to) {  // else that step's place changes
      adds_step_ = true;
      moment = {next, 0, true};
      text_ = with_step(text_, next - 1,
                        fmt::format("do = \"move\"\nbody = {}", json_string(body.name)));
    }
    keys_ = table_ ? fmt::format("body[{}].", *table_) : fmt::format("step[{}].", moment.step);
    place_ = Slot(text_, keys_ + (table_ ? "position" : "to"));
    only_from_there = !table_;
    goes_on_ = std::any_of(steps.begin() + next, steps.end(), [](const language::Step& step) {
      return traits_of(step.verb).passes_time;
    });
  }

  std::string_view what() const override { return table_ ? "position" : "move"; }

  std::string text(const Hand& hand) override {
    Vec<3> to = body_.position + ways_.of(hand.at - at_);
    const Vec<3> half = 0.5 * body_.box.size();  // the whole of it stays in the world
    for (int i = 0; i < dimension_; ++i)
      if (const double lo = bounds_.lo[i] + half[i], hi = bounds_.hi[i] - half[i]; lo < hi)
        to[i] = std::clamp(to[i], lo, hi);
    const std::string way = hand.velocity != Vec<2>(0) && !body_.is_static
                                ? point_text(ways_.of(hand.velocity), dimension_, ways_.scale)
                                : "";
    const std::string turned = hand.turn != 0 && dimension_ == 2
                                   ? number_text(glm::degrees(body_.angle) + hand.turn, 10)
                                   : "";
    std::string text =
        hand.at != at_ || adds_step_ ? place_.with(point_text(to, dimension_, ways_.scale)) : text_;
    const auto say = [&](const char* key, const std::string& value) {
      if (!value.empty()) text = with_value(text, keys_ + key, value);
    };
    say("velocity", way);
    if (!turned.empty()) text = with_value(text, keys_ + "heading", "");  // instead of it
    say("turned", turned);
    if (!way.empty() && !goes_on_)
      text = with_step(text, moment.step, fmt::format("do = \"run\"\nseconds = {}\n", kGoesOn));
    return text;
  }

 private:
  // Whether any has since the body entered the world.
  bool time_has_passed(const std::vector<language::Step>& steps) const {
    bool passed = false;
    for (std::size_t i = 0; i <= moment.step; ++i) {
      const auto* insert = std::get_if<language::Insert>(&steps[i].verb);
      if (insert && std::ranges::count(insert->bodies, body_.place) > 0) passed = false;
      passed |= traits_of(steps[i].verb).passes_time;
    }
    return passed;
  }
  std::string text_;
  FrameBody body_;
  Ways ways_;
  Vec<2> at_;
  Box<3> bounds_;
  int dimension_;
  bool goes_on_ = false;              // time passes later in the script
  std::optional<std::size_t> table_;  // whose position changes; else a step's `to`
  bool adds_step_ = false;
  std::string keys_;  // of that table or step
  Slot place_;
};

// Its lower right corner follows the hand.
class TextureGrip : public Grip {
 public:
  TextureGrip(std::string_view text, std::size_t table, const FrameTexture& texture,
              const Vec<2>& per_pixel, const Vec<2>& at)
      : size_(std::string(text), fmt::format("texture[{}].size", table)),
        texture_(texture),
        per_pixel_(per_pixel),
        at_(at) {}

  std::string_view what() const override { return "size"; }
  std::string text(const Hand& hand) override {
    const Vec<2> more = (hand.at - at_) / per_pixel_;
    const auto length = [](double pixels) { return std::lround(std::clamp(pixels, 1.0, 1e6)); };
    return size_.with(
        fmt::format("[{}, {}]", length(texture_.width + more.x), length(texture_.height + more.y)));
  }

 private:
  Slot size_;
  FrameTexture texture_;
  Vec<2> per_pixel_, at_;
};

class CornerGrip : public Grip {
 public:
  CornerGrip(std::string_view text, std::string path, const Vec<2>& corner, const Ways& ways,
             const Vec<2>& at)
      : place_(std::string(text), std::move(path)), corner_(corner), ways_(ways), at_(at) {}

  std::string_view what() const override { return "corner"; }
  std::string text(const Hand& hand) override {
    return place_.with(point_text(Vec<3>(corner_, 0) + ways_.of(hand.at - at_), 2, ways_.scale));
  }

 private:
  Slot place_;
  Vec<2> corner_;
  Ways ways_;
  Vec<2> at_;
};

std::unique_ptr<Grip> on_corner(std::string_view text, const Play& play, const DrawList& list,
                                const Vec<2>& at) {
  const auto& loops = play.scenario().level->loops;
  std::unique_ptr<Grip> nearest;
  double least = kNear;
  for (const WorldMap& map : list.maps)
    for (std::size_t i = 0; i < loops.size(); ++i)
      for (std::size_t k = 0; k < loops[i].size(); ++k) {
        const Vec<2>& corner = loops[i][k];
        const double way = glm::length(map.origin + Vec<2>(corner.x, -corner.y) * map.scale - at);
        if (way > least) continue;
        least = way;
        nearest = std::make_unique<CornerGrip>(text, fmt::format("level.loops[{}][{}]", i, k),
                                               corner, ways_of(map), at);
      }
  if (!nearest) throw Refused("there is no corner of a wall here");
  return nearest;
}

// Page units of a pixel, as the texture's largest rectangle on the page has them.
std::optional<Vec<2>> units_of_pixel(const DrawList& list, const Frame& frame,
                                     const FrameTexture& texture, const std::string& entity) {
  std::optional<Vec<2>> largest;
  for (std::size_t r = 0; r < list.runs.size(); ++r) {
    const auto entities = publish::entities_of(list.runs[r].key, frame);
    if (std::ranges::find(entities, entity) == entities.end()) continue;
    const std::size_t end = r + 1 < list.runs.size() ? list.runs[r + 1].first : list.shapes.size();
    for (std::size_t i = list.runs[r].first; i < end; ++i)
      if (const auto* rect = std::get_if<draw::RectShape>(&list.shapes[i]))
        if (const Vec<2> size = rect->box.size(); !largest || size.x > largest->x) largest = size;
  }
  if (!largest) return std::nullopt;
  return *largest / Vec<2>(texture.width, texture.height);
}

// Of the places in a coarse grid the one that is farthest from walls and bodies.
Vec<3> roomiest(const Box<3>& bounds, int dimension, const std::vector<FrameBody>& bodies) {
  constexpr std::array kShares = {7, 3, 13, 5, 11, 9};  // sixteenths: not where trees cut
  std::pair<double, Vec<3>> best(-1, 0.0);
  for (int n = 0; n < (dimension == 3 ? 216 : 36); ++n) {
    Vec<3> at{0.0};
    double room = std::numeric_limits<double>::infinity();
    for (int i = 0, rest = n; i < dimension; ++i, rest /= 6) {
      const double side = bounds.size()[i];
      const double way = side * kShares[static_cast<std::size_t>(rest % 6)] / 16;
      at[i] = bounds.lo[i] + way;
      room = std::min(room, 2 * std::min(way, side - way));
    }
    for (const FrameBody& body : bodies)
      room = std::min(room, glm::length(glm::clamp(at, body.box.lo, body.box.hi) - at));
    if (room > best.first) best = {room, at};
  }
  return best.second;
}

// "body/red", behind its side's prefix: that, its name, and the frame in which it is.
std::tuple<std::string, std::string, const Frame*> body_named(std::string_view entity,
                                                              const Frame& whole) {
  // Names have no slash: a side may be called "body".
  const std::size_t slash = ("/" + std::string(entity)).rfind("/body/");
  if (slash == entity.npos)
    throw Refused("only bodies, textures and corners of walls can be moved");
  const std::string prefix(entity.substr(0, slash)), name(entity.substr(slash + 5));
  const Frame* frame = prefix.empty() ? &whole : whole.side_named(prefix.substr(0, slash - 1));
  if (!frame) throw Refused("there is no side '{}'", prefix);
  return {prefix, name, frame};
}

}  // namespace

std::string with_another(std::string_view text, const Play& play, const Frame& whole,
                         std::string& entity) {
  const language::Scenario& scenario = play.scenario();
  if (!scenario.has_world()) throw Refused("there is no [world] for a body");
  std::string name = "new1";
  for (int i = 2; text.find(name) != text.npos ||
                  std::ranges::count(scenario.bodies, name, &language::BodySpec::name) > 0;
       ++i)
    name = fmt::format("new{}", i);
  const Frame& frame = whole.sides.empty() ? whole : whole.sides.front();
  const std::string side = frame.get<FrameSide>().name;
  entity = fmt::format("{}{}body/{}", side, side.empty() ? "" : "/", name);
  const int dimension = whole.dimension;
  const Vec<3> size = whole.bounds.size();
  const double least = std::min({size.x, size.y, dimension == 3 ? size.z : size.y});
  const Vec<3> at = roomiest(whole.bounds, dimension, frame.bodies);
  return with_step(
      with_body(text, fmt::format("name = \"{}\"\nradius = {:.2g}\nposition = {}", name, least / 20,
                                  point_text(at, dimension, 100 / least))),
      whole.step, fmt::format("do = \"insert\"\nbodies = [\"{}\"]", name));
}

std::string without(std::string_view text, const Frame& whole, std::string_view entity) {
  const auto [prefix, name, frame] = body_named(entity, whole);
  if (std::ranges::count(frame->bodies, name, &FrameBody::name) == 0)
    throw Refused("there is no body '{}' on this picture", name);
  return with_step(text, whole.step,
                   fmt::format("do = \"remove\"\nbodies = [{}]", json_string(name)));
}

std::unique_ptr<Grip> grip_on(std::string_view text, Play& play, std::size_t index,
                              std::string_view entity, const Vec<2>& at) {
  const Frame& whole = play.frames().at(index);
  const DrawList list = play.picture(index);
  const auto placed = [&](std::unique_ptr<Grip> grip) {
    grip->moment = play.moment_of(index);
    return grip;
  };
  if (entity.empty() && play.scenario().level) return placed(on_corner(text, play, list, at));
  const auto [prefix, name, frame] = body_named(entity, whole);
  for (const FrameBody& body : frame->bodies) {
    if (body.name != name) continue;
    const auto ways = ways_at(body.position, *frame, whole, list, prefix);
    if (!ways) throw Refused("'{}' is in no world of this picture", name);
    return std::make_unique<BodyGrip>(text, play, index, body, *ways, at);
  }
  for (const FrameTexture& texture : frame->get<FrameTextures>().textures) {
    if (texture.name != name) continue;
    const auto table = index_of(text, "texture", name);
    const auto units = units_of_pixel(list, whole, texture, std::string(entity));
    if (!table || !units) throw Refused("the size of '{}' is not written on its own", name);
    return placed(std::make_unique<TextureGrip>(text, *table, texture, *units, at));
  }
  throw Refused("there is no '{}' on this picture that could be moved", name);
}

}  // namespace lantern::live
