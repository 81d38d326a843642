#include "scenario/toml_guard.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace lantern {
namespace {

constexpr int kMostKeyParts = 16;
constexpr int kMostKeyDots = 40'000;  // in a whole file

// One walk over the text that knows just enough TOML: comments, strings, brackets, and whether it
// is in a key or in a value.
class Walk {
 public:
  explicit Walk(std::string_view text) : text_(text) {}

  std::optional<GuardFinding> harm() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#')
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (c == '"' || c == '\'')
        skip_string(c);
      else if ((c & 0x80) != 0)
        return GuardFinding{at_, "not valid TOML: a letter that may stand only in a \"text\""};
      else if (std::string message = pass(c); !message.empty())
        return GuardFinding{at_, std::move(message)};
      else
        ++at_;
    }
    return std::nullopt;
  }

 private:
  // Says what is wrong with `c` at this place; empty if nothing is.
  std::string pass(char c) {
    const bool line_start = line_start_;
    line_start_ = c == '\n' || (line_start && (c == ' ' || c == '\t'));
    switch (c) {
      case '.':
        return in_key_ ? pass_dot() : "";
      case '=':
        return enter_key(false);
      case ',':
        return enter_key(open_.ends_with('{'));
      case '\n':
        return open_.empty() ? enter_key(true) : "";
      case '{':
        open_ += c;
        return enter_key(true);
      case '[':
        return pass_bracket(line_start && open_.empty());
      case ']':
      case '}':
        return pass_closing(c);
      default:
        return "";
    }
  }

  std::string enter_key(bool is_key) {
    in_key_ = is_key;
    parts_ = 1;
    return "";
  }

  std::string pass_dot() {
    if (++parts_ > kMostKeyParts) return fmt::format("a key of more than {} parts", kMostKeyParts);
    if (++dots_ > kMostKeyDots) return fmt::format("more than {} dots in keys", kMostKeyDots);
    return "";
  }

  std::string pass_bracket(bool is_header) {
    if (is_header && !has_name()) return "not valid TOML: a [header] without a name";
    const bool is_second = in_key_ && open_ == "[";  // of a [[header]]
    open_ += '[';
    return enter_key(is_header || is_second);
  }

  std::string pass_closing(char c) {
    if (c == '}' && open_.ends_with('['))
      return "not valid TOML: a '}' in a list that is not closed";
    if (!open_.empty()) open_.pop_back();
    return enter_key(false);
  }

  // Is there a name, or what toml++ can tell from one, behind the header's brackets?
  bool has_name() const {
    std::size_t next = at_ + (text_.substr(at_).starts_with("[[") ? 2 : 1);
    next = text_.find_first_not_of(" \t", next);
    if (next == std::string_view::npos) return true;
    const char c = text_[next];
    const bool is_bare = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    return is_bare || std::string_view("-_\"']").find(c) != std::string_view::npos;
  }

  void skip_string(char quote) {
    const std::string_view rest = text_.substr(at_);
    const bool is_long = rest.size() > 2 && rest[1] == quote && rest[2] == quote;
    const std::string end(is_long ? 3 : 1, quote);
    at_ += end.size();
    line_start_ = false;
    while (at_ < text_.size()) {
      if (text_.substr(at_).starts_with(end)) {
        at_ += end.size();
        return;
      }
      if (!is_long && text_[at_] == '\n') return;
      at_ += quote == '"' && text_[at_] == '\\' ? 2 : 1;
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::string open_;  // brackets and braces that are not closed yet
  bool line_start_ = true;
  bool in_key_ = true;
  int parts_ = 1;  // of the key at `at_`
  int dots_ = 0;   // in keys so far
};

}  // namespace

std::optional<GuardFinding> harm_in(std::string_view text) { return Walk(text).harm(); }

}  // namespace lantern
