// Goes into each mutated test program: after each test, a line in the file LANTERN_MUTANT_LOG with
// its name, its seconds of the processor, and the numbers of the mutants that it reached.
#include <cstdlib>
#include <ctime>
#include <fstream>

#include <gtest/gtest.h>

#include "base/mutant.hpp"

namespace lantern::mutant {
namespace {

class Listener : public ::testing::EmptyTestEventListener {
 public:
  explicit Listener(const char* path) : log_(path) {}

 private:
  void OnTestStart(const ::testing::TestInfo&) override { start_ = std::clock(); }

  // What ran before the first test counts as reached by it.
  void OnTestEnd(const ::testing::TestInfo& test) override {
    log_ << test.test_suite_name() << '.' << test.name() << ' '
         << static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC;
    for (int i = 0; i < kMost; ++i)
      if (reached[static_cast<std::size_t>(i)]) log_ << ' ' << i;
    log_ << std::endl;
    reached.fill(false);
  }

  std::ofstream log_;
  std::clock_t start_ = 0;
};

const bool kListening = [] {
  const char* path = std::getenv("LANTERN_MUTANT_LOG");
  if (path != nullptr) ::testing::UnitTest::GetInstance()->listeners().Append(new Listener(path));
  return path != nullptr;
}();

}  // namespace
}  // namespace lantern::mutant
