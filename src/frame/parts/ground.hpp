// What an author paints: land under all else, and bodies in colours of their own.
#pragma once

#include "frame/frame.hpp"

namespace lantern::frame {

// Of a flat world: drawn under all else, and met by nobody.
struct FrameLand {
  static constexpr std::string_view kName = "land";
  std::vector<Polygon> land;
  bool sea = true;

  static decltype(auto) fields(const auto& r, auto&& v) { return v.drawn(r.land, r.sea); }
};

// Of bodies with colours of an author's own.
struct FramePaints {
  static constexpr std::string_view kName = "paints";
  std::vector<BodyPaint> paints;

  static decltype(auto) fields(const auto& r, auto&& v) { return v.drawn(r.paints); }
};

}  // namespace lantern::frame
