// A shared library that is loaded while the program runs, not linked.
#pragma once

#include <initializer_list>
#include <string>

namespace lantern {

// Its symbols stay private to it. Once loaded it stays until the program ends: Mesa leaves threads
// and thread-local destructors behind, which must not lose their code.
class Library {
 public:
  // Loads the first of these file names that is there.
  explicit Library(std::initializer_list<const char*> names);

  bool loaded() const { return handle_ != nullptr; }
  const std::string& name() const { return name_; }        // of the one loaded, or tried last
  const std::string& problem() const { return problem_; }  // why none could be loaded
  void* symbol(const char* name) const;                    // null if there is none

  // The function `name`, as the type of `function`; false if there is none.
  template <class Function>
  bool find(Function& function, const char* name) const {
    function = reinterpret_cast<Function>(symbol(name));
    return function != nullptr;
  }

 private:
  void* handle_ = nullptr;
  std::string name_;
  std::string problem_;
};

}  // namespace lantern
