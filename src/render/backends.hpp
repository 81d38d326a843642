// How each backend is started. Only context.cpp needs to know.
#pragma once

#include <memory>
#include <string>

#include "render/context.hpp"

namespace lantern {

// A context, or why there is none.
struct Attempt {
  std::unique_ptr<Context> context;
  std::string library;  // file name tried last
  std::string problem;  // empty if there is a context; names the package to install
};

Attempt try_osmesa();
Attempt try_egl();

}  // namespace lantern
