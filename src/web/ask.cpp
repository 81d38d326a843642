// What the page's script calls: one question at a time, as JSON, and its answer.
#include <cstdlib>
#include <string>

#include "embedded/version.hpp"
#include "language/words.hpp"
#include "live/session.hpp"

#define LANTERN_EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace {

lantern::live::Session& session() {
  static lantern::live::Session one;
  return one;
}

std::string answer;

}  // namespace

// A page gives its table; there are no others.
std::shared_ptr<const lantern::WordTable> lantern::language::words_in(std::string_view) {
  return nullptr;
}

// Room for so many bytes of a question, to be given back by leave().
LANTERN_EXPORT(room) char* room(std::size_t bytes) {
  return static_cast<char*>(std::malloc(bytes));
}
LANTERN_EXPORT(leave) void leave(char* bytes) { std::free(bytes); }

// The bytes of the answer, which stands at answer_at() until the next question.
LANTERN_EXPORT(ask) std::size_t ask(const char* question, std::size_t bytes) {
  answer = session().ask({question, bytes});
  return answer.size();
}
LANTERN_EXPORT(answer_at) const char* answer_at() { return answer.data(); }

// Which Lantern this is: the program looks for these letters in the file.
LANTERN_EXPORT(mark) const char* mark() { return lantern::kEngineMark.data(); }
