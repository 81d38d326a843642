// Draws a DrawList with OpenGL 3.3 core into a framebuffer object of its own.
#pragma once

#include <memory>

#include "draw/draw_list.hpp"
#include "draw/theme.hpp"
#include "render/context.hpp"
#include "render/image.hpp"

namespace lantern::render {

class Renderer {
 public:
  // Largest width and height, pixels.
  static constexpr int kMostPixels = 8192;

  // Takes the context, compiles the shaders. Belongs to the calling thread.
  Renderer(std::unique_ptr<Context> context, int width, int height);
  ~Renderer();

  // The page fills the image. `transparent` leaves out the paper: alpha is 0 where nothing is
  // drawn. `image` is overwritten, its memory reused.
  void draw(const DrawList& list, const Theme& theme, bool transparent, Image& image);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lantern::render
