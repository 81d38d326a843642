#include "base/words.hpp"

#include <algorithm>

namespace lantern {
namespace {

thread_local const WordTable* table = nullptr;

// The n-th of forms that slashes part; of too few the last.
std::string_view nth(std::string_view forms, std::size_t n) {
  for (; n > 0; --n) {
    const std::size_t slash = forms.find('/');
    if (slash == forms.npos) break;
    forms.remove_prefix(slash + 1);
  }
  return forms.substr(0, forms.find('/'));
}

std::string_view translated(std::string_view english) {
  if (!table) return english;
  const auto found = table->said.find(english);
  return found == table->said.end() ? english : found->second;
}

}  // namespace

std::size_t forms_of(Plural plural) {
  return plural == Plural::none ? 1 : plural == Plural::one || plural == Plural::up_to_one ? 2 : 3;
}

std::size_t form_of(Plural plural, std::int64_t number) {
  const std::int64_t n = number < 0 ? -number : number;
  const bool few = n % 10 >= 2 && n % 10 <= 4 && (n % 100 < 12 || n % 100 > 14);
  if (plural == Plural::one) return n != 1;
  if (plural == Plural::up_to_one) return n > 1;
  if (plural == Plural::polish) return n == 1 ? 0 : few ? 1 : 2;
  if (plural == Plural::russian) return n % 10 == 1 && n % 100 != 11 ? 0 : few ? 1 : 2;
  if (plural == Plural::czech) return n == 1 ? 0 : n >= 2 && n <= 4 ? 1 : 2;
  return 0;  // there is one form
}

const WordTable* spoken() { return table; }
Speaking::Speaking(const WordTable* words) : before_(std::exchange(table, words)) {}
Speaking::~Speaking() { table = before_; }

std::string word(std::string_view english) { return std::string(translated(english)); }

std::string own_noun(std::string_view forms, std::int64_t number) {
  const auto given = static_cast<std::size_t>(std::ranges::count(forms, '/')) + 1;
  const bool fits = table && forms_of(table->plural) == given;
  return std::string(nth(forms, form_of(fits ? table->plural : Plural::one, number)));
}

std::string noun(std::string_view forms, std::int64_t number) {
  if (table && table->said.contains(forms)) return own_noun(translated(forms), number);
  return std::string(nth(forms, form_of(Plural::one, number)));
}

std::string node_words(std::string_view label) {
  if (!table) return std::string(label);
  const std::size_t dot = std::min(label.find('.'), label.size());
  std::string text = word(label.substr(0, dot));
  return dot == label.size() ? text : text + "." + node_words(label.substr(dot + 1));
}

std::string decimal(std::string number) {
  if (table && table->decimal != '.') std::ranges::replace(number, '.', table->decimal);
  return number;
}

std::string say_formatted(std::string_view english, fmt::format_args args) {
  const std::string_view text = translated(english);
  return fmt::vformat(fmt::string_view(text.data(), text.size()), args);
}

}  // namespace lantern
