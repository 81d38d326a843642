// What the tests of this room share: themes of few colours, pixels by name, processes of their own.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "draw/draw_list.hpp"
#include "draw/theme.hpp"
#include "fresh_folder.hpp"
#include "render/image.hpp"

namespace lantern::render {

// Paper is white, ink black, warning pure red; everything else is mid grey.
Theme plain_theme();

// A page of `width` x `height` units with one shape: at that image size, a unit is a pixel.
DrawList page_of(double width, double height, std::vector<DrawShape> shapes);

// Drawn with the automatic backend. The context lives as long as the program.
Image drawn(const DrawList& list, int width, int height, bool transparent = false,
            const Theme& theme = plain_theme());

struct Rgba {
  int r = 0, g = 0, b = 0, a = 0;
  bool operator==(const Rgba&) const = default;
};
Rgba at(const Image& image, int x, int y);
std::ostream& operator<<(std::ostream& to, const Rgba& p);

// How much black ink a white pixel got, 0 ... 255.
inline int ink(const Image& image, int x, int y) { return 255 - at(image, x, y).r; }

// Runs the test `name`, which is disabled unless asked for, in a new process of this program, with
// these environment variables added. Gives its exit code; 0 means that the test passed.
int run_in_new_process(const std::string& name, const std::map<std::string, std::string>& added);

}  // namespace lantern::render
