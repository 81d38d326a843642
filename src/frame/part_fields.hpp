// Lists of fields. A struct that frames tell says all its members once, in one expression:
//
//   static auto fields(auto& r, auto&& v) {
//     return v("from", r.from)("hits", r.hits).drawn(r.color);
//   }
//
// v(name, member)               a member of the facts; an optional that is empty is left out
// v(name, member, member)       several as one array
// v.when(so, name, member)      only if it is so
// v.or_null(so, name, ...)      null if it is not so
// v.words(name, flag, no, yes)  one of two words
// v.flat(member)                the fields of a struct, among these
// v.flat_world(name, member)    only of a flat world
// v.drawn(member, ...)          not in the facts
// v.told(name, make)            a value that is made of members
//
// From it follow the facts in JSON and what the lists take in memory. One that leaves a member out
// does not compile.
#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/hash.hpp"
#include "base/json_writer.hpp"
#include "base/stop.hpp"
#include "frame/frame.hpp"
#include "geometry/box.hpp"
#include "spatial/structure.hpp"

namespace lantern::frame {

// So many members are in a list.
template <std::size_t N = 0>
struct FieldCount {
  static constexpr std::size_t kCount = N;
  auto drawn(const auto&... m) const { return FieldCount<N + sizeof...(m)>(); }
  auto operator()(std::string_view, const auto&... m) const { return drawn(m...); }
  auto when(bool, std::string_view, const auto& m) const { return drawn(m); }
  auto or_null(bool, std::string_view, const auto&... m) const { return drawn(m...); }
  auto words(std::string_view, bool m, const char*, const char*) const { return drawn(m); }
  auto flat(const auto& m) const { return drawn(m); }
  auto flat_world(std::string_view, const auto& m) const { return drawn(m); }
  FieldCount told(std::string_view, const auto&) const { return {}; }
};

// Converts to every member.
struct AnyMember {
  template <class T>
  operator T() const;
};
template <class T, std::size_t... I>
constexpr bool takes_members(std::index_sequence<I...>) {
  return requires { T{(static_cast<void>(I), AnyMember{})...}; };
}
// Members of an aggregate without bases: as many as it can be made of.
template <class T, std::size_t N = 0>
constexpr std::size_t members_of() {
  if constexpr (takes_members<T>(std::make_index_sequence<N + 1>()))
    return members_of<T, N + 1>();
  else
    return N;
}

template <class T>
concept HasFields = requires(const T& t) {
  T::fields(t, FieldCount<>());
};
template <class T>
constexpr bool tells_all_members() {
  return std::decay_t<decltype(T::fields(std::declval<const T&>(), FieldCount<>()))>::kCount ==
         members_of<T>();
}

template <class T>
constexpr bool is_vector = false;
template <class T>
constexpr bool is_vector<std::vector<T>> = true;
template <class T>
constexpr bool is_optional = false;
template <class T>
constexpr bool is_optional<std::optional<T>> = true;

// What the lists take that a value has, beside its own size.
class ListBytes {
 public:
  template <class... M>
  ListBytes& drawn(const M&... members) {
    (add(members), ...);
    return *this;
  }
  ListBytes& operator()(std::string_view, const auto&... m) { return drawn(m...); }
  ListBytes& when(bool, std::string_view, const auto& m) { return drawn(m); }
  ListBytes& or_null(bool, std::string_view, const auto&... m) { return drawn(m...); }
  ListBytes& words(std::string_view, bool, const char*, const char*) { return *this; }
  ListBytes& flat(const auto& m) { return drawn(m); }
  ListBytes& flat_world(std::string_view, const auto& m) { return drawn(m); }
  ListBytes& told(std::string_view, const auto&) { return *this; }

  std::size_t bytes = 0;

 private:
  template <class T>
  void add(const T& value) {
    if constexpr (is_vector<T>) {
      using Element = typename T::value_type;
      bytes += value.size() * sizeof(Element);
      if constexpr (is_vector<Element> || HasFields<Element>)
        for (const Element& element : value) add(element);
    } else if constexpr (HasFields<T>) {
      T::fields(value, *this);
    }
  }
};

// Values and fields as JSON. Points have as many numbers as the world has dimensions.
class FactsWriter {
 public:
  FactsWriter(JsonWriter& json, int dimension) : json_(json), dimension_(dimension) {}

  // Each on a line of its own; of a list of structs each element.
  template <class T>
  FactsWriter& line(std::string_view name, const T& value) {
    if constexpr (is_optional<T>) {
      if (value) line(name, *value);
    } else {
      json_.line();
      member(name, value);
    }
    return *this;
  }
  template <HasFields T>
  FactsWriter& line(std::string_view name, const std::vector<T>& elements) {
    return list(name, elements, [&](const T& element) { value(element); });
  }
  template <class T>
  FactsWriter& list(std::string_view name, const std::vector<T>& elements, const auto& write) {
    json_.line().key(name).begin_array();
    for (const T& element : elements) {
      stop_if_asked();
      json_.line();
      write(element);
    }
    if (!elements.empty()) json_.line();
    json_.end_array();
    return *this;
  }
  // Of the object that is open, on the line that is begun.
  template <class T>
  FactsWriter& member(std::string_view name, const T& v) {
    if constexpr (is_optional<T>) {
      if (v) member(name, *v);
    } else {
      json_.key(name);
      value(v);
    }
    return *this;
  }
  FactsWriter& null(std::string_view name) {
    json_.key(name).null();
    return *this;
  }

  template <class T>
  void value(const T& v) {
    if constexpr (std::is_arithmetic_v<T> || std::convertible_to<T, std::string_view>)
      json_.value(v);
    else if constexpr (std::is_enum_v<T>)
      json_.value(to_string(v));
    else
      object(v);
  }
  template <class T>
  void value(const std::vector<T>& elements) {
    json_.begin_array();
    for (const T& element : elements) value(element);
    json_.end_array();
  }
  template <class... T>
  void array(const T&... elements) {
    json_.begin_array();
    (value(elements), ...);
    json_.end_array();
  }
  void value(const Vec<2>& v) { array(v.x, v.y); }
  void value(const Vec<3>& v) { dimension_ == 3 ? array(v.x, v.y, v.z) : array(v.x, v.y); }
  void value(const Pair& pair) { array(pair.a, pair.b); }
  template <int D>
  void value(const Box<D>& box) {
    json_.begin_object();
    member("min", box.lo).member("max", box.hi);
    json_.end_object();
  }
  template <HasFields T>
  void object(const T& v);

  JsonWriter& json() { return json_; }
  int dimension() const { return dimension_; }

 private:
  JsonWriter& json_;
  int dimension_;
};

// Fields as members of the object that is open, each on a line of its own or all on one.
class FieldWriter {
 public:
  FieldWriter(FactsWriter& facts, bool lines) : facts_(facts), lines_(lines) {}

  template <class... M>
  FieldWriter& operator()(std::string_view name, const M&... members) {
    if constexpr (sizeof...(M) == 1) {
      (lines_ ? (facts_.line(name, members), ...) : (facts_.member(name, members), ...));
    } else {
      if (lines_) facts_.json().line();
      facts_.json().key(name);
      facts_.array(members...);
    }
    return *this;
  }
  FieldWriter& when(bool so, std::string_view name, const auto& member) {
    return so ? (*this)(name, member) : *this;
  }
  FieldWriter& or_null(bool so, std::string_view name, const auto&... members) {
    if (so) return (*this)(name, members...);
    facts_.null(name);
    return *this;
  }
  FieldWriter& words(std::string_view name, bool flag, const char* no, const char* yes) {
    return (*this)(name, flag ? yes : no);
  }
  template <HasFields T>
  FieldWriter& flat(const T& member) {
    static_assert(tells_all_members<T>());
    T::fields(member, *this);
    return *this;
  }
  FieldWriter& flat_world(std::string_view name, const auto& member) {
    return when(facts_.dimension() == 2, name, member);
  }
  FieldWriter& drawn(const auto&...) { return *this; }
  FieldWriter& told(std::string_view name, const auto& make) { return (*this)(name, make()); }

 private:
  FactsWriter& facts_;
  bool lines_;
};

template <HasFields T>
void FactsWriter::object(const T& v) {
  static_assert(tells_all_members<T>(), "its list of fields leaves a member out");
  json_.begin_object();
  FieldWriter writer(*this, false);
  T::fields(v, writer);
  json_.end_object();
}

// A part's fields are lines of the facts, or, if it says `kIsObject`, one object of its name. What
// of it is state it adds to the frame's hash by `add_state`, if it has that.
template <class P>
const PartType& part_type() {
  static_assert(tells_all_members<P>(), "the part's list of fields leaves a member out");
  static const PartType type{P::kName,
                             [](const std::any& part, int dimension, JsonWriter& json) {
                               const P& p = std::any_cast<const P&>(part);
                               FactsWriter facts(json, dimension);
                               FieldWriter lines(facts, true);
                               if constexpr (requires { P::kIsObject; })
                                 lines(P::kName, p);
                               else
                                 P::fields(p, lines);
                             },
                             [](const std::any& part) {
                               ListBytes sum;
                               sum.drawn(std::any_cast<const P&>(part));
                               return sizeof(P) + sum.bytes;
                             },
                             [](const std::any& part, Hash& hash) {
                               if constexpr (requires(const P& p) { p.add_state(hash); })
                                 std::any_cast<const P&>(part).add_state(hash);
                             }};
  return type;
}

}  // namespace lantern::frame
