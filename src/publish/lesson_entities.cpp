// What the keys of shapes (draw/keys.hpp) stand for.
#include <algorithm>
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
    if (panel == "tree" && is_among(kind, {"body", "texture"})) {
      add("body", parts[2]);
      if (parts.size() > 3) add("node", parts[3]);
    }
    if (panel == "islands" && kind == "node") add("body", parts[2]);
    if (panel == "islands" && kind == "edge" && parts.size() > 3) add_pair(parts[2], parts[3]);
    if (panel == "memory" && kind == "leaf") add("node", parts[2]);
    if (panel == "atlas" && is_among(kind, {"cell", "lit", "name"})) add("node", parts[2]);
    if (panel == "atlas" && is_among(kind, {"texture", "plate"})) add("body", parts[2]);
    return std::move(found_);
  }

 private:
  void add_of_world(const std::vector<std::string_view>& parts) {
    const std::string_view kind = parts[1];
    if (is_among(kind, {"body", "box", "broad box", "name", "outside", "velocity", "shadow", "drop",
                        "over"}))
      add("body", parts[2]);
    if (is_among(kind, {"cell", "border", "lit", "plane", "plane name", "ground", "cell name"}))
      add("node", parts[2]);
    if (parts.size() < 4) return;
    if (is_among(kind, {"pair", "joint"})) add_pair(parts[2], parts[3]);
    if (kind == "contact") add_ids(fmt::format("{}-{}", parts[2], parts[3]));
  }

  void add(std::string_view kind, std::string_view whose) {
    found_.push_back(fmt::format("{}{}/{}", prefix_, kind, whose));
  }
  void add_pair(std::string_view a, std::string_view b) {
    add("pair", fmt::format("{}|{}", std::min(a, b), std::max(a, b)));
  }
  // "7" is a body, "3-7" a pair.
  void add_ids(std::string_view ids) {
    const auto is_number = [](std::string_view text) {
      return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
    };
    const std::size_t dash = ids.find('-');
    if (is_number(ids)) add("body", name_of(ids));
    if (dash == ids.npos) return;
    const std::string_view a = ids.substr(0, dash), b = ids.substr(dash + 1);
    if (is_number(a) && is_number(b)) add_pair(name_of(a), name_of(b));
  }

  // As its keys have it: by its number where it has no name.
  std::string name_of(std::string_view id) const {
    for (const FrameBody& body : side_.bodies)
      if (!body.name.empty() && fmt::format("{}", body.id) == id) return body.name;
    return fmt::format("#{}", id);
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
    if (!rest.starts_with(one.get<FrameSide>().name + "/")) continue;
    prefix = one.get<FrameSide>().name + "/";
    rest.remove_prefix(prefix.size());
    side = &one;
    break;
  }
  return Entities(prefix, *side).of(parts_of(rest));
}

}  // namespace lantern::publish
