#include "render/context.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "render/backends.hpp"
#include "render/gl.hpp"
#include "render/headroom.hpp"

namespace lantern {
namespace {

std::string describe(const Context& context) {
  const Gl gl(context);
  const auto text = [&](GLenum what) {
    const GLubyte* bytes = gl.GetString(what);
    return std::string(bytes ? reinterpret_cast<const char*>(bytes) : "unknown");
  };
  return fmt::format("{}, OpenGL {}", text(GL_RENDERER), text(GL_VERSION));
}

// A context that lacks a function which Lantern calls is none.
Attempt attempt(Attempt (*start)()) {
  Attempt made = start();
  if (made.context) try {
      const Gl complete(*made.context);
    } catch (const BackendError& error) {
      made.context.reset();
      made.problem = error.what();
    }
  return made;
}

BackendReport report(std::string name, Attempt (*start)()) {
  BackendReport r;
  r.name = std::move(name);
  try {
    require_room_for_context();
    const Attempt made = attempt(start);
    r.library = made.library;
    r.problem = made.problem;
    r.works = made.context != nullptr;
    if (r.works) r.renderer = describe(*made.context);
  } catch (const BackendError& error) {
    r.problem = error.what();
  }
  return r;
}

}  // namespace

std::optional<Backend> backend_named(std::string_view name) {
  if (name == "auto") return Backend::automatic;
  if (name == "osmesa") return Backend::osmesa;
  if (name == "egl") return Backend::egl;
  return std::nullopt;
}

std::unique_ptr<Context> Context::create(Backend backend) {
  require_room_for_context();
  std::string problems;
  if (backend != Backend::egl) {
    Attempt osmesa = attempt(try_osmesa);
    if (osmesa.context) return std::move(osmesa.context);
    problems += fmt::format("\n  osmesa: {}", osmesa.problem);
  }
  if (backend != Backend::osmesa) {
    Attempt egl = attempt(try_egl);
    if (egl.context) return std::move(egl.context);
    problems += fmt::format("\n  egl: {}", egl.problem);
  }
  throw BackendError(fmt::format("no graphics backend could be started:{}", problems));
}

std::vector<BackendReport> examine_backends() {
  std::vector<BackendReport> reports;
  reports.push_back(report("osmesa", try_osmesa));
  reports.push_back(report("egl", try_egl));
  return reports;
}

}  // namespace lantern
