// Lists of methods, which a program may lengthen when it begins.
#pragma once

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "base/check.hpp"

namespace lantern::physics {

// What a method does in the plane and in space.
template <template <int> class Function>
struct BothDimensions {
  Function<2> plane = nullptr;
  Function<3> space = nullptr;
  template <int D>
  Function<D> in() const {
    if constexpr (D == 2)
      return plane;
    else
      return space;
  }
};

// Methods, each of which has a `name`, by the numbers of the enumeration. They outlive the list.
template <class Enumeration, class Method>
class MethodList {
 public:
  MethodList(std::initializer_list<const Method*> methods) : methods_(methods) {}

  const Method& operator[](Enumeration number) const {
    const auto place = static_cast<std::size_t>(number);
    LANTERN_CHECK(place, <, methods_.size());
    return *methods_[place];
  }
  std::optional<Enumeration> named(std::string_view name) const {
    const auto method = std::ranges::find(methods_, name, &Method::name);
    if (method == methods_.end()) return std::nullopt;
    return static_cast<Enumeration>(method - methods_.begin());
  }
  std::vector<std::string_view> names() const {
    std::vector<std::string_view> all;
    for (const Method* method : methods_) all.push_back(method->name);
    return all;
  }
  Enumeration add(const Method& method) {
    methods_.push_back(&method);
    return static_cast<Enumeration>(methods_.size() - 1);
  }

 private:
  std::vector<const Method*> methods_;
};

}  // namespace lantern::physics
