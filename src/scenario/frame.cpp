#include "scenario/frame.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "base/json_writer.hpp"

namespace lantern {
namespace {

void write(JsonWriter& json, const Vec<2>& v) {
  json.begin_array().value(v.x).value(v.y).end_array();
}

void write(JsonWriter& json, const Box<2>& box) {
  json.begin_object().key("min");
  write(json, box.lo);
  json.key("max");
  write(json, box.hi);
  json.end_object();
}

void write(JsonWriter& json, const Shape<2>& shape) {
  json.begin_object();
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    json.member("kind", "sphere").member("radius", sphere->radius);
  } else {
    json.member("kind", "box").key("half_size");
    write(json, std::get<AxisBox<2>>(shape).half_size);
  }
  json.end_object();
}

void write(JsonWriter& json, const FrameBody& body) {
  json.begin_object().member("id", body.id).member("name", body.name).key("shape");
  write(json, body.shape);
  json.key("position");
  write(json, body.position);
  json.member("orientation", body.orientation).key("velocity");
  write(json, body.velocity);
  json.member("angular_momentum", body.angular_momentum).key("box");
  write(json, body.box);
  json.member("static", body.is_static).member("asleep", body.asleep).end_object();
}

void write(JsonWriter& json, const FrameNode& node) {
  json.begin_object().member("id", node.id).key("parent");
  if (node.parent == kNone)
    json.null();
  else
    json.value(node.parent);
  json.member("depth", node.depth).member("label", node.label);
  if (node.plane) {
    json.key("plane").begin_object().member("name", node.plane_name).key("normal");
    write(json, node.plane->normal);
    json.member("offset", node.plane->offset).end_object();
  } else {
    json.key("box");
    write(json, node.box);
  }
  if (!node.region.empty()) {
    json.key("region").begin_array();
    for (const Vec<2>& corner : node.region) write(json, corner);
    json.end_array();
  }
  json.member("leaf", node.leaf).key("bodies").begin_array();
  for (const BodyId id : node.bodies) json.value(id);
  json.end_array().member("awake", node.awake).end_object();
}

void write(JsonWriter& json, const FrameTexture& texture) {
  json.begin_object().member("id", texture.id).member("name", texture.name);
  json.key("size").begin_array().value(texture.width).value(texture.height).end_array();
  json.key("position");
  if (texture.packed)
    json.begin_array().value(texture.x).value(texture.y).end_array();
  else
    json.null();
  json.member("refused", texture.refused).end_object();
}

// One element a line.
template <class T>
void write_list(JsonWriter& json, std::string_view name, const std::vector<T>& list) {
  json.line().key(name).begin_array();
  for (const T& element : list) write(json.line(), element);
  if (!list.empty()) json.line();
  json.end_array();
}

}  // namespace

std::optional<std::int64_t> Frame::count(std::string_view name) const {
  const auto found =
      std::find_if(counts.begin(), counts.end(), [&](const auto& c) { return c.first == name; });
  if (found == counts.end()) return std::nullopt;
  return found->second;
}

std::string to_json(const Frame& frame) {
  JsonWriter json;
  json.begin_object().line().member("format", "lantern.frame/1");
  json.line().member("scenario", frame.scenario);
  json.line().member("frame", frame.index);
  json.line().member("time", frame.time);
  json.line().member("step", frame.step);
  json.line().member("event", frame.event);
  json.line().member("caption", frame.caption);
  json.line().member("seed", frame.seed);
  write_list(json, "bodies", frame.bodies);
  write_list(json, "nodes", frame.nodes);
  json.line().key("pairs").begin_array();
  for (const FramePair& p : frame.pairs)
    json.begin_array().value(p.pair.a).value(p.pair.b).end_array();
  json.end_array();
  json.line().key("contacts").begin_array().end_array();
  if (!frame.textures.empty()) write_list(json, "textures", frame.textures);
  json.line().key("counts").begin_object();
  for (const auto& [name, number] : frame.counts) json.line().member(name, number);
  if (!frame.counts.empty()) json.line();
  json.end_object();
  json.line().member("hash", fmt::format("{:016x}", frame.hash));
  json.line().end_object();
  return json.text() + "\n";
}

}  // namespace lantern
