#include "render/context.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <thread>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>
#include <malloc.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include "base/child.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"
#include "render/gl.hpp"

namespace lantern::render {
namespace {

// Measured with the Mesa of Debian 12: 300 MB with libraries and shaders, of these 100 MB once
// there is a context, and two threads a core, of at most 32. The rest is for other versions.
constexpr std::uint64_t kContext = 400'000'000, kShaders = 160'000'000;  // bytes
constexpr std::uint64_t kMostCores = 32;

// A picture is there three times (drawn, read back, encoded) while shaders are compiled.
constexpr std::uint64_t kBytesPerPixel = 12;

// Is there so little that the allocator must save?
bool is_limited() {
  constexpr rlim_t kPlenty = rlim_t{4} << 30;
  for (const auto which : {RLIMIT_AS, RLIMIT_DATA})
    if (rlimit limit{}; ::getrlimit(which, &limit) == 0 && limit.rlim_cur < kPlenty) return true;
  return false;
}

std::uint64_t stack_bytes() {
  pthread_attr_t defaults;
  std::size_t bytes = 0;
  if (::pthread_getattr_default_np(&defaults) != 0) return bytes;
  ::pthread_attr_getstacksize(&defaults, &bytes);
  ::pthread_attr_destroy(&defaults);
  return bytes;
}

void require_room(std::uint64_t bytes) {
  void* room = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (const auto budget = room == MAP_FAILED ? budget_needed(bytes) : std::nullopt) try {
      refuse_memory(*budget, "pictures by OpenGL", "make them smaller, or SVG where that will do");
    } catch (const Refused& refused) {  // neither the picture nor the backend is wrong
      throw std::runtime_error(refused.what());
    }
  if (room == MAP_FAILED)
    throw BackendError(
        "out of memory: OpenGL needs room for {} MB, which the limits of this process do not "
        "leave; raise them (ulimit -v, ulimit -d), or draw with --format svg",
        bytes / 1'000'000);
  ::munmap(room, bytes);
}

// --- OSMesa, Mesa's off-screen interface: a context without any window system. Gone since Mesa
// 25.1. ---

// From <GL/osmesa.h>, which drags in the old <GL/gl.h>.
constexpr int kFormat = 0x22, kRgba = 0x1908, kProfile = 0x33, kCoreProfile = 0x34;
constexpr int kMajor = 0x36, kMinor = 0x37;

struct OsMesaFunctions {
  void* (*create)(const int* attributes, void* shared) = nullptr;
  void (*destroy)(void*) = nullptr;
  unsigned char (*make_current)(void*, void* pixels, unsigned type, int w, int h) = nullptr;
  void* (*function)(const char* name) = nullptr;

  bool find_in(const Library& library) {
    return library.find(create, "OSMesaCreateContextAttribs") &&
           library.find(destroy, "OSMesaDestroyContext") &&
           library.find(make_current, "OSMesaMakeCurrent") &&
           library.find(function, "OSMesaGetProcAddress");
  }
};

class OsmesaContext : public Context {
 public:
  OsmesaContext(const OsMesaFunctions& functions, void* handle)
      : functions_(functions), handle_(handle) {}
  ~OsmesaContext() override {
    functions_.make_current(nullptr, nullptr, 0, 0, 0);
    functions_.destroy(handle_);
  }
  OsmesaContext& operator=(OsmesaContext&&) = delete;  // nor any other copy or move

  bool make_current() {
    constexpr unsigned kUnsignedByte = GL_UNSIGNED_BYTE;
    return functions_.make_current(handle_, unused_.data(), kUnsignedByte, kSide, kSide) != 0;
  }
  void* function(const char* name) const override { return functions_.function(name); }
  std::string_view backend() const override { return "osmesa"; }

 private:
  // OSMesa insists on a buffer of its own; frames go to a framebuffer object instead.
  static constexpr int kSide = 4;
  std::array<std::uint8_t, 4 * kSide * kSide> unused_{};
  OsMesaFunctions functions_;
  void* handle_;
};

std::unique_ptr<Context> start_osmesa(std::string& file) {
  const Library library({"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"});
  file = library.name();
  OsMesaFunctions functions;
  if (!library.loaded())
    throw BackendError("{}; install the package libosmesa6", library.problem());
  if (!functions.find_in(library))
    throw BackendError("{} is too old; install the package libosmesa6 of Mesa 12 or newer", file);
  const std::array attributes{kFormat, kRgba, kProfile, kCoreProfile, kMajor, 3, kMinor, 3, 0};
  void* const handle = functions.create(attributes.data(), nullptr);
  if (!handle)
    throw BackendError("{} offers no OpenGL 3.3 core; install libosmesa6 of Mesa 12 or newer",
                       file);
  auto context = std::make_unique<OsmesaContext>(functions, handle);
  if (!context->make_current()) throw BackendError("{} cannot make its context current", file);
  return context;
}

// --- EGL on Mesa's surfaceless platform: no display, no window, no surface ---

#define LANTERN_EGL_FUNCTIONS(X) \
  X(Initialize)                  \
  X(BindAPI)                     \
  X(ChooseConfig) X(CreateContext) X(DestroyContext) X(MakeCurrent) X(ReleaseThread) X(GetError)

struct EglFunctions {
  decltype(&::eglGetProcAddress) function = nullptr;
  PFNEGLGETPLATFORMDISPLAYEXTPROC platform_display = nullptr;
#define LANTERN_EGL_MEMBER(name) decltype(&::egl##name) name = nullptr;
  LANTERN_EGL_FUNCTIONS(LANTERN_EGL_MEMBER)
#undef LANTERN_EGL_MEMBER

  bool find_in(const Library& library) {
    if (!library.find(function, "eglGetProcAddress")) return false;
    platform_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(function("eglGetPlatformDisplayEXT"));
#define LANTERN_EGL_FIND(name) &&library.find(name, "egl" #name)
    return platform_display LANTERN_EGL_FUNCTIONS(LANTERN_EGL_FIND);
#undef LANTERN_EGL_FIND
  }
};

class EglContext : public Context {
 public:
  EglContext(const EglFunctions& egl, EGLDisplay display) : egl_(egl), display_(display) {}
  ~EglContext() override {
    egl_.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) egl_.DestroyContext(display_, context_);
    // The display is shared by all contexts of this process, so it is not terminated.
    egl_.ReleaseThread();
  }
  EglContext& operator=(EglContext&&) = delete;  // nor any other copy or move

  // The step that failed; null if the context is current.
  const char* start() {
    if (!egl_.BindAPI(EGL_OPENGL_API)) return "eglBindAPI";
    // No surface is ever made, so any configuration will do, and none if need be.
    constexpr EGLint kWanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                  EGL_NONE};
    constexpr EGLint kCore[] = {EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                EGL_CONTEXT_MAJOR_VERSION,
                                3,
                                EGL_CONTEXT_MINOR_VERSION,
                                3,
                                EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!egl_.ChooseConfig(display_, kWanted, &config, 1, &count) || count == 0)
      config = nullptr;  // EGL_NO_CONFIG_KHR
    context_ = egl_.CreateContext(display_, config, EGL_NO_CONTEXT, kCore);
    if (context_ == EGL_NO_CONTEXT) return "eglCreateContext (OpenGL 3.3 core)";
    const bool current = egl_.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
    return current ? nullptr : "eglMakeCurrent";
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

std::unique_ptr<Context> start_egl(std::string& file) {
  const auto failed = [](const std::string& what) {
    return BackendError(what + "; install the packages libegl1 and libgl1-mesa-dri");
  };
  // Without a graphics card Mesa warns on standard error before it falls back to software. What
  // matters to the user is thrown; who wants to hear Mesa sets the variable himself.
  ::setenv("EGL_LOG_LEVEL", "fatal", 0);
  const Library library({"libEGL.so.1"});
  file = library.name();
  EglFunctions egl;
  if (!library.loaded()) throw failed(library.problem());
  if (!egl.find_in(library)) throw failed(file + " lacks platform displays");
  const EGLDisplay display =
      egl.platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || !egl.Initialize(display, nullptr, nullptr))
    throw failed(fmt::format("no surfaceless display (EGL error {:#x})", egl.GetError()));
  auto context = std::make_unique<EglContext>(egl, display);
  if (const char* step = context->start())
    throw failed(fmt::format("{} failed (EGL error {:#x})", step, egl.GetError()));
  return context;
}

// --- all of them ---

struct Starter {
  Backend backend;
  const char* name;
  // Throws BackendError that says why there is none, and names the package to install. `file` is
  // the name of the library tried last.
  std::unique_ptr<Context> (*start)(std::string& file);
};
constexpr Starter kStarters[] = {{Backend::osmesa, "osmesa", start_osmesa},
                                 {Backend::egl, "egl", start_egl}};

std::string describe(const Gl& gl) {
  const auto text = [&](GLenum what) {
    const GLubyte* bytes = gl.GetString(what);
    return std::string(bytes ? reinterpret_cast<const char*>(bytes) : "unknown");
  };
  return fmt::format("{}, OpenGL {}", text(GL_RENDERER), text(GL_VERSION));
}

}  // namespace

void require_room_for_context() {
  if (is_limited()) ::mallopt(M_ARENA_MAX, 1);
  const std::uint64_t cores =
      std::min<std::uint64_t>(std::thread::hardware_concurrency(), kMostCores);
  require_room(kContext + 2 * cores * stack_bytes());
}

void require_room_for_pixels(std::uint64_t pixels) {
  require_room(kShaders + kBytesPerPixel * pixels);
}

Gl::Gl(const Context& context) {
  const auto load = [&]<class Function>(Function& function, const char* name) {
    function = reinterpret_cast<Function>(context.function(name));
    if (!function)
      throw BackendError(
          "the backend {} lacks the function {} of OpenGL 3.3; install a newer package of it",
          context.backend(), name);
  };
#define LANTERN_GL_LOAD(name) load(name, "gl" #name);
  LANTERN_GL_FUNCTIONS(LANTERN_GL_LOAD)
#undef LANTERN_GL_LOAD
}

std::optional<Backend> backend_named(std::string_view name) {
  if (name == "auto") return Backend::automatic;
  for (const Starter& starter : kStarters)
    if (name == starter.name) return starter.backend;
  return std::nullopt;
}

std::unique_ptr<Context> Context::create(Backend backend) {
  require_room_for_context();
  std::string problems, file;
  for (const Starter& starter : kStarters) try {
      if (backend != Backend::automatic && backend != starter.backend) continue;
      std::unique_ptr<Context> context = starter.start(file);
      const Gl complete(*context);
      return context;
    } catch (const BackendError& error) {
      problems += fmt::format("\n  {}: {}", starter.name, error.what());
    }
  throw BackendError("no graphics backend could be started:{}", problems);
}

std::vector<BackendReport> examine_backends() {
  std::vector<BackendReport> reports;
  for (const Starter& starter : kStarters) {
    BackendReport& report = reports.emplace_back();
    report.name = starter.name;
    try {
      require_room_for_context();
      const std::unique_ptr<Context> context = starter.start(report.library);
      report.renderer = describe(Gl(*context));
      report.works = true;
    } catch (const BackendError& error) {
      report.problem = error.what();
    }
  }
  return reports;
}

}  // namespace lantern::render
