// An off-screen OpenGL 3.3 core context, from a library that is loaded when it is asked for.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lantern::render {

enum class Backend { automatic, osmesa, egl };
std::optional<Backend> backend_named(std::string_view name);  // auto, osmesa, egl

// A current context. It belongs to the thread that made it.
class Context {
 public:
  virtual ~Context() = default;
  virtual void* function(const char* name) const = 0;  // null if there is none
  virtual std::string_view backend() const = 0;        // "osmesa", "egl"

  // automatic: OSMesa first, then EGL on the surfaceless platform. One whose OpenGL lacks a
  // function that Lantern calls counts as failed, too. Throws BackendError that says for each
  // backend tried what failed and which package brings it, or that there is no room for any.
  static std::unique_ptr<Context> create(Backend backend);
};

// What `lantern doctor` tells of one backend.
struct BackendReport {
  std::string name;
  bool works = false;
  std::string library;   // file name of the library tried last
  std::string renderer;  // GL_RENDERER and GL_VERSION
  std::string problem;   // why it does not work, and what to install
};
std::vector<BackendReport> examine_backends();

}  // namespace lantern::render
