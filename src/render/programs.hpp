// The fragment shaders, each compiled when it is worth it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "render/context.hpp"
#include "render/gl.hpp"
#include "render/instances.hpp"

namespace lantern::render {

// In a context that is current, for pictures of one size. Both must outlive this.
class Programs {
 public:
  Programs(const Gl& gl, const Context& context, int width, int height)
      : gl_(gl), context_(context), width_(width), height_(height) {}

  // What is drawn next is this batch. Throws BackendError if a shader is refused.
  void use(const Batch& batch);

 private:
  GLuint compile(GLenum kind, std::string_view source);
  GLuint link(std::string_view fragment_source);

  const Gl& gl_;
  const Context& context_;
  int width_, height_;
  GLuint vertex_shader_ = 0;
  // 0 until needed: compiling takes longer than drawing. Until then the box shader paints their
  // pixels, so many by now.
  std::array<GLuint, kPrograms> programs_{};
  std::array<std::int64_t, kPrograms> substituted_{};
  static constexpr std::int64_t kWorthCompiling = 4'000'000;
};

}  // namespace lantern::render
