#include "run/rulers.hpp"

#include <vector>

namespace lantern::run {

std::optional<std::pair<Vec<3>, Vec<3>>> ends_of(const RulerSpec& ruler, const Engine* engine) {
  std::vector<BodyState> states;
  if (engine && (ruler.a || ruler.b)) engine->observe(states);
  const auto end = [&](const std::optional<std::size_t>& body,
                       const Vec<3>& point) -> std::optional<Vec<3>> {
    if (!body) return point;
    if (*body >= states.size() || !states[*body].there) return std::nullopt;
    return states[*body].position;
  };
  const auto from = end(ruler.a, ruler.from), to = end(ruler.b, ruler.to);
  if (!from || !to) return std::nullopt;
  return std::pair{*from, *to};
}

}  // namespace lantern::run
