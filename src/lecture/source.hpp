// This room's own source, as it was compiled: what a picture shows of it is what runs.
#pragma once

#include <array>
#include <string_view>

namespace lantern::lecture {

struct SourceFile {
  std::string_view name;  // "quad_tree.hpp"
  std::string_view text;
};

// The files that hold the lecture's functions.
std::array<SourceFile, 5> own_source();

}  // namespace lantern::lecture
