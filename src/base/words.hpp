// The fixed words of pictures and pages in another language. Code says them in English; a table has
// what stands for each. Diagnostics, help and the names in facts are English always.
#pragma once

#include <concepts>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/number.hpp"

namespace lantern {

// How a language chooses among the forms of a noun by the number before it, as the plural rules of
// the Unicode CLDR do for whole numbers.
enum class Plural {
  one,        // 1 · others: English, German, Spanish
  up_to_one,  // 0 and 1 · others: French, Portuguese of Brazil
  polish,     // 1 · 2 to 4, 22 to 24, … · others
  russian,    // 1, 21, … · 2 to 4, 22 to 24, … · others
  czech,      // 1 · 2 to 4 · others
  none,       // one form: Japanese, Chinese, Turkish
};
// How many forms there are, and which of them `number` takes, from 0.
std::size_t forms_of(Plural plural);
std::size_t form_of(Plural plural, std::int64_t number);

struct WordTable {
  std::string language = "en";  // as HTML's lang: "de", "pt-BR"
  Plural plural = Plural::one;
  char decimal = '.';
  std::map<std::string, std::string, std::less<>> said;   // fixed words, by the English ones
  std::map<std::string, std::string, std::less<>> texts;  // a scenario's own, by what it says
  std::vector<std::string> missing = {};                  // fixed words that it lacks
  std::vector<std::string> idle = {};                     // texts that were not needed yet
};

// The table in which words are said now, on this thread; null for English.
const WordTable* spoken();

// Words are said in this table, or in English if it is null, as long as one of these lives. The
// table must outlive it.
class Speaking {
 public:
  explicit Speaking(const WordTable* words);
  ~Speaking();
  Speaking(const Speaking&) = delete;

 private:
  const WordTable* before_;
};

// What stands for a fixed word or sentence: itself if the table lacks it.
std::string word(std::string_view english);

// Of the forms of a noun, "leaf/leaves", the one for `number`. kMany asks for the form of many.
constexpr std::int64_t kMany = 100;
std::string noun(std::string_view forms, std::int64_t number);

// A form as it stands, chosen by the language's rule: for nouns that an author gave. A noun without
// a slash has one form; one with other forms than the language has is of another, as English is.
std::string own_noun(std::string_view forms, std::int64_t number);

// The name of a node as it is read: "root" and "front.back" are words, "1.3" is not.
std::string node_words(std::string_view label);

// With the decimal sign of the language: "1,5".
std::string decimal(std::string number);

// A number in a sentence, which decimal() has been over.
struct Fraction {
  double value;
};
decltype(auto) sayable(const auto& value) {
  if constexpr (std::floating_point<std::decay_t<decltype(value)>>)
    return Fraction{value};
  else
    return (value);
}
std::string say_formatted(std::string_view english, fmt::format_args args);

// A sentence about these: fmt's format, whose translation may take them in another order, as {1}.
template <class... T>
std::string say(fmt::format_string<const T&...> english, const T&... values) {
  return [&](const auto&... sayables) {
    const fmt::string_view text = english;
    return say_formatted({text.data(), text.size()}, fmt::make_format_args(sayables...));
  }(sayable(values)...);
}

// "1 candidate pair", "12 candidate pairs" of the noun "candidate pair/candidate pairs".
std::string say_count(std::integral auto number, std::string_view forms) {
  return fmt::format("{} {}", grouped(number), noun(forms, static_cast<std::int64_t>(number)));
}

}  // namespace lantern

template <>
struct fmt::formatter<lantern::Fraction> : fmt::formatter<double> {
  template <class Context>
  auto format(const lantern::Fraction& number, Context& context) const {
    fmt::memory_buffer digits;
    fmt::basic_format_context<fmt::appender, char> into(fmt::appender(digits), {});
    fmt::formatter<double>::format(number.value, into);
    const std::string text = lantern::decimal(fmt::to_string(digits));
    return std::copy(text.begin(), text.end(), context.out());
  }
};
