// How bodies that touch are parted: the names of the methods. What they do is in
// contact_solver.hpp.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace lantern::physics {

enum class ContactMethod {
  none,     // bodies pass through each other; joints hold as with `soft`
  impulse,  // sequential impulses, swept over a few times a step
  soft,     // sub-steps, in each of which all rows are solved at once; penetration is eased out
  direct,   // the same without sub-steps
  lecture,  // one pass over the pairs, an impulse each, as the lecture does it; no friction, joints
};

// "none", "impulse", "soft", "direct", "lecture"; nothing for a name that is none of them.
std::string_view to_string(ContactMethod method);
std::optional<ContactMethod> contact_method_named(std::string_view name);
std::vector<std::string_view> contact_method_names();  // in the order of the enumerators

}  // namespace lantern::physics
