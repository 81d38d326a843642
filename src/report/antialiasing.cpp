#include "report/antialiasing.hpp"

#include <array>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/stop.hpp"
#include "render/renderer.hpp"
#include "report/cairo_peer.hpp"
#include "report/settled.hpp"

namespace lantern::report {
namespace {

// A frame of a film: every polygon is elsewhere, if by less than can be seen.
void nudge(DrawList& list) {
  for (DrawShape& shape : list.shapes)
    if (auto* polygon = std::get_if<PolygonShape>(&shape))
      for (Vec<2>& point : polygon->points) point += Vec<2>(1e-7);
}

constexpr std::array<const char*, std::variant_size_v<DrawShape>> kParts = {"rects", "lines",
                                                                            "polygons", "texts"};

// Shapes of one kind alone.
DrawList only(const DrawList& list, std::size_t kind) {
  DrawList part;
  part.page = list.page;
  for (const DrawShape& shape : list.shapes)
    if (shape.index() == kind) part.shapes.push_back(shape);
  return part;
}

class Measurer {
 public:
  Measurer(const PictureScene& scene, const PictureConfig& config, const Theme& theme)
      : name_(scene.name),
        config_(config),
        theme_(theme),
        list_(settled(scene.list, config.width, config.height)),
        reference_(reference_picture(list_, theme, config.width, config.height, config.backend)) {}

  PictureRow coverage(int times) {
    Renderer renderer(Context::create(config_.backend), times * config_.width,
                      times * config_.height);
    Image large, small;
    const auto draw = [&](const DrawList& list) {
      renderer.draw(list, theme_, false, times == 1 ? small : large);
      if (times > 1) box_filter(large, times, small);
    };
    draw(list_);
    PictureRow row = made("coverage", fmt::format("{0} x {0}", times), error_of(small, reference_));
    DrawList moving = list_;
    row.timing = timed(config_.timing, [&] {
      nudge(moving);
      draw(moving);
    });
    return row;
  }

  PictureRow cairo(CairoAntialias antialias, const char* choice) {
    CairoPeer peer(config_.width, config_.height, antialias);
    Image image;
    peer.draw(list_, theme_);
    peer.read(image);
    PictureRow row = made("cairo", choice, error_of(image, reference_));
    row.version = peer.version();
    DrawList moving = list_;
    row.timing = timed(config_.timing, [&] {
      nudge(moving);
      peer.draw(moving, theme_);
    });
    return row;
  }

  // One kind of shape by coverage, and by cairo if there is one. None if there is no such shape.
  std::vector<PictureRow> part(std::size_t kind, bool with_cairo) const {
    const DrawList list = only(list_, kind);
    if (list.shapes.empty()) return {};
    const int width = config_.width, height = config_.height;
    const ReferencePicture reference =
        reference_picture(list, theme_, width, height, config_.backend);
    Image image;
    Renderer(Context::create(config_.backend), width, height).draw(list, theme_, false, image);
    std::vector<PictureRow> rows{
        made("coverage", "1 x 1", error_of(image, reference), kParts[kind])};
    if (!with_cairo) return rows;
    CairoPeer peer(width, height);
    peer.draw(list, theme_);
    peer.read(image);
    rows.push_back(made("cairo", "default", error_of(image, reference), kParts[kind]));
    rows.back().version = peer.version();
    return rows;
  }

  PictureRow samples(std::size_t which) const {
    return made("samples", std::to_string(kSampleCounts[which]),
                error_of(reference_.sampled[which], reference_));
  }

 private:
  PictureRow made(std::string family, std::string choice, const PictureError& error,
                  std::string part = "") const {
    return {name_,           std::move(family), std::move(choice), "", error, {},
            std::move(part), config_.width,     config_.height};
  }

  std::string name_;
  const PictureConfig& config_;
  const Theme& theme_;
  DrawList list_;
  ReferencePicture reference_;
};

void measure_scene(Measurer& scene, bool with_cairo, const std::function<void()>& told,
                   std::vector<PictureRow>& rows) {
  const auto add = [&](PictureRow row) {
    rows.push_back(std::move(row));
    told();
    stop_if_asked();
  };
  for (const int times : {1, 2, 4}) add(scene.coverage(times));
  constexpr std::array<std::pair<CairoAntialias, const char*>, 4> kCairo = {
      {{CairoAntialias::none, "none"},
       {CairoAntialias::fast, "fast"},
       {CairoAntialias::standard, "default"},
       {CairoAntialias::best, "best"}}};
  for (const auto& [antialias, choice] : kCairo)
    if (with_cairo) add(scene.cairo(antialias, choice));
  for (std::size_t i = 0; i < std::size(kSampleCounts); ++i) add(scene.samples(i));
  for (std::size_t kind = 0; kind < kParts.size(); ++kind)
    for (PictureRow& row : scene.part(kind, with_cairo)) add(std::move(row));
}

}  // namespace

PictureReport measure_pictures(std::span<const PictureScene> scenes, const PictureConfig& config,
                               const std::function<void()>& told) {
  constexpr int kLargest = Renderer::kMostPixels / 4;
  if (config.width < 1 || config.height < 1 || config.width > kLargest || config.height > kLargest)
    throw Refused(
        fmt::format("pictures of {} x {} pixels: to draw them four times as large, each "
                    "side must be 1 ... {}",
                    config.width, config.height, kLargest));
  PictureReport report;
  report.width = config.width;
  report.height = config.height;
  report.backend = Context::create(config.backend)->backend();
  bool with_cairo = true;
  try {
    report.cairo = CairoPeer(1, 1).version();
  } catch (const BackendError& error) {
    report.cairo = error.what();
    with_cairo = false;
  }
  for (const PictureScene& scene : scenes) {
    report.scenes.push_back(scene.name);
    Measurer measurer(scene, config, config.theme);
    measure_scene(measurer, with_cairo, told, report.rows);
  }
  return report;
}

}  // namespace lantern::report
