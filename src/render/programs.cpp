#include "render/programs.hpp"

#include <cstddef>

#include <fmt/format.h>

#include "base/error.hpp"
#include "embedded/shaders.hpp"

namespace lantern::render {

GLuint Programs::compile(GLenum kind, std::string_view source) {
  const GLuint shader = gl_.CreateShader(kind);
  const GLchar* code = source.data();
  const auto length = static_cast<GLint>(source.size());
  gl_.ShaderSource(shader, 1, &code, &length);
  gl_.CompileShader(shader);
  return shader;
}

GLuint Programs::link(std::string_view fragment_source) {
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
    throw BackendError(
        fmt::format("the backend {} refuses a shader: {}", context_.backend(), log.data()));
  }
  gl_.UseProgram(linked);
  gl_.Uniform2f(gl_.GetUniformLocation(linked, "to_clip"), 2.0f / static_cast<float>(width_),
                2.0f / static_cast<float>(height_));
  gl_.Uniform1i(gl_.GetUniformLocation(linked, "masks"), 0);
  return linked;
}

// The box shader can draw everything but paper that lets through what is below. Others draw their
// share of it in half the time, but to compile them takes as long as some ten frames.
void Programs::use(const Batch& batch) {
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

}  // namespace lantern::render
