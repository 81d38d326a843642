// Draws a DrawList with OpenGL 3.3 core into a framebuffer object of its own.
#pragma once

#include "draw/draw_list.hpp"
#include "draw/theme.hpp"
#include "render/context.hpp"
#include "render/image.hpp"
#include "render/instances.hpp"

namespace lantern::render {

// A picture that was drawn, until the next one is.
struct Drawn {
  const Image& image;
  const std::vector<bool>& changed;  // of each row: does it differ from the picture before?
  // Outside of these, which do not overlap, it does not.
  const std::vector<PixelRect>& parts;
  std::int64_t pixels = 0;  // of the parts: they were drawn anew
  // Of all that any renderer drew, from 1, and that of its renderer's picture before, or 0.
  std::uint64_t number = 0, before = 0;
};

class Renderer {
 public:
  // Takes the context, compiles the shaders. Belongs to the calling thread.
  Renderer(std::unique_ptr<Context> context, int width, int height);
  ~Renderer();

  bool is_for(int width, int height) const;

  // The page fills the image. `transparent` leaves out the paper: alpha is 0 where nothing is
  // drawn. Only what differs from the picture before is painted and read, which changes no pixel.
  Drawn draw(const DrawList& list, const Theme& theme, bool transparent);
  // The same into an image of the caller's, which is overwritten, its memory reused.
  void draw(const DrawList& list, const Theme& theme, bool transparent, Image& image);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lantern::render
