#include "report/pictures.hpp"

#include <cmath>
#include <optional>

#include "base/file.hpp"
#include "render/png.hpp"
#include "render/renderer.hpp"
#include "render/svg.hpp"

namespace lantern {
namespace {

struct Pixels {
  int width = 0, height = 0;
  bool operator==(const Pixels&) const = default;
};

Pixels pixels_of(const DrawList& list) {
  return {static_cast<int>(std::lround(list.page.x)), static_cast<int>(std::lround(list.page.y))};
}

}  // namespace

void save_pictures(const std::filesystem::path& folder, std::span<const ReportPage> pages,
                   const Theme& theme, Backend backend) {
  for (const ReportPage& page : pages) {
    const Pixels size = pixels_of(page.list);
    write_file(folder / (page.name + ".svg"),
               to_svg(page.list, theme, false, size.width, size.height));
  }
  std::optional<Renderer> renderer;
  Pixels rendered;
  Image image;
  for (const ReportPage& page : pages) {
    const Pixels size = pixels_of(page.list);
    if (!renderer || size != rendered) {
      renderer.reset();  // a context is current until the next one is made: one at a time
      renderer.emplace(Context::create(backend), size.width, size.height);
      rendered = size;
    }
    renderer->draw(page.list, theme, false, image);
    write_file(folder / (page.name + ".png"), encode_png(image, PngEffort::small, {}, 0));
  }
}

}  // namespace lantern
