#include "base/parallel.hpp"

#include <atomic>
#include <stdexcept>

#include <gtest/gtest.h>

namespace lantern {
namespace {

TEST(InParallel, DoesEachPartOnce) {
  for (const unsigned parts : {0u, 1u, 2u, 5u}) {
    std::vector<std::atomic<int>> done(8);
    in_parallel(parts, [&](unsigned part) { ++done[part]; });
    for (unsigned part = 0; part < done.size(); ++part)
      EXPECT_EQ(done[part], part < std::max(parts, 1u) ? 1 : 0) << part << " of " << parts;
  }
}

TEST(InParallel, ThrowsWhatTheFirstPartThrewAfterAllHaveEnded) {
  std::atomic<int> ended{0};
  try {
    in_parallel(4, [&](unsigned part) {
      ++ended;
      if (part >= 2) throw std::runtime_error(part == 2 ? "two" : "three");
    });
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "two");
  }
  EXPECT_EQ(ended, 4);
}

}  // namespace
}  // namespace lantern
