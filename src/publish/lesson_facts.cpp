#include <fmt/format.h>

#include "base/printable.hpp"
#include "base/stop.hpp"
#include "draw/keys.hpp"
#include "publish/lesson_frames.hpp"

namespace lantern::publish {
namespace {

// The elements of a list, written by `write(element)`, as JSON.
template <class List, class Write>
std::string list_of(const List& elements, const Write& write) {
  std::string text;
  for (const auto& element : elements) {
    stop_if_asked();
    if (!text.empty()) text += ',';
    text += write(element);
  }
  return "[" + text + "]";
}

std::string number(double x) { return fmt::format("{:.5g}", x == 0 ? 0.0 : x); }

class FactsWriter {
 public:
  FactsWriter(const Frame& frame, const DrawList& list) : frame_(frame) {
    const std::string prefix =
        frame.get<FrameSide>().name.empty() ? "" : frame.get<FrameSide>().name + "/";
    for (const WorldMap& map : list.maps)
      if (map.prefix == prefix) map_ = &map;
  }

  std::string written() const {
    const auto pair = [](const Pair& p) { return fmt::format("[{},{}]", p.a, p.b); };
    return fmt::format(
        "{{\"name\":{},\"title\":{},\"counts\":{},\"measures\":{},\"textures\":{},\"bodies\":{},"
        "\"nodes\":{},\"leaf\":[{}],\"pairs\":{},\"contacts\":{}}}",
        json_string(frame_.get<FrameSide>().name), json_string(frame_.get<FrameSide>().title),
        list_of(frame_.counts, count), list_of(frame_.measures, measure),
        list_of(frame_.get<FrameTextures>().textures, texture),
        list_of(frame_.bodies, [&](const FrameBody& b) { return body(b); }),
        list_of(frame_.nodes, [&](const FrameNode& n) { return node(n); }),
        has_cells(frame_.structure) ? R"("cell","cells")" : R"("leaf","leaves")",
        list_of(frame_.pairs,
                [](const FramePair& p) {
                  return fmt::format("[{},{},{}]", p.pair.a, p.pair.b, p.overlaps ? 1 : 0);
                }),
        list_of(frame_.contacts, [&](const FrameContact& c) { return pair(c.pair); }));
  }

 private:
  static std::string count(const std::pair<std::string, std::int64_t>& c) {
    return fmt::format("[{},{}]", json_string(c.first), c.second);
  }
  static std::string measure(const std::pair<std::string, double>& m) {
    return fmt::format("[{},{}]", json_string(m.first), number(m.second));
  }

  static std::string texture(const FrameTexture& t) {
    return fmt::format("[{},{},{},{},{}]", t.id, json_string(t.name), t.width, t.height,
                       t.refused ? 1 : 0);
  }

  std::string body(const FrameBody& b) const {
    const std::string z = frame_.dimension == 3 ? "," + number(b.position.z) : "";
    const bool is_outside = !contains(frame_.bounds, b.position);
    const char* state = b.is_static ? "static" : is_outside ? "outside" : b.asleep ? "asleep" : "";
    const std::string label = b.label.empty() ? "" : "," + json_string(b.label);
    return fmt::format("[{},{},[{},{}{}],{},\"{}\"{}]", b.id, json_string(b.name),
                       number(b.position.x), number(b.position.y), z,
                       number(glm::length(b.velocity)), state, label);
  }

  std::string node(const FrameNode& n) const {
    const auto place = static_cast<std::uint32_t>(&n - frame_.nodes.data());
    const auto id = [](BodyId body) { return fmt::format("{}", body); };
    return fmt::format("[{},{},{},{},{},{},{}]", json_string(way_of(frame_.nodes, place)),
                       json_string(n.label), n.depth, n.leaf ? 1 : 0, list_of(n.bodies, id),
                       outline(n),
                       n.pool_slot == kNone ? -1 : static_cast<std::int64_t>(n.pool_slot));
  }

  // Cut to the picture: the cells that hold a half-space go on without end.
  std::string outline(const FrameNode& node) const {
    if (!map_) return "[]";
    std::vector<Vec<2>> corners(node.region.begin(), node.region.end());
    if (corners.empty()) {
      const Vec<3>&lo = node.box.lo, &hi = node.box.hi;
      corners = {{lo.x, lo.y}, {hi.x, lo.y}, {hi.x, hi.y}, {lo.x, hi.y}};
    }
    return list_of(corners, [&](const Vec<2>& p) {
      const Vec<2> at = glm::clamp(map_->origin + Vec<2>(p.x, -p.y) * map_->scale, map_->picture.lo,
                                   map_->picture.hi);
      return fmt::format("{:.0f},{:.0f}", at.x, at.y);
    });
  }

  const Frame& frame_;
  const WorldMap* map_ = nullptr;  // none of a solid world, or where no world is shown
};

}  // namespace

std::string facts_for_page(const Frame& frame, const DrawList& list) {
  if (frame.sides.empty()) return "[" + FactsWriter(frame, list).written() + "]";
  return list_of(frame.sides, [&](const Frame& side) { return FactsWriter(side, list).written(); });
}

}  // namespace lantern::publish
