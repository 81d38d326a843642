#include "app/program.hpp"

int main(int argc, char** argv) { return lantern::app::run_program(argc, argv); }
