// The name of a scenario, which its folder, its frames and its pages are called after.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scenario/scenario.hpp"

namespace lantern::scenario {

// 1 to 64 of a–z, 0–9 and _: never a path. A name that was read from a file, which anybody may have
// written, becomes a file's name only as this; and only of() makes one.
class ScenarioName {
 public:
  // Nothing for a text that is no such name.
  static std::optional<ScenarioName> of(std::string_view text);

  const std::string& text() const { return text_; }
  bool operator==(const ScenarioName&) const = default;

 private:
  explicit ScenarioName(std::string_view text) : text_(text) {}

  std::string text_;
};

// Of a scenario that was read: the language sees to it.
ScenarioName name_of(const Scenario& scenario);

}  // namespace lantern::scenario
