// The whole program, under another name.
#include <lantern/app/program.hpp>
#include <lantern/version.hpp>

static_assert(LANTERN_VERSION_MAJOR == 0 && LANTERN_VERSION_MINOR >= 3);

int main(int argc, char** argv) { return lantern::app::run_program(argc, argv); }
