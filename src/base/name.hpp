// A name as cheap to copy as a number: all that are equal share one text, which is kept for good.
#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>

namespace lantern {

class Name {
 public:
  Name() : Name(std::string()) {}
  Name(std::string text);
  Name(const char* text) : Name(std::string(text)) {}

  operator const std::string&() const { return *text_; }
  const std::string& text() const { return *text_; }
  bool empty() const { return text_->empty(); }
  bool operator==(const Name&) const = default;

 private:
  const std::string* text_;
};

}  // namespace lantern

template <>
struct fmt::formatter<lantern::Name> : fmt::formatter<std::string_view> {
  auto format(const lantern::Name& name, fmt::format_context& context) const {
    return fmt::formatter<std::string_view>::format(name.text(), context);
  }
};
