// Things that are written once and then told by their number.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace lantern::publish {

// Gives equal texts the same number, counted from 0 in the order in which they first come, and
// keeps for each a piece of JSON.
class Numbered {
 public:
  // `make()` gives the JSON of one that is new.
  template <class Make>
  std::uint32_t number(std::string identity, const Make& make) {
    const auto next = static_cast<std::uint32_t>(numbers_.size());
    const auto [it, fresh] = numbers_.try_emplace(std::move(identity), next);
    if (fresh) {
      const std::string piece = make();
      json_ += json_.empty() ? "" : ",\n";
      json_ += piece;
    }
    return it->second;
  }
  // One that is its own JSON.
  std::uint32_t number(const std::string& json) {
    return number(json, [&] { return json; });
  }

  std::size_t size() const { return numbers_.size(); }
  std::size_t bytes() const { return json_.size(); }
  std::string json() const { return "[" + json_ + "]"; }

 private:
  std::unordered_map<std::string, std::uint32_t> numbers_;
  std::string json_;
};

}  // namespace lantern::publish
