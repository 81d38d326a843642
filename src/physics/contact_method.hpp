// How bodies that touch are parted.
#pragma once

#include <optional>
#include <string_view>

namespace lantern {

enum class ContactMethod {
  none,     // bodies pass through each other
  impulse,  // the lecture's impulses, iterated
  soft,     // the step is cut into sub-steps, and penetration is pushed out softly in each
};

// "none", "impulse", "soft"; nothing for a name that is none of them.
std::string_view to_string(ContactMethod method);
std::optional<ContactMethod> contact_method_named(std::string_view name);

}  // namespace lantern
