#include "measure/row.hpp"

namespace lantern {

std::string_view to_string(Status status) {
  constexpr std::string_view kNames[] = {"ok", "diverged", "nan", "refused"};
  return kNames[static_cast<std::size_t>(status)];
}

}  // namespace lantern
