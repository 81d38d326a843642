// The program: words of the command line to a run, errors to exit codes.
#pragma once

namespace lantern::app {

// Reads the command line, does what it asks for, and gives the exit code. Throws nothing.
int run_program(int argc, char** argv);

}  // namespace lantern::app
