// The OpenGL functions that Lantern calls, looked up in a context.
#pragma once

#define GL_GLEXT_PROTOTYPES  // for their types alone
#include <GL/glcorearb.h>

#include "render/context.hpp"

// Their names without "gl".
// clang-format off
#define LANTERN_GL_FUNCTIONS(X) \
  X(ActiveTexture) X(AttachShader) X(BindBuffer) X(BindFramebuffer) X(BindRenderbuffer) \
  X(BindTexture) X(BindVertexArray) X(BlendFunc) X(BufferData) X(BufferSubData) \
  X(CheckFramebufferStatus) X(Clear) X(ClearColor) X(CompileShader) X(CreateProgram) \
  X(CreateShader) X(DeleteShader) X(Disable) X(DrawArraysInstanced) X(Enable) \
  X(EnableVertexAttribArray) X(FramebufferRenderbuffer) X(GenBuffers) X(GenFramebuffers) \
  X(GenRenderbuffers) X(GenTextures) X(GenVertexArrays) X(GetError) X(GetIntegerv) \
  X(GetProgramInfoLog) X(GetProgramiv) X(GetString) X(GetUniformLocation) X(LinkProgram) \
  X(PixelStorei) X(ReadPixels) X(RenderbufferStorage) X(ShaderSource) X(TexBuffer) X(Uniform1i) \
  X(Uniform2f) X(UseProgram) X(VertexAttribDivisor) X(VertexAttribIPointer) \
  X(VertexAttribPointer) X(Viewport)
// clang-format on

namespace lantern::render {

struct Gl {
  // Throws BackendError naming the first function that the context does not have.
  explicit Gl(const Context& context);

#define LANTERN_GL_MEMBER(name) decltype(&::gl##name) name = nullptr;
  LANTERN_GL_FUNCTIONS(LANTERN_GL_MEMBER)
#undef LANTERN_GL_MEMBER
};

}  // namespace lantern::render
