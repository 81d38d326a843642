// A library with the name and the functions of OSMesa's that is not whole: LACKS_symbol leaves out
// one of its functions, LACKS_function one of OpenGL's.
#include <cstring>

namespace {

// What is asked for while a context is made; nothing is ever drawn.
void do_nothing() {}

}  // namespace

extern "C" {

void* OSMesaCreateContextAttribs(const int*, void*) {
  static int context;
  return &context;
}
void OSMesaDestroyContext(void*) {}
#ifndef LACKS_symbol
unsigned char OSMesaMakeCurrent(void*, void*, unsigned, int, int) { return 1; }
#endif
void* OSMesaGetProcAddress(const char* name) {
  return std::strcmp(name, "glTexBuffer") == 0 ? nullptr : reinterpret_cast<void*>(do_nothing);
}

}  // extern "C"
