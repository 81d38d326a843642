#include <cmath>

#include <gtest/gtest.h>

#include "base/number.hpp"
#include "report/document.hpp"

namespace lantern::report {
namespace {

TEST(Figures, AreShort) {
  EXPECT_EQ(seconds_text(0.0008), "0.8 ms") << "as the reader of a bench thinks";
  EXPECT_EQ(seconds_text(12.34), "12.3 s");
  EXPECT_EQ(seconds_text(41.2e-6), "41.2 µs");
  EXPECT_EQ(seconds_text(3e-9), "3 ns");
  EXPECT_EQ(figure(1e-6), "1e-6");
  EXPECT_EQ(figure(3.217e-9), "3.22e-9");
  EXPECT_EQ(figure(0.0123), "0.0123");
  EXPECT_EQ(figure(2060), "2060");
  EXPECT_EQ(figure(4.5e6), grouped(4500000)) << "as 13 806 beside it";
  EXPECT_EQ(figure(0), "0");
  EXPECT_EQ(figure(std::nan("")), "?");
}

}  // namespace
}  // namespace lantern::report
