#include "base/library.hpp"

#include <dlfcn.h>

namespace lantern {

Library::Library(std::initializer_list<const char*> names) {
  for (const char* name : names) {
    name_ = name;
    handle_ = ::dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (handle_) return;
    const char* why = ::dlerror();
    problem_ = why ? why : "it cannot be loaded";
  }
}

void* Library::symbol(const char* name) const { return handle_ ? ::dlsym(handle_, name) : nullptr; }

}  // namespace lantern
