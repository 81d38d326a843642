#include "app/render_job.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "app/run_scenario.hpp"
#include "app/selection.hpp"
#include "base/file.hpp"
#include "base/hash.hpp"
#include "draw/page.hpp"
#include "embedded/version.hpp"
#include "render/svg.hpp"
#include "spatial/structure_kind.hpp"

namespace lantern::app {
namespace {

constexpr const char* kUsualSize = "1600x900";
constexpr int kUsualDots = 160;  // to the inch: a frame of 1600 pixels is 10 inches wide on paper

// The ids of two files differ unless they show the same frame in the same way. A new version of
// Lantern changes none of them, so that files can be compared.
SvgWords svg_words(const RenderJob& job, const Frame& frame, const MadeFrom& from) {
  const std::uint64_t key = Hash().add(frame.scenario).add(from.picture).value();
  return {frame.title, frame.caption, fmt::format("l{:08x}-", key >> 32),
          job.options.text == "text"};
}

}  // namespace

RenderJob::RenderJob(const RenderOptions& o)
    : options(o),
      backend(*backend_named(o.backend)),
      format(o.format == "svg" ? FileKind::svg : FileKind::png),
      in_betweens(o.tween, o.fps) {
  std::tie(picture.width, picture.height) =
      parse_size(o.size.empty() ? kUsualSize : o.size, Renderer::kMostPixels);
  picture.theme = *theme_named(o.theme);
  picture.transparent = o.transparent;
  picture.effort = o.png == "small" ? PngEffort::small : PngEffort::fast;
  picture.pixels_per_metre = static_cast<int>(std::lround(o.dpi / 0.0254));
  picture.threads =
      o.threads.value_or(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
}

Display RenderJob::display_of(const Frame& frame) const {
  Display display = frame.display;
  if (options.no_title) display.title = false;
  if (options.no_caption) display.caption = false;
  if (options.no_counters) display.counters = false;
  if (options.legend) display.legend = true;
  return display;
}

Vec<2> RenderJob::points() const {
  return Vec<2>(picture.width, picture.height) * (72.0 / options.dpi);
}

DrawList RenderJob::page_of(const Frame& frame, const Staging& staging, Work& work) const {
  const Vec<2> page = page_for(picture.width, picture.height);
  const Display display = display_of(frame);
  if (display == frame.display) return draw_frame(frame, staging, page, work);
  Frame switched = frame;
  switched.display = display;
  return draw_frame(switched, staging, page, work);
}

namespace {

// What a structure that this program was given says depends on its code, which is no part of
// Lantern's sources.
std::uint64_t program_hash() {
  constexpr std::size_t kMostBytes = std::size_t{1} << 31;
  static const std::uint64_t hash =
      std::hash<std::string>()(read_file("/proc/self/exe", kMostBytes));
  return hash;
}

}  // namespace

Manifest RenderJob::manifest(const Scenario& scenario, Pace pace) const {
  Manifest m(name_of(scenario));
  m.title = scenario.title;
  m.seed = scenario.seed;
  m.pace = pace;
  m.size = fmt::format("{}x{}", picture.width, picture.height);
  m.theme = options.theme;
  m.format = format;
  m.png = picture.effort;
  m.transparent = options.transparent;
  m.in_betweens = in_betweens.setting();
  m.in_between_digits =
      std::max(2, static_cast<int>(fmt::formatted_size("{}", in_betweens.most())));
  m.scenario_hash = scenario.text_hash;
  if (known_structures().size() > kStructureKinds.size()) m.scenario_hash ^= program_hash();
  for (const auto& [on, name] :
       {std::pair{options.no_title, "no-title"}, std::pair{options.no_caption, "no-caption"},
        std::pair{options.no_counters, "no-counters"}, std::pair{options.legend, "legend"}})
    if (on) m.switches.emplace_back(name);
  if (format == FileKind::svg && options.text == "text") m.switches.emplace_back("text");
  if (format == FileKind::png && options.dpi != kUsualDots)
    m.switches.push_back(fmt::format("dpi-{}", options.dpi));
  return m;
}

std::vector<PngText> texts_of(const Frame& frame) {
  return {{"Title", frame.title},
          {"Software", fmt::format("Lantern {}", kVersion)},
          {"Scenario", frame.scenario},
          {"Frame", fmt::format("{}", frame.index)},
          {"Seed", fmt::format("{}", frame.seed)}};
}

std::string picture_of(const RenderJob& job, const Pipeline::Config& as, const Frame& frame,
                       const DrawList& list, const MadeFrom& from, Work& work) {
  if (job.format == FileKind::svg)
    return sealed(
        FileKind::svg,
        to_svg(list, as.theme, as.transparent, as.width, as.height, svg_words(job, frame, from)),
        from);
  Renderer renderer(Context::create(job.backend), as.width, as.height);
  ++work.graphics_contexts;
  Image image;
  renderer.draw(list, as.theme, as.transparent, image);
  ++work.frames_drawn;
  ++work.frames_encoded;
  return sealed(FileKind::png, encode_png(image, as.effort, texts_of(frame), as.pixels_per_metre),
                from);
}

}  // namespace lantern::app
