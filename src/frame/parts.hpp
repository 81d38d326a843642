// The parts of a frame: what some pictures have and others do not. A part is a plain struct whose
// members are told once, in its list of fields (part_fields.hpp); all else follows from that list.
#pragma once

#include <algorithm>
#include <any>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace lantern {
class Hash;
class JsonWriter;
}  // namespace lantern

namespace lantern::frame {

// What is known of all parts of one type.
struct PartType {
  std::string_view name;
  // Members of the object that is open; points have as many numbers as the world has dimensions.
  void (*write)(const std::any& part, int dimension, JsonWriter& json);
  std::size_t (*bytes)(const std::any& part);  // what its lists take
  void (*add_state)(const std::any& part, Hash& hash);
};

// Of P: where its list of fields is, `template const PartType& part_type<P>();` makes it.
template <class P>
const PartType& part_type();

// At most one part of each type. Copies are whole copies.
class FrameParts {
 public:
  // Null if there is none.
  template <class P>
  const P* find() const {
    const auto at = place_of(part_type<P>());
    return at == parts_.end() ? nullptr : &std::any_cast<const P&>(at->second);
  }
  template <class P>
  P* find() {
    return const_cast<P*>(std::as_const(*this).find<P>());
  }
  // The part that is there, or else a new one.
  template <class P>
  P& add() {
    if (P* part = find<P>()) return *part;
    return std::any_cast<P&>(parts_.emplace_back(&part_type<P>(), P()).second);
  }
  template <class P>
  void drop() {
    std::erase_if(parts_, [](const auto& part) { return part.first == &part_type<P>(); });
  }
  // f(type, part) for each.
  template <class F>
  void each(const F& f) const {
    for (const auto& [type, part] : parts_) f(*type, part);
  }

 private:
  using List = std::vector<std::pair<const PartType*, std::any>>;
  List::const_iterator place_of(const PartType& type) const {
    return std::ranges::find(parts_, &type, &List::value_type::first);
  }
  List parts_;
};

}  // namespace lantern::frame
