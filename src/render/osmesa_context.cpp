// Mesa's off-screen interface: a context without any window system. Gone since Mesa 25.1.
#include <array>
#include <cstdint>

#include <GL/glcorearb.h>
#include <fmt/format.h>

#include "base/library.hpp"
#include "render/backends.hpp"

namespace lantern {
namespace {

// From <GL/osmesa.h>, which drags in the old <GL/gl.h>.
constexpr int kFormat = 0x22, kRgba = 0x1908, kProfile = 0x33, kCoreProfile = 0x34;
constexpr int kMajor = 0x36, kMinor = 0x37;

using Handle = void*;

struct OsMesaFunctions {
  Handle (*create)(const int* attributes, Handle shared) = nullptr;
  void (*destroy)(Handle) = nullptr;
  unsigned char (*make_current)(Handle, void* pixels, unsigned type, int w, int h) = nullptr;
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
  OsmesaContext(const OsMesaFunctions& functions, Handle handle)
      : functions_(functions), handle_(handle) {}
  ~OsmesaContext() override {
    functions_.make_current(nullptr, nullptr, 0, 0, 0);
    functions_.destroy(handle_);
  }
  OsmesaContext(const OsmesaContext&) = delete;
  OsmesaContext& operator=(const OsmesaContext&) = delete;

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
  Handle handle_;
};

}  // namespace

Attempt try_osmesa() {
  const Library library({"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"});
  Attempt attempt;
  attempt.library = library.name();
  OsMesaFunctions functions;
  if (!library.loaded()) {
    attempt.problem = fmt::format("{}; install the package libosmesa6", library.problem());
    return attempt;
  }
  if (!functions.find_in(library)) {
    attempt.problem = fmt::format(
        "{} is too old; install the package libosmesa6 of Mesa 12 or newer", library.name());
    return attempt;
  }
  const std::array attributes{kFormat, kRgba, kProfile, kCoreProfile, kMajor, 3, kMinor, 3, 0};
  const Handle handle = functions.create(attributes.data(), nullptr);
  if (!handle) {
    attempt.problem = fmt::format(
        "{} offers no OpenGL 3.3 core; install libosmesa6 of Mesa 12 or newer", library.name());
    return attempt;
  }
  auto context = std::make_unique<OsmesaContext>(functions, handle);
  if (context->make_current())
    attempt.context = std::move(context);
  else
    attempt.problem = fmt::format("{} cannot make its context current", library.name());
  return attempt;
}

}  // namespace lantern
