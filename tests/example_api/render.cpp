// Pictures: a scenario's frames as SVG, which needs nothing, and as PNG, which needs OSMesa or EGL.
#include <cstdio>
#include <fstream>
#include <string>

#include <lantern/base/error.hpp>
#include <lantern/draw/page.hpp>
#include <lantern/language/scenario.hpp>
#include <lantern/render/png.hpp>
#include <lantern/render/renderer.hpp>
#include <lantern/render/svg.hpp>
#include <lantern/run/director.hpp>

using namespace lantern::render;
namespace run = lantern::run;

constexpr const char* kText = R"(
title = "Two bodies"
[world]
size = [16, 9]
[structure]
kind = "quadtree"
[[body]]
name = "ann"
radius = 0.8
position = [3, 6]
[[body]]
name = "bob"
radius = 0.8
position = [4, 5]
[[step]]
do = "insert"
bodies = ["ann", "bob"]
caption = "They share the root: {pairs:pair} to test."
expect = { pairs = 1 }
)";

int main() try {
  //! [frames]
  const run::Scenario spec = run::parse_scenario(kText, "two_bodies.toml");
  lantern::Work work;  // counts what is done
  std::string svg, png;
  const auto report =
      run::direct(spec, run::Pace::step, work, [&](const lantern::frame::Frame& frame) {
        const DrawList shapes = draw_frame(frame, page_for(640, 360), work);
        const Theme theme = *theme_named("light");

        svg = to_svg(shapes, theme, false, 640, 360);

        Renderer renderer(Context::create(Backend::automatic), 640, 360);
        Image image;
        renderer.draw(shapes, theme, false, image);
        png = encode_png(image, PngEffort::fast, {}, 0);
        return true;  // go on with the next frame
      });
  std::ofstream("two_bodies.svg") << svg;
  std::ofstream("two_bodies.png", std::ios::binary) << png;
  //! [frames]
  std::printf("%u frames, %zu bytes of PNG\n", report.frames, png.size());
  return report.unmet.empty() && decode_png(png) ? 0 : 1;
} catch (const lantern::BackendError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 4;
}
