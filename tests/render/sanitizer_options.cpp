// Mesa and LLVM never free what they keep for the whole process (compiled shaders, screens,
// tables), and are never unloaded: the leak checker would report them and nothing of ours. The
// other checks stay on. Read by the address sanitizer's runtime, if it is linked in.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }
