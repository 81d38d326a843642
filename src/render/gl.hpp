// The OpenGL functions that Lantern calls, looked up in a context, and the room that they need.
#pragma once

#define GL_GLEXT_PROTOTYPES  // for their types alone
#include <cstdint>

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

// Room for code that is not ours and does not survive an allocation that fails: Mesa and the
// compiler behind it end the process. So they are called only where there is enough.
//
// Throws BackendError unless an OpenGL context, its threads and its shaders find room within the
// limits of this process (ulimit -v, ulimit -d), and std::runtime_error if it is the budget
// (--memory) that leaves none. Under such a limit all threads share one arena of the allocator from
// now on: arenas of their own would take more than all the rest.
void require_room_for_context();

// The same for a framebuffer of so many pixels, in a context that is there.
void require_room_for_pixels(std::uint64_t pixels);

}  // namespace lantern::render
