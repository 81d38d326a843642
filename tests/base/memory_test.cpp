// The budget of memory: sizes in words, and refusals that say what to change.
#include "base/memory.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"

namespace lantern {
namespace {

constexpr std::uint64_t kMega = std::uint64_t{1} << 20, kGiga = std::uint64_t{1} << 30;

TEST(Memory, SizesInWords) {
  EXPECT_EQ(memory_size("800M"), 800 * kMega);
  EXPECT_EQ(memory_size("4G"), 4 * kGiga);
  EXPECT_EQ(memory_size("1.5G"), kGiga + kGiga / 2);
  EXPECT_EQ(memory_size("65536K"), 64 * kMega);
  EXPECT_EQ(memory_size("1T"), 1024 * kGiga);
  for (const char* words : {"", "G", "4", "4g", "4GB", "-4G", "0G", "1M", "1e30T", "nanG", "infG",
                            " 4G", "4 G", "0x4G"})
    EXPECT_FALSE(memory_size(words).has_value()) << words;
}

TEST(Memory, TextsOfSizes) {
  EXPECT_EQ(memory_text(kGiga), "1 GB");
  EXPECT_EQ(memory_text(kGiga + kGiga / 3), "1.3 GB");
  EXPECT_EQ(memory_text(12 * kGiga + kMega), "12 GB");
  EXPECT_EQ(memory_text(800 * kMega), "800 MB");
  EXPECT_EQ(memory_text(2048), "2 KB");
  EXPECT_EQ(memory_text(10), "1 KB");
  EXPECT_EQ(memory_text(std::uint64_t{1} << 60), "1048576 TB");
}

TEST(Memory, WhatNeedsMoreThanTheBudgetIsRefusedWithWhatToChange) {
  const std::uint64_t before = memory_budget();
  set_memory_budget(kGiga);
  EXPECT_NO_THROW(require_memory(kGiga, "things", "take fewer"));
  try {
    require_memory(3 * kGiga + kGiga / 3, "7 things", "take fewer");
    FAIL() << "three times the budget was allowed";
  } catch (const Refused& refused) {
    EXPECT_STREQ(refused.what(),
                 "7 things need about 3.3 GB, the budget is 1 GB; take fewer, or --memory 4G");
  }
  set_memory_budget(before);
}

TEST(Memory, TheDefaultIsHalfOfWhatThereIs) {
  EXPECT_GE(machine_memory(), kLeastBudget);
  EXPECT_EQ(memory_budget(), machine_memory() / 2);
}

}  // namespace
}  // namespace lantern
