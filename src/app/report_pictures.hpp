// Pages of a report as files.
#pragma once

#include <span>
#include <string>

#include "base/file.hpp"
#include "draw/draw_list.hpp"
#include "draw/theme.hpp"
#include "render/context.hpp"

namespace lantern::app {

struct ReportPage {
  std::string name;  // of its files, without an ending
  DrawList list;
};

// NAME.svg and NAME.png for each page, a pixel a page unit. The SVG files come first: they need no
// OpenGL. Each says of which `report` it is a page. Throws IoError, and BackendError if there is
// none.
void save_pictures(const Folder& folder, std::string_view report, std::span<const ReportPage> pages,
                   const Theme& theme, Backend backend);

// Is the file a page that save_pictures wrote for such a report, and that nobody has changed since?
bool is_page_of(std::string_view report, const Folder& folder, const std::string& file);

}  // namespace lantern::app
