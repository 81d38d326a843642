// The fragment shaders, each compiled when it is worth it.
#include "render/renderer.hpp"

#include <atomic>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "base/memory.hpp"
#include "base/stop.hpp"
#include "embedded/shaders.hpp"
#include "render/damage.hpp"
#include "render/gl.hpp"
#include "render/shape_builder.hpp"

namespace lantern::render {

// In a context that is current, for pictures of one size. Both must outlive this.
class Programs {
 public:
  Programs(const Gl& gl, const Context& context, int width, int height)
      : gl_(gl), context_(context), width_(width), height_(height) {}

  // What is drawn next is this batch. Throws BackendError if a shader is refused.
  // The box shader can draw everything but paper that lets through what is below. Others draw their
  // share of it in half the time, but to compile them takes as long as some ten frames.
  void use(const Batch& batch) {
    Program which = batch.program;
    GLuint& special = programs_[static_cast<std::size_t>(which)];
    std::int64_t& painted = substituted_[static_cast<std::size_t>(which)];
    if (special == 0 && which != Program::box && !batch.erases && painted < kWorthCompiling) {
      painted += batch.pixels;
      which = Program::box;
    }
    constexpr std::array<const std::string_view*, kPrograms> sources{
        &shader::solid_frag, &shader::mask_frag, &shader::box_frag};
    GLuint& made = programs_[static_cast<std::size_t>(which)];
    if (made == 0) made = link(*sources[static_cast<std::size_t>(which)]);
    gl_.UseProgram(made);
    if (which == Program::solid)
      gl_.Disable(GL_BLEND);
    else
      gl_.Enable(GL_BLEND);
  }

 private:
  GLuint compile(GLenum kind, std::string_view source) {
    const GLuint shader = gl_.CreateShader(kind);
    const GLchar* code = source.data();
    const auto length = static_cast<GLint>(source.size());
    gl_.ShaderSource(shader, 1, &code, &length);
    gl_.CompileShader(shader);
    return shader;
  }

  GLuint link(std::string_view fragment_source) {
    if (vertex_shader_ == 0) vertex_shader_ = compile(GL_VERTEX_SHADER, shader::shape_vert);
    const GLuint fragment_shader = compile(GL_FRAGMENT_SHADER, fragment_source);
    const GLuint linked = gl_.CreateProgram();
    gl_.AttachShader(linked, vertex_shader_);
    gl_.AttachShader(linked, fragment_shader);
    gl_.LinkProgram(linked);
    gl_.DeleteShader(fragment_shader);
    GLint good = 0;
    gl_.GetProgramiv(linked, GL_LINK_STATUS, &good);
    if (!good) {
      std::array<GLchar, 2000> log{};
      gl_.GetProgramInfoLog(linked, static_cast<GLsizei>(log.size()), nullptr, log.data());
      throw BackendError("the backend {} refuses a shader: {}", context_.backend(), log.data());
    }
    gl_.UseProgram(linked);
    gl_.Uniform2f(gl_.GetUniformLocation(linked, "to_clip"), 2.0f / static_cast<float>(width_),
                  2.0f / static_cast<float>(height_));
    gl_.Uniform1i(gl_.GetUniformLocation(linked, "masks"), 0);
    return linked;
  }

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
      : context(std::move(c)), gl(*context), width(w), height(h), builder(w, h), damage(w, h) {
    require_room_for_pixels(static_cast<std::uint64_t>(w) * static_cast<std::uint64_t>(h));
    make_framebuffer();
    make_instances();
    make_masks();
  }

  void make_framebuffer() {
    GLint most = 0;
    gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most);
    if (width > most || height > most)
      throw BackendError("the backend {} draws at most {} x {} pixels", context->backend(), most,
                         most);
    GLuint color = 0, framebuffer = 0;
    gl.GenRenderbuffers(1, &color);
    gl.BindRenderbuffer(GL_RENDERBUFFER, color);
    gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw BackendError("the backend {} makes no framebuffer of {} x {} pixels",
                         context->backend(), width, height);
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
      throw BackendError("the backend {} has no room for {} bytes of text and polygons",
                         context->backend(), bytes);
    gl.BindBuffer(GL_TEXTURE_BUFFER, masks);
    gl.BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(masks_room), nullptr, GL_DYNAMIC_DRAW);
    masks_sent = 0;
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
      programs.use(batch);
      gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(batch.instances.size()));
      first += batch.instances.size();
    }
  }

  // What the pixels depend on beside the quads.
  std::uint64_t ground(const Color& paper, bool transparent) const {
    const Hash hash = Hash().add(std::uint64_t{paper.r} << 16 | paper.g << 8 | paper.b);
    return Hash(hash).add(std::uint64_t{transparent}).add(builder.masks().generation()).value();
  }

  // All of the picture, upon cleared paper.
  void draw_all(const Color& paper, bool transparent) {
    if (transparent)
      gl.ClearColor(0, 0, 0, 0);
    else
      gl.ClearColor(paper.r / 255.0f, paper.g / 255.0f, paper.b / 255.0f, 1);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    batches.start(width, height);
    for (const Quad& quad : builder.quads()) batches.add(quad.program, quad.instance, quad.bounds);
    draw_batches(batches);
  }

  // Parts of it, upon paper that covers what was there.
  void draw_parts(const std::vector<PixelRect>& parts, const Color& paper, bool transparent) {
    constexpr float kEverywhere = 1e6f;
    Quad sheet;
    sheet.instance.box = {kEverywhere, kEverywhere, 0, 0};
    if (!transparent) sheet.instance.fill = {paper.r, paper.g, paper.b, 255};
    sheet.bounds = {0, 0, width, height};
    const std::vector<Quad>& quads = builder.quads();
    batches.start(width, height);
    std::vector<std::size_t> firsts;  // of each part, to be painted
    for (const PixelRect& part : parts) {
      const std::optional<std::size_t> cover = covering(quads, part);
      if (!cover) add_clipped(sheet, part, batches);
      firsts.push_back(cover.value_or(0));
    }
    if (transparent && batches.size() > 0) batches.first_erases();
    for (std::size_t p = 0; p < parts.size(); ++p)
      for (std::size_t i = firsts[p]; i < quads.size(); ++i)
        add_clipped(quads[i], parts[p], batches);
    draw_batches(batches);
  }

  // Reads a part of what was drawn; rows in which it differs from `picture` are marked.
  void read(const PixelRect& part, bool transparent) {
    const std::size_t bytes = std::size_t{4} * (part.x1 - part.x0);
    rows.resize(bytes * (part.y1 - part.y0));
    gl.ReadPixels(part.x0, part.y0, part.x1 - part.x0, part.y1 - part.y0, GL_RGBA, GL_UNSIGNED_BYTE,
                  rows.data());
    if (transparent) unpremultiply(rows);
    const std::uint8_t* from = rows.data();
    for (int y = part.y0; y < part.y1; ++y, from += bytes) {
      std::uint8_t* to = &picture.rgba[4 * (static_cast<std::size_t>(y) * width + part.x0)];
      if (std::memcmp(to, from, bytes) == 0) continue;
      std::memcpy(to, from, bytes);
      changed[static_cast<std::size_t>(y)] = true;
    }
  }

  // The context goes last: everything in it dies with it.
  std::unique_ptr<Context> context;
  Gl gl;
  int width, height;
  ShapeBuilder builder;
  Damage damage;
  BatchList batches;
  Image picture;              // drawn last, as an Image holds it
  std::vector<bool> changed;  // its rows: since the one before
  std::uint64_t number = 0;   // of it

 private:
  Programs programs{gl, *context, width, height};
  GLuint instances = 0;
  std::vector<Instance> gathered;
  std::vector<std::uint8_t> rows;  // read last
  GLuint masks = 0;                // a buffer that shaders read as an array of texels
  std::size_t masks_room = 0;      // bytes
  std::size_t masks_sent = 0;      // bytes that the GPU already has
  std::uint64_t masks_generation = 0;
};

Renderer::Renderer(std::unique_ptr<Context> context, int width, int height) {
  if (width < 1 || height < 1 || width > kMostSide || height > kMostSide)
    throw Refused("an image of {} x {} pixels: each side must be 1 ... {}", width, height,
                  kMostSide);
  // What the driver draws to, what it is read into, and the picture.
  require_memory(std::uint64_t{12} * width * height,
                 fmt::format("the pixels of a picture of {} x {}", width, height),
                 "make it smaller (--size, or the atlas's size)");
  state_ = std::make_unique<State>(std::move(context), width, height);
}

Renderer::~Renderer() = default;

bool Renderer::is_for(int width, int height) const {
  return state_->width == width && state_->height == height;
}

Drawn Renderer::draw(const DrawList& list, const Theme& theme, bool transparent) {
  stop_if_asked();
  State& s = *state_;
  const Color& paper = theme[Role::paper];
  s.builder.build(list, theme);
  s.upload(s.builder.masks());
  const std::vector<PixelRect>& parts =
      s.damage.find(s.builder.quads(), s.ground(paper, transparent));
  const bool is_first = s.picture.rgba.empty();
  s.picture.width = s.width;
  s.picture.height = s.height;
  s.picture.rgba.resize(std::size_t{4} * s.width * s.height);
  s.changed.assign(static_cast<std::size_t>(s.height), is_first);
  std::int64_t pixels = 0;
  for (const PixelRect& part : parts) pixels += part.area();
  try {
    if (s.damage.is_all())
      s.draw_all(paper, transparent);
    else if (!parts.empty())
      s.draw_parts(parts, paper, transparent);
    for (const PixelRect& part : parts) s.read(part, transparent);
    if (const GLenum error = s.gl.GetError(); error != GL_NO_ERROR)
      throw BackendError("OpenGL reports error {:#x}", error);
  } catch (...) {
    s.damage.forget();
    throw;
  }
  static std::atomic<std::uint64_t> all = 0;
  const std::uint64_t before = std::exchange(s.number, ++all);
  return {s.picture, s.changed, parts, pixels, s.number, before};
}

void Renderer::draw(const DrawList& list, const Theme& theme, bool transparent, Image& image) {
  image = draw(list, theme, transparent).image;
}

}  // namespace lantern::render
