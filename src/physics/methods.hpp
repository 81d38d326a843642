// How bodies are moved, turned and parted: the names of the methods. What they do is in
// integrate/integrator.hpp, body.hpp (turn_freely) and contact/contact_solver.hpp. An integrator or
// a contact solver that a program adds has a number beyond those that have a name here.
#pragma once

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "base/check.hpp"
#include "base/ranges.hpp"

namespace lantern::physics {

enum class Integrator {
  explicit_euler,
  semi_implicit_euler,
  velocity_verlet,
  runge_kutta_4,
  implicit_midpoint,
  implicit_euler,
  kahan_li_8,
  dormand_prince,
};

enum class RotationMethod {
  exact,                // the solution of the free top, to rounding
  splitting_2,          // exact turns about fixed axes, one after the other; second order
  splitting_4,          // five such steps composed so that their errors cancel; fourth order
  explicit_gyroscopic,  // a warning: the textbook update of angular velocity; L and energy drift
};

enum class ContactMethod {
  none,     // bodies pass through each other; joints hold as with `soft`
  impulse,  // sequential impulses, swept over a few times a step
  soft,     // sub-steps, in each of which all rows are solved at once; penetration is eased out
  direct,   // the same without sub-steps
  lecture,  // one pass over the pairs, an impulse each, as the lecture does it; no friction, joints
};

// The name of a method, which is that of its enumerator if it has one; the method of a name,
// nothing for a name that is none of them; and all names, in the order of the enumerators.
std::string_view to_string(Integrator integrator);
std::string_view to_string(RotationMethod method);
std::string_view to_string(ContactMethod method);
std::optional<Integrator> integrator_named(std::string_view name);
std::optional<ContactMethod> contact_method_named(std::string_view name);
std::vector<std::string_view> integrator_names();
std::vector<std::string_view> contact_method_names();

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

// Methods, each of which has a `name`, by the numbers of the enumeration. A program may add some
// when it begins; they outlive the list.
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
    return mapped(methods_, [](const Method* method) { return method->name; });
  }
  Enumeration add(const Method& method) {
    methods_.push_back(&method);
    return static_cast<Enumeration>(methods_.size() - 1);
  }

 private:
  std::vector<const Method*> methods_;
};

}  // namespace lantern::physics
