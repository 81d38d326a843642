// The tables of words that are in this program.
#include <map>

#include "base/ranges.hpp"
#include "embedded/words.hpp"
#include "language/words.hpp"

namespace lantern::language {

std::vector<std::string_view> languages() {
  return mapped(words::files(), [](const auto& file) { return file.first; });
}

std::string_view words_file(std::string_view language) {
  for (const auto& [name, text] : words::files())
    if (name == language) return text;
  return "";
}

std::shared_ptr<const WordTable> words_in(std::string_view language) {
  static std::map<std::string, std::shared_ptr<const WordTable>, std::less<>> read;
  if (const auto known = read.find(language); known != read.end()) return known->second;
  const std::string_view text = words_file(language);
  if (text.empty()) return nullptr;
  auto& table = read[std::string(language)];
  return table = std::make_shared<const WordTable>(
             read_words(text, std::string(language) + ".toml", WordTable()));
}

}  // namespace lantern::language
