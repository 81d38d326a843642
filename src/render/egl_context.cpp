// EGL on Mesa's surfaceless platform: no display, no window, no surface.
#include <array>
#include <cstdlib>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include "base/library.hpp"
#include "render/backends.hpp"

namespace lantern {
namespace {

struct EglFunctions {
  decltype(&::eglGetProcAddress) function = nullptr;
  decltype(&::eglInitialize) initialize = nullptr;
  decltype(&::eglTerminate) terminate = nullptr;
  decltype(&::eglBindAPI) bind_api = nullptr;
  decltype(&::eglChooseConfig) choose_config = nullptr;
  decltype(&::eglCreateContext) create = nullptr;
  decltype(&::eglDestroyContext) destroy = nullptr;
  decltype(&::eglMakeCurrent) make_current = nullptr;
  decltype(&::eglReleaseThread) release_thread = nullptr;
  decltype(&::eglGetError) error = nullptr;
  PFNEGLGETPLATFORMDISPLAYEXTPROC platform_display = nullptr;

  bool find_in(const Library& library) {
    if (!library.find(function, "eglGetProcAddress")) return false;
    platform_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(function("eglGetPlatformDisplayEXT"));
    return platform_display && library.find(initialize, "eglInitialize") &&
           library.find(terminate, "eglTerminate") && library.find(bind_api, "eglBindAPI") &&
           library.find(choose_config, "eglChooseConfig") &&
           library.find(create, "eglCreateContext") && library.find(destroy, "eglDestroyContext") &&
           library.find(make_current, "eglMakeCurrent") &&
           library.find(release_thread, "eglReleaseThread") && library.find(error, "eglGetError");
  }
};

class EglContext : public Context {
 public:
  EglContext(const EglFunctions& egl, EGLDisplay display) : egl_(egl), display_(display) {}
  ~EglContext() override {
    egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) egl_.destroy(display_, context_);
    // The display is shared by all contexts of this process, so it is not terminated.
    egl_.release_thread();
  }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  // The step that failed; null if the context is current.
  const char* start() {
    if (!egl_.bind_api(EGL_OPENGL_API)) return "eglBindAPI";
    // No surface is ever made, so any configuration will do, and none if need be.
    const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                       EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!egl_.choose_config(display_, wanted.data(), &config, 1, &count) || count == 0)
      config = nullptr;  // EGL_NO_CONFIG_KHR
    const std::array<EGLint, 7> version{EGL_CONTEXT_MAJOR_VERSION,
                                        3,
                                        EGL_CONTEXT_MINOR_VERSION,
                                        3,
                                        EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                        EGL_NONE};
    context_ = egl_.create(display_, config, EGL_NO_CONTEXT, version.data());
    if (context_ == EGL_NO_CONTEXT) return "eglCreateContext (OpenGL 3.3 core)";
    if (!egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      return "eglMakeCurrent";
    return nullptr;
  }
  void* function(const char* name) const override {
    return reinterpret_cast<void*>(egl_.function(name));
  }
  std::string_view backend() const override { return "egl"; }

 private:
  EglFunctions egl_;
  EGLDisplay display_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

constexpr const char* kPackages = "install the packages libegl1 and libgl1-mesa-dri";

}  // namespace

Attempt try_egl() {
  // Without a graphics card Mesa warns on standard error before it falls back to software. What
  // matters to the user is in `problem`; who wants to hear Mesa sets the variable himself.
  ::setenv("EGL_LOG_LEVEL", "fatal", 0);
  const Library library({"libEGL.so.1"});
  Attempt attempt;
  attempt.library = library.name();
  EglFunctions egl;
  if (!library.loaded()) {
    attempt.problem = fmt::format("{}; {}", library.problem(), kPackages);
    return attempt;
  }
  if (!egl.find_in(library)) {
    attempt.problem = fmt::format("{} lacks platform displays; {}", library.name(), kPackages);
    return attempt;
  }
  const EGLDisplay display =
      egl.platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || !egl.initialize(display, nullptr, nullptr)) {
    attempt.problem =
        fmt::format("no surfaceless display (EGL error {:#x}); {}", egl.error(), kPackages);
    return attempt;
  }
  auto context = std::make_unique<EglContext>(egl, display);
  if (const char* step = context->start())
    attempt.problem = fmt::format("{} failed (EGL error {:#x}); {}", step, egl.error(), kPackages);
  else
    attempt.context = std::move(context);
  return attempt;
}

}  // namespace lantern
