// The OpenGL functions that Lantern calls, looked up in a context.
#pragma once

#include <GL/glcorearb.h>

#include "render/context.hpp"

// Type in <GL/glcorearb.h> (between PFNGL and PROC), name without "gl".
#define LANTERN_GL_FUNCTIONS(X)                       \
  X(ACTIVETEXTURE, ActiveTexture)                     \
  X(ATTACHSHADER, AttachShader)                       \
  X(BINDATTRIBLOCATION, BindAttribLocation)           \
  X(BINDBUFFER, BindBuffer)                           \
  X(BINDFRAMEBUFFER, BindFramebuffer)                 \
  X(BINDRENDERBUFFER, BindRenderbuffer)               \
  X(BINDTEXTURE, BindTexture)                         \
  X(BINDVERTEXARRAY, BindVertexArray)                 \
  X(BLENDFUNC, BlendFunc)                             \
  X(BUFFERDATA, BufferData)                           \
  X(BUFFERSUBDATA, BufferSubData)                     \
  X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus)   \
  X(CLEAR, Clear)                                     \
  X(CLEARCOLOR, ClearColor)                           \
  X(COMPILESHADER, CompileShader)                     \
  X(CREATEPROGRAM, CreateProgram)                     \
  X(CREATESHADER, CreateShader)                       \
  X(DELETESHADER, DeleteShader)                       \
  X(DISABLE, Disable)                                 \
  X(DRAWARRAYSINSTANCED, DrawArraysInstanced)         \
  X(ENABLE, Enable)                                   \
  X(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray) \
  X(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer) \
  X(GENBUFFERS, GenBuffers)                           \
  X(GENFRAMEBUFFERS, GenFramebuffers)                 \
  X(GENRENDERBUFFERS, GenRenderbuffers)               \
  X(GENTEXTURES, GenTextures)                         \
  X(GENVERTEXARRAYS, GenVertexArrays)                 \
  X(GETERROR, GetError)                               \
  X(GETINTEGERV, GetIntegerv)                         \
  X(GETPROGRAMINFOLOG, GetProgramInfoLog)             \
  X(GETPROGRAMIV, GetProgramiv)                       \
  X(GETSTRING, GetString)                             \
  X(GETUNIFORMLOCATION, GetUniformLocation)           \
  X(LINKPROGRAM, LinkProgram)                         \
  X(PIXELSTOREI, PixelStorei)                         \
  X(READPIXELS, ReadPixels)                           \
  X(RENDERBUFFERSTORAGE, RenderbufferStorage)         \
  X(SHADERSOURCE, ShaderSource)                       \
  X(TEXBUFFER, TexBuffer)                             \
  X(UNIFORM1I, Uniform1i)                             \
  X(UNIFORM2F, Uniform2f)                             \
  X(USEPROGRAM, UseProgram)                           \
  X(VERTEXATTRIBDIVISOR, VertexAttribDivisor)         \
  X(VERTEXATTRIBIPOINTER, VertexAttribIPointer)       \
  X(VERTEXATTRIBPOINTER, VertexAttribPointer)         \
  X(VIEWPORT, Viewport)

namespace lantern {

struct Gl {
  // Throws BackendError naming the first function that the context does not have.
  explicit Gl(const Context& context);

#define LANTERN_GL_MEMBER(type, name) PFNGL##type##PROC name = nullptr;
  LANTERN_GL_FUNCTIONS(LANTERN_GL_MEMBER)
#undef LANTERN_GL_MEMBER
};

}  // namespace lantern
