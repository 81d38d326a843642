#include "base/own_name.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.hpp"

namespace lantern {

void require_own_name(std::string_view thing, std::string_view name, bool is_taken) {
  const bool written_well = !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
  if (!written_well)
    throw Refused(fmt::format("{} '{}': a name is of a–z, 0–9 and _", thing, name));
  if (is_taken)
    throw Refused(fmt::format("{} '{}': there is one of this name already", thing, name));
}

}  // namespace lantern
