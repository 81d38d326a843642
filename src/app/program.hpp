// The program: words of the command line to a run, errors to exit codes.
#pragma once

#include <vector>

#include "draw/panel.hpp"
#include "spatial/own_structure.hpp"

namespace lantern::app {

// A panel of a program's own.
using OwnPanel = PanelEntry;

// Reads the command line, does what it asks for, and gives the exit code. Throws nothing. With
// structures or panels of your own every scenario may name them, and every command knows them; a
// name that is not of a–z, 0–9 and _ or that is taken ends with a message and exit code 2. To be
// called once.
int run_program(int argc, char** argv, std::vector<OwnKind> own = {},
                std::vector<OwnPanel> panels = {});

}  // namespace lantern::app
