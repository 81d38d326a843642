#include "render/cairo.hpp"

#include <array>
#include <new>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/library.hpp"
#include "draw/font.hpp"

namespace lantern::render {
namespace {

// The functions of a library one by one; the first that is missing is told.
class Functions {
 public:
  Functions(const char* name, const char* file) : name_(name), library_({file}) {
    if (!library_.loaded()) refuse(library_.problem());
  }
  template <class Function>
  void take(Function& function, const char* name) const {
    if (!library_.find(function, name)) refuse(fmt::format("{} has no {}", library_.name(), name));
  }

 private:
  // Cairo needs FreeType for its own sake, too: both are named, whichever is broken.
  [[noreturn]] void refuse(const std::string& why) const {
    throw BackendError(
        fmt::format("no {}: {}; install the packages libcairo2 and libfreetype6", name_, why));
  }
  const char* name_;
  Library library_;
};

Cairo loaded_cairo() {
  const Functions library("cairo", "libcairo.so.2");
  Cairo functions;
#define LANTERN_CAIRO_LOAD(result, name, parameters) library.take(functions.name, "cairo_" #name);
  LANTERN_CAIRO_FUNCTIONS(LANTERN_CAIRO_LOAD)
#undef LANTERN_CAIRO_LOAD
  return functions;
}

// Both weights. They stay until the program ends: cairo may keep what it has made of a face longer
// than anybody here can tell.
std::array<void*, 2> loaded_faces() {
  const Functions library("FreeType", "libfreetype.so.6");
  int (*start)(void** library) = nullptr;
  int (*open)(void* library, const void* bytes, long size, long index, void** face) = nullptr;
  library.take(start, "FT_Init_FreeType");
  library.take(open, "FT_New_Memory_Face");
  void* free_type = nullptr;
  if (const int error = start(&free_type); error != 0)
    throw BackendError(fmt::format("FreeType cannot start: error {}", error));
  std::array<void*, 2> faces{};
  for (const Weight weight : {Weight::regular, Weight::semibold}) {
    constexpr int kNoHinting = 2;  // FT_LOAD_NO_HINTING
    const std::string_view bytes = font_file(weight);
    void* face = nullptr;
    if (const int error = open(free_type, bytes.data(), static_cast<long>(bytes.size()), 0, &face);
        error != 0)
      throw BackendError(fmt::format("FreeType cannot read the bundled type: error {}", error));
    void*& made = faces[static_cast<std::size_t>(weight)];
    made = cairo().ft_font_face_create_for_ft_face(face, kNoHinting);
    cairo().require(cairo().font_face_status(made));
  }
  return faces;
}

}  // namespace

void Cairo::require(int code) const {
  constexpr int kNoMemory = 1;  // CAIRO_STATUS_NO_MEMORY
  if (code == kNoMemory) throw std::bad_alloc();
  if (code != 0) throw BackendError(fmt::format("cairo: {}", status_to_string(code)));
}

const Cairo& cairo() {
  static const Cairo functions = loaded_cairo();
  return functions;
}

void* cairo_face(Weight weight) {
  static const std::array<void*, 2> faces = (cairo(), loaded_faces());
  return faces[static_cast<std::size_t>(weight)];
}

}  // namespace lantern::render
