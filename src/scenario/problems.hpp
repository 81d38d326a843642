// Mistakes in one scenario file, gathered so that all are told in one pass.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenario/source_text.hpp"

namespace lantern::scenario {

class Problems {
 public:
  // A hint is worked out only for the mistakes that are shown, so it may be costly. What it refers
  // to must live until raise().
  using Hint = std::function<std::string()>;

  void add(Place where, std::string message, Hint hint = {});
  void add(Place where, std::string message, std::string hint);
  void add(Place where, std::string message, const char* hint);

  bool any() const { return !found_.empty(); }

  // Adds those of several readings of one file, by their names. What all found is told once, what
  // only one did with its name behind it: "…, on the side 'eager'".
  void add_readings(const std::vector<std::pair<std::string, const Problems*>>& readings);

  // Throws ScenarioError with the first mistakes in order of their places, and the number of the
  // others; does nothing if there are none.
  void raise(const std::string& file, std::string_view text);

 private:
  struct Found {
    Place where;
    std::string message;
    Hint hint;
  };
  void drop_the_latest();

  std::vector<Found> found_;
  std::size_t dropped_ = 0;
};

// The nearest of `candidates`, or all of them if they are few.
std::string nearest(std::string_view name, std::vector<std::string_view> candidates);

}  // namespace lantern::scenario
