#include "draw/keys.hpp"

#include <fmt/format.h>

namespace lantern::draw {
namespace {

std::string name_or_number(const auto& named) {
  return named.name.empty() ? fmt::format("#{}", named.id) : named.name;
}

}  // namespace

std::string way_of(const std::vector<FrameNode>& nodes, std::uint32_t node) {
  const FrameNode& own = nodes[node];
  if (own.parent == kNone) return own.of_static ? "static" : "root";
  std::string way = way_of(nodes, own.parent);
  way += '.';
  return way += fmt::format_int(own.slot).c_str();
}

std::string node_key(std::string_view kind, const std::vector<FrameNode>& nodes,
                     std::uint32_t node) {
  return std::string(kind) + "/" + way_of(nodes, node);
}

std::string node_key(std::string_view kind, const std::vector<FrameNode>& nodes,
                     const FrameNode& node) {
  return node_key(kind, nodes, static_cast<std::uint32_t>(&node - nodes.data()));
}

std::string parent_key(std::string_view kind, const std::vector<FrameNode>& nodes,
                       const FrameNode& node) {
  return node.parent == kNone ? "" : node_key(kind, nodes, node.parent);
}

std::string body_key(std::string_view kind, const FrameBody& body) {
  return fmt::format("{}/{}", kind, name_or_number(body));
}

std::string texture_key(std::string_view kind, const FrameTexture& texture) {
  return fmt::format("{}/{}", kind, name_or_number(texture));
}

std::string pair_key(std::string_view kind, const FrameBody& a, const FrameBody& b) {
  return fmt::format("{}/{}/{}", kind, name_or_number(a), name_or_number(b));
}

}  // namespace lantern::draw
