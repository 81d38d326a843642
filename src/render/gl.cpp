#include "render/gl.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace lantern {
namespace {

template <class Function>
void load(const Context& context, Function& function, const char* name) {
  function = reinterpret_cast<Function>(context.function(name));
  if (!function)
    throw BackendError(fmt::format(
        "the backend {} lacks the function {} of OpenGL 3.3; install a newer package of it",
        context.backend(), name));
}

}  // namespace

Gl::Gl(const Context& context) {
#define LANTERN_GL_LOAD(type, name) load(context, name, "gl" #name);
  LANTERN_GL_FUNCTIONS(LANTERN_GL_LOAD)
#undef LANTERN_GL_LOAD
}

}  // namespace lantern
