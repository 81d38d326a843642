// Ctrl-C and kill: the program ends within 0.2 s, wherever it is.
#pragma once

namespace lantern::app {

// From here on SIGINT and SIGTERM are a wish to stop (base/stop.hpp), which our own loops hear. For
// what cannot hear it (a driver, a compiler of shaders, another engine, a pipe that nobody reads) a
// timer ends the process soon after, with exit code 130; files are whole at every moment, so that
// nothing finished is lost. Writes to a closed pipe, or beyond a limit, fail as other writes do.
void catch_interrupts();

// What is finished is about to be saved and told: the timer gives it a few seconds. A second signal
// then ends the process at once.
void give_time_to_save();

}  // namespace lantern::app
