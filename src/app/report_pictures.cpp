#include "app/report_pictures.hpp"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "render/png.hpp"
#include "render/renderer.hpp"
#include "render/svg.hpp"

namespace lantern::app {
namespace {

struct Pixels {
  int width = 0, height = 0;
  bool operator==(const Pixels&) const = default;
};

Pixels pixels_of(const DrawList& list) {
  return {static_cast<int>(std::lround(list.page.x)), static_cast<int>(std::lround(list.page.y))};
}

MadeFrom page_from(std::string_view report, std::string_view page) {
  const auto key = [](std::string_view text) {
    return fmt::format("{:016x}", Hash().add(text).value());
  };
  return {key(report), key(page)};
}

}  // namespace

void save_pictures(const Folder& folder, std::string_view report, std::span<const ReportPage> pages,
                   const Theme& theme, Backend backend) {
  for (const ReportPage& page : pages) {
    const Pixels size = pixels_of(page.list);
    write_file({folder, page.name + ".svg"},
               sealed(FileKind::svg, to_svg(page.list, theme, false, size.width, size.height),
                      page_from(report, page.name)));
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
    write_file({folder, page.name + ".png"},
               sealed(FileKind::png, encode_png(image, PngEffort::small, {}, 0),
                      page_from(report, page.name)));
  }
}

bool is_page_of(std::string_view report, const Folder& folder, const std::string& file) {
  const bool png = file.ends_with(".png");
  if (!png && !file.ends_with(".svg")) return false;
  try {
    constexpr std::size_t kMostBytes = std::size_t{1} << 28;
    const auto bytes = folder.read(file, kMostBytes);
    return bytes && made_from(png ? FileKind::png : FileKind::svg, *bytes) ==
                        page_from(report, file.substr(0, file.size() - 4));
  } catch (const IoError&) {
    return false;
  }
}

}  // namespace lantern::app
