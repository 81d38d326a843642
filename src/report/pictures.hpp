// Pages of a report as files.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "draw/draw_list.hpp"
#include "draw/theme.hpp"
#include "render/context.hpp"

namespace lantern {

struct ReportPage {
  std::string name;  // of its files, without an ending
  DrawList list;
};

// NAME.svg and NAME.png for each page, a pixel a page unit. The SVG files come first: they need no
// OpenGL. Throws IoError, and BackendError if there is none.
void save_pictures(const std::filesystem::path& folder, std::span<const ReportPage> pages,
                   const Theme& theme, Backend backend);

}  // namespace lantern
