// Room for code that is not ours and does not survive an allocation that fails: Mesa and the
// compiler behind it end the process. So they are called only where there is enough.
#pragma once

#include <cstdint>

namespace lantern::render {

// Throws BackendError unless an OpenGL context, its threads and its shaders find room within the
// limits of this process (ulimit -v, ulimit -d), and std::runtime_error if it is the budget
// (--memory) that leaves none. Under such a limit all threads share one arena of the allocator from
// now on: arenas of their own would take more than all the rest.
void require_room_for_context();

// The same for a framebuffer of so many pixels, in a context that is there.
void require_room_for_pixels(std::uint64_t pixels);

}  // namespace lantern::render
