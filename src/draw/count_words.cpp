#include "draw/count_words.hpp"

#include "draw/panels.hpp"
#include "language/counts.hpp"

namespace lantern::draw {

std::string count_words(std::string_view name, bool one) {
  const language::CountDoc* count = language::find_count(name);
  return count ? count->words(one) : chart_words(std::string(name));
}

}  // namespace lantern::draw
