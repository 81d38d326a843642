#include "render/renderer.hpp"

#include <array>
#include <cstddef>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/stop.hpp"
#include "embedded/shaders.hpp"
#include "render/gl.hpp"
#include "render/headroom.hpp"
#include "render/shape_builder.hpp"

namespace lantern::render {
namespace {

// The shaders give colours multiplied by their coverage; an Image holds them undivided.
void unpremultiply(std::vector<std::uint8_t>& rgba) {
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    const int alpha = rgba[i + 3];
    if (alpha == 0 || alpha == 255) continue;
    for (std::size_t c = i; c < i + 3; ++c)
      rgba[c] = static_cast<std::uint8_t>(std::min(255, (rgba[c] * 255 + alpha / 2) / alpha));
  }
}

}  // namespace

struct Renderer::State {
  State(std::unique_ptr<Context> c, int w, int h)
      : context(std::move(c)), gl(*context), width(w), height(h), builder(w, h) {
    require_room_for_pixels(static_cast<std::uint64_t>(w) * static_cast<std::uint64_t>(h));
    make_framebuffer();
    make_instances();
    make_masks();
  }

  void make_framebuffer() {
    GLint most = 0;
    gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most);
    if (width > most || height > most)
      throw BackendError(fmt::format("the backend {} draws at most {} x {} pixels",
                                     context->backend(), most, most));
    GLuint color = 0, framebuffer = 0;
    gl.GenRenderbuffers(1, &color);
    gl.BindRenderbuffer(GL_RENDERBUFFER, color);
    gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw BackendError(fmt::format("the backend {} makes no framebuffer of {} x {} pixels",
                                     context->backend(), width, height));
    gl.Viewport(0, 0, width, height);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl.Disable(GL_DEPTH_TEST);
    gl.Disable(GL_DITHER);
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  }

  // The attributes of struct Instance, in the order of shape.vert.
  void make_instances() {
    GLuint array = 0;
    gl.GenVertexArrays(1, &array);
    gl.BindVertexArray(array);
    gl.GenBuffers(1, &instances);
    gl.BindBuffer(GL_ARRAY_BUFFER, instances);
    for (GLuint i = 0; i < 6; ++i) {
      gl.EnableVertexAttribArray(i);
      gl.VertexAttribDivisor(i, 1);
    }
  }

  void make_masks() {
    gl.GenBuffers(1, &masks);
    grow_masks(std::size_t{1} << 20);
    GLuint texture = 0;
    gl.GenTextures(1, &texture);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_BUFFER, texture);
    gl.TexBuffer(GL_TEXTURE_BUFFER, GL_R8, masks);
  }

  void grow_masks(std::size_t bytes) {
    GLint most = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    masks_room = std::min(std::max(bytes, 2 * masks_room), static_cast<std::size_t>(most));
    if (bytes > masks_room)
      throw BackendError(fmt::format("the backend {} has no room for {} bytes of text and polygons",
                                     context->backend(), bytes));
    gl.BindBuffer(GL_TEXTURE_BUFFER, masks);
    gl.BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(masks_room), nullptr, GL_DYNAMIC_DRAW);
    masks_sent = 0;
  }

  GLuint compile(GLenum kind, std::string_view source) {
    const GLuint shader = gl.CreateShader(kind);
    const GLchar* code = source.data();
    const auto length = static_cast<GLint>(source.size());
    gl.ShaderSource(shader, 1, &code, &length);
    gl.CompileShader(shader);
    return shader;
  }

  GLuint link(std::string_view fragment_source) {
    if (vertex_shader == 0) vertex_shader = compile(GL_VERTEX_SHADER, shader::shape_vert);
    const GLuint fragment_shader = compile(GL_FRAGMENT_SHADER, fragment_source);
    const GLuint linked = gl.CreateProgram();
    gl.AttachShader(linked, vertex_shader);
    gl.AttachShader(linked, fragment_shader);
    gl.LinkProgram(linked);
    gl.DeleteShader(fragment_shader);
    GLint good = 0;
    gl.GetProgramiv(linked, GL_LINK_STATUS, &good);
    if (!good) {
      std::array<GLchar, 2000> log{};
      gl.GetProgramInfoLog(linked, static_cast<GLsizei>(log.size()), nullptr, log.data());
      throw BackendError(
          fmt::format("the backend {} refuses a shader: {}", context->backend(), log.data()));
    }
    gl.UseProgram(linked);
    gl.Uniform2f(gl.GetUniformLocation(linked, "to_clip"), 2.0f / static_cast<float>(width),
                 2.0f / static_cast<float>(height));
    gl.Uniform1i(gl.GetUniformLocation(linked, "masks"), 0);
    return linked;
  }

  // The box shader can draw everything. Others draw their share of it in half the time, but to
  // compile them takes as long as some ten frames: the first frame does without.
  void use(Program which) {
    if (first_frame) which = Program::box;
    constexpr std::array<const std::string_view*, kPrograms> sources{
        &shader::solid_frag, &shader::mask_frag, &shader::box_frag};
    GLuint& made = programs[static_cast<std::size_t>(which)];
    if (made == 0) made = link(*sources[static_cast<std::size_t>(which)]);
    gl.UseProgram(made);
    if (which == Program::solid)
      gl.Disable(GL_BLEND);
    else
      gl.Enable(GL_BLEND);
  }

  void upload(const MaskStore& store) {
    const std::vector<std::uint8_t>& bytes = store.bytes();
    if (bytes.size() > masks_room) grow_masks(bytes.size());
    if (masks_generation != store.generation()) masks_sent = 0;
    masks_generation = store.generation();
    if (bytes.size() == masks_sent) return;
    gl.BindBuffer(GL_TEXTURE_BUFFER, masks);
    gl.BufferSubData(GL_TEXTURE_BUFFER, static_cast<GLintptr>(masks_sent),
                     static_cast<GLsizeiptr>(bytes.size() - masks_sent), bytes.data() + masks_sent);
    masks_sent = bytes.size();
  }

  void draw_batches(const BatchList& list) {
    gathered.clear();
    for (std::size_t i = 0; i < list.size(); ++i)
      gathered.insert(gathered.end(), list.batches()[i].instances.begin(),
                      list.batches()[i].instances.end());
    if (gathered.empty()) return;
    gl.BindBuffer(GL_ARRAY_BUFFER, instances);
    gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(gathered.size() * sizeof(Instance)),
                  gathered.data(), GL_STREAM_DRAW);
    std::size_t first = 0;  // OpenGL 3.3 cannot start at an instance, but its pointers can
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Batch& batch = list.batches()[i];
      const auto at = [&](std::size_t offset) {
        return reinterpret_cast<const void*>(first * sizeof(Instance) + offset);
      };
      constexpr GLsizei kStride = sizeof(Instance);
      gl.VertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, kStride, at(offsetof(Instance, quad)));
      gl.VertexAttribPointer(1, 4, GL_FLOAT, GL_FALSE, kStride, at(offsetof(Instance, frame)));
      gl.VertexAttribPointer(2, 4, GL_FLOAT, GL_FALSE, kStride, at(offsetof(Instance, box)));
      gl.VertexAttribIPointer(3, 4, GL_INT, kStride, at(offsetof(Instance, data)));
      gl.VertexAttribPointer(4, 4, GL_UNSIGNED_BYTE, GL_TRUE, kStride,
                             at(offsetof(Instance, fill)));
      gl.VertexAttribPointer(5, 4, GL_UNSIGNED_BYTE, GL_TRUE, kStride,
                             at(offsetof(Instance, stroke)));
      stop_if_asked();
      use(batch.program);
      gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(batch.instances.size()));
      first += batch.instances.size();
    }
    first_frame = false;
  }

  // The context goes last: everything in it dies with it.
  std::unique_ptr<Context> context;
  Gl gl;
  int width, height;
  ShapeBuilder builder;

 private:
  GLuint vertex_shader = 0;
  std::array<GLuint, kPrograms> programs{};  // 0 until needed: compiling takes longer than drawing
  GLuint instances = 0;
  std::vector<Instance> gathered;
  GLuint masks = 0;            // a buffer that shaders read as an array of texels
  std::size_t masks_room = 0;  // bytes
  std::size_t masks_sent = 0;  // bytes that the GPU already has
  std::uint64_t masks_generation = 0;
  bool first_frame = true;
};

Renderer::Renderer(std::unique_ptr<Context> context, int width, int height) {
  if (width < 1 || height < 1 || width > kMostPixels || height > kMostPixels)
    throw Refused(fmt::format("an image of {} x {} pixels: each side must be 1 ... {}", width,
                              height, kMostPixels));
  // What the driver draws to, and what it is read into.
  require_memory(std::uint64_t{8} * width * height,
                 fmt::format("the pixels of a picture of {} x {}", width, height),
                 "make it smaller (--size, or the atlas's size)");
  state_ = std::make_unique<State>(std::move(context), width, height);
}

Renderer::~Renderer() = default;

void Renderer::draw(const DrawList& list, const Theme& theme, bool transparent, Image& image) {
  stop_if_asked();
  State& s = *state_;
  s.builder.build(list, theme);
  s.upload(s.builder.masks());
  const Color& c = theme[Role::paper];
  if (transparent)
    s.gl.ClearColor(0, 0, 0, 0);
  else
    s.gl.ClearColor(c.r / 255.0f, c.g / 255.0f, c.b / 255.0f, 1);
  s.gl.Clear(GL_COLOR_BUFFER_BIT);
  s.draw_batches(s.builder.batches());

  image.width = s.width;
  image.height = s.height;
  image.rgba.resize(std::size_t{4} * s.width * s.height);
  s.gl.ReadPixels(0, 0, s.width, s.height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  if (const GLenum error = s.gl.GetError(); error != GL_NO_ERROR)
    throw BackendError(fmt::format("OpenGL reports error {:#x}", error));
  if (transparent) unpremultiply(image.rgba);
}

}  // namespace lantern::render
