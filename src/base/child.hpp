// Other programs: found, run beside this one, and fed through their standard input; and libraries
// that are loaded while this one runs.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

namespace lantern {

// The file that the shell would run by this name, from PATH.
std::optional<std::filesystem::path> find_program(std::string_view name);

// It has a process group of its own, so that Ctrl-C at the terminal reaches only this program, and
// ends with it whatever happens. Its standard output leads nowhere. The calls may come from one
// thread at a time.
class Child {
 public:
  // An open file that is handed on has this number there.
  static constexpr int kHandedOn = 3;

  // Starts `words`, of which the first is the program's file; no shell reads them. Throws IoError.
  explicit Child(const std::vector<std::string>& words,
                 std::optional<int> handed_on = std::nullopt);
  // Without finish(): end().
  ~Child();
  Child& operator=(Child&&) = delete;  // nor any other copy or move

  // Gives it all of the bytes to read. False if it reads no more: it has ended, or closed its
  // input. Throws Stopped when that is asked for, also while it does not read.
  bool write(std::string_view bytes);

  // Ends its input, waits for its end and gives its exit code, 128 + number for a signal, as
  // often as it is called. Throws Stopped.
  int finish();

  // Ends it, and whatever it has started, at once. From any thread, also beside write(), which then
  // gives false, and beside finish().
  void end() noexcept;

  // The end of what it said on standard error, so far.
  const std::string& said() const { return said_; }

 private:
  void listen();
  bool has_ended();

  pid_t process_ = -1;  // none once it was waited for
  std::mutex waiting_;  // while it is waited for, or ended
  int input_ = -1, words_ = -1;
  int status_ = 0;  // once it was
  std::string said_;
};

// A shared library that is loaded, not linked. Its symbols stay private to it. Once loaded it stays
// until the program ends: Mesa leaves threads and thread-local destructors behind, which must not
// lose their code.
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
