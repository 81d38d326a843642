// What the keys of shapes (draw/keys.hpp) stand for.
#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "publish/lesson_shapes.hpp"

namespace lantern::publish {
namespace {

// "world/cell/root.0" as "world", "cell", "root.0".
std::vector<std::string_view> parts_of(std::string_view key) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at <= key.size();) {
    const std::size_t slash = std::min(key.find('/', at), key.size());
    parts.push_back(key.substr(at, slash - at));
    at = slash + 1;
  }
  return parts;
}

bool is_among(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

class Entities {
 public:
  Entities(std::string prefix, const Frame& side) : prefix_(std::move(prefix)), side_(side) {}

  // By the panel and the kind within it; what follows says of whom.
  std::vector<std::string> of(const std::vector<std::string_view>& parts) {
    if (parts.size() < 2) return {};
    const std::string_view panel = parts[0], kind = parts[1];
    if (panel == "pool") add("slot", kind);
    if (panel == "sweep" || panel == "ledger") add_ids(kind);
    if (parts.size() < 3) return std::move(found_);
    if (panel == "ledger" && kind == "body") add_ids(parts[2]);
    if (panel == "world") add_of_world(parts);
    if (panel == "tree" && is_among(kind, {"node", "edge", "name", "side"})) add("node", parts[2]);
    if (panel == "tree" && kind == "body") add_named(parts[2]);
    if (panel == "tree" && kind == "texture") add_texture(parts[2]);
    if (panel == "tree" && is_among(kind, {"body", "texture"}) && parts.size() > 3)
      add("node", parts[3]);
    if (panel == "memory" && kind == "leaf") add("node", parts[2]);
    if (panel == "atlas" && is_among(kind, {"cell", "lit", "name"})) add("node", parts[2]);
    if (panel == "atlas" && is_among(kind, {"texture", "plate"})) add_texture(parts[2]);
    return std::move(found_);
  }

 private:
  void add_of_world(const std::vector<std::string_view>& parts) {
    const std::string_view kind = parts[1];
    if (is_among(kind, {"body", "box", "broad box", "name", "outside", "velocity", "shadow", "drop",
                        "over"}))
      add_named(parts[2]);
    if (is_among(kind, {"cell", "border", "lit", "plane", "plane name", "ground", "cell name"}))
      add("node", parts[2]);
    if (parts.size() < 4) return;
    if (is_among(kind, {"pair", "joint"})) {
      const auto a = id_of(parts[2]), b = id_of(parts[3]);
      if (a && b) add_pair(*a, *b);
    }
    if (kind == "contact") add_ids(fmt::format("{}-{}", parts[2], parts[3]));
  }

  void add(std::string_view kind, std::string_view whose) {
    found_.push_back(fmt::format("{}{}/{}", prefix_, kind, whose));
  }
  void add_pair(BodyId a, BodyId b) {
    add("pair", fmt::format("{}-{}", std::min(a, b), std::max(a, b)));
  }
  void add_named(std::string_view name) {
    if (const auto id = id_of(name)) add("body", fmt::format("{}", *id));
  }
  void add_texture(std::string_view name) {
    for (const FrameTexture& t : side_.textures)
      if (t.name == name || fmt::format("#{}", t.id) == name) add("body", fmt::format("{}", t.id));
  }
  // "7" is a body, "3-7" a pair.
  void add_ids(std::string_view ids) {
    const auto number = [](std::string_view text) {
      return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
    };
    const std::size_t dash = ids.find('-');
    if (number(ids)) add("body", ids);
    if (dash == ids.npos || !number(ids.substr(0, dash)) || !number(ids.substr(dash + 1))) return;
    add("pair", ids);
  }

  // Of a body that the frame shows, by its name or, of those without, as "#7".
  std::optional<BodyId> id_of(std::string_view name) const {
    for (const FrameBody& body : side_.bodies)
      if (body.name.empty() ? name == fmt::format("#{}", body.id) : body.name == name)
        return body.id;
    return std::nullopt;
  }

  std::string prefix_;
  const Frame& side_;
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> entities_of(const std::string& key, const Frame& frame) {
  std::string_view rest = key;
  const Frame* side = &frame;
  std::string prefix;
  for (const Frame& one : frame.sides) {
    if (!rest.starts_with(one.side + "/")) continue;
    prefix = one.side + "/";
    rest.remove_prefix(prefix.size());
    side = &one;
    break;
  }
  return Entities(prefix, *side).of(parts_of(rest));
}

}  // namespace lantern::publish
