// A library to be preloaded: the n-th call of a kind fails, as on a full disk or without memory.
//   FAULT_KIND  open, write, rename, link, unlink, mkdir, sync, or new (an allocation in main())
//   FAULT_AT    which of them, from 1; 0 or more than there are: none
//   FAULT_ERRNO what it fails with; ENOSPC is 28
//   FAULT_DIR   only calls for paths below this folder count; allocations always do
//   FAULT_LOG   a file that gets the number of calls, once the program ends
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace {

std::atomic<long> calls{0};

// Who asks for memory before main() cannot be told that there is none.
std::atomic<bool> begun{false};
using Main = int (*)(int, char**, char**);
Main real_main = nullptr;

int begin(int argc, char** argv, char** environment) {
  begun = true;
  return real_main(argc, argv, environment);
}

const char* wish(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value ? value : otherwise;
}

bool counts(const char* kind) {
  static const char* const wanted = wish("FAULT_KIND", "");
  return std::strcmp(kind, wanted) == 0;
}

bool is_the_one() {
  static const long at = std::atol(wish("FAULT_AT", "0"));
  return ++calls == at;
}

bool is_below(const char* path) {
  static const char* const folder = wish("FAULT_DIR", "");
  return path && std::strncmp(path, folder, std::strlen(folder)) == 0;
}

// True if this call has to fail; errno is set.
bool fails(const char* kind, const char* path) {
  if (!counts(kind) || !is_below(path) || !is_the_one()) return false;
  errno = std::atoi(wish("FAULT_ERRNO", "28"));
  return true;
}

bool fails(const char* kind, int descriptor) {
  if (!counts(kind)) return false;
  char link[64], path[4096] = {};
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  if (::readlink(link, path, sizeof path - 1) < 0) return false;
  return fails(kind, path);
}

// The same of an entry of an open folder.
bool fails(const char* kind, int folder, const char* name) {
  if (!counts(kind)) return false;
  if (folder == AT_FDCWD || (name && name[0] == '/')) return fails(kind, name);
  char link[64], path[8192] = {};
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", folder);
  const ssize_t size = ::readlink(link, path, 4096);
  if (size < 0) return false;
  std::snprintf(path + size, sizeof path - static_cast<std::size_t>(size), "/%s", name);
  return fails(kind, static_cast<const char*>(path));
}

// The real function of that name.
template <class F>
F real(const char* name) {
  return reinterpret_cast<F>(::dlsym(RTLD_NEXT, name));
}
#define REAL(name) (*real<decltype(&::name)>(#name))

void* allocated(std::size_t size, std::size_t alignment = 0) {
  if (begun && counts("new") && is_the_one()) throw std::bad_alloc();
  if (size == 0) size = 1;
  void* memory = nullptr;
  if (alignment > sizeof(void*)) {
    if (::posix_memalign(&memory, alignment, size) != 0) memory = nullptr;
  } else {
    memory = std::malloc(size);
  }
  if (!memory) throw std::bad_alloc();
  return memory;
}

__attribute__((destructor)) void tell() {
  const char* log = std::getenv("FAULT_LOG");
  if (!log) return;
  char text[32];
  const int size = std::snprintf(text, sizeof text, "%ld\n", calls.load());
  const long file = ::syscall(SYS_openat, AT_FDCWD, log, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (file >= 0) ::syscall(SYS_write, file, text, size);
}

int mode_of(int flags, va_list list) {
  return flags & (O_CREAT | O_TMPFILE) ? va_arg(list, int) : 0;
}

}  // namespace

extern "C" {

int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(),
                      void (*loader_fini)(), void* stack_end) {
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  real_main = main;
  return real<Start>("__libc_start_main")(begin, argc, argv, init, fini, loader_fini, stack_end);
}

int open(const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const int mode = mode_of(flags, list);
  va_end(list);
  return fails("open", path) ? -1 : REAL(open)(path, flags, mode);
}

int openat(int folder, const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const int mode = mode_of(flags, list);
  va_end(list);
  return fails("open", folder, path) ? -1 : REAL(openat)(folder, path, flags, mode);
}

FILE* fopen(const char* path, const char* mode) {
  return fails("open", path) ? nullptr : REAL(fopen)(path, mode);
}

ssize_t write(int file, const void* bytes, size_t size) {
  return fails("write", file) ? -1 : REAL(write)(file, bytes, size);
}

int rename(const char* from, const char* to) {
  return fails("rename", to) ? -1 : REAL(rename)(from, to);
}

int renameat(int from_folder, const char* from, int to_folder, const char* to) {
  return fails("rename", to_folder, to) ? -1 : REAL(renameat)(from_folder, from, to_folder, to);
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
  return fails("link", to_folder, to) ? -1 : REAL(linkat)(from_folder, from, to_folder, to, flags);
}

int unlink(const char* path) { return fails("unlink", path) ? -1 : REAL(unlink)(path); }

int unlinkat(int folder, const char* path, int flags) {
  return fails("unlink", folder, path) ? -1 : REAL(unlinkat)(folder, path, flags);
}

int remove(const char* path) { return fails("unlink", path) ? -1 : REAL(remove)(path); }

int mkdir(const char* path, mode_t mode) {
  return fails("mkdir", path) ? -1 : REAL(mkdir)(path, mode);
}

int mkdirat(int folder, const char* path, mode_t mode) {
  return fails("mkdir", folder, path) ? -1 : REAL(mkdirat)(folder, path, mode);
}

int fsync(int file) { return fails("sync", file) ? -1 : REAL(fsync)(file); }
int fdatasync(int file) { return fails("sync", file) ? -1 : REAL(fdatasync)(file); }
int syncfs(int file) { return fails("sync", file) ? -1 : REAL(syncfs)(file); }

}  // extern "C"

void* operator new(std::size_t size) { return allocated(size); }
void* operator new[](std::size_t size) { return allocated(size); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocated(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return allocated(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
