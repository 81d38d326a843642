#include "render/context.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "render/backends.hpp"
#include "render/gl.hpp"

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

BackendReport report(std::string name, Attempt attempt) {
  BackendReport r;
  r.name = std::move(name);
  r.library = attempt.library;
  r.problem = attempt.problem;
  if (!attempt.context) return r;
  try {
    r.renderer = describe(*attempt.context);
    r.works = true;
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
  std::string problems;
  if (backend != Backend::egl) {
    Attempt osmesa = try_osmesa();
    if (osmesa.context) return std::move(osmesa.context);
    problems += fmt::format("\n  osmesa: {}", osmesa.problem);
  }
  if (backend != Backend::osmesa) {
    Attempt egl = try_egl();
    if (egl.context) return std::move(egl.context);
    problems += fmt::format("\n  egl: {}", egl.problem);
  }
  throw BackendError(fmt::format("no graphics backend could be started:{}", problems));
}

std::vector<BackendReport> examine_backends() {
  std::vector<BackendReport> reports;
  reports.push_back(report("osmesa", try_osmesa()));
  reports.push_back(report("egl", try_egl()));
  return reports;
}

}  // namespace lantern
