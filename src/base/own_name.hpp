// Names of what a program adds of its own: structures, panels.
#pragma once

#include <string_view>

namespace lantern {

// Throws Refused if the name of such a thing, a "panel", is not of a–z, 0–9 and _, or if it is
// taken.
void require_own_name(std::string_view thing, std::string_view name, bool is_taken);

}  // namespace lantern
