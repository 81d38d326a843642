#include "base/name.hpp"

#include <mutex>
#include <unordered_set>
#include <utility>

namespace lantern {

Name::Name(std::string text) {
  static std::mutex one_at_a_time;
  static std::unordered_set<std::string>& all = *new std::unordered_set<std::string>;  // for good
  const std::lock_guard lock(one_at_a_time);
  text_ = &*all.insert(std::move(text)).first;
}

}  // namespace lantern
