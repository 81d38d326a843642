#include "base/memory.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"

namespace lantern {
namespace {

constexpr std::array<char, 4> kUnits = {'K', 'M', 'G', 'T'};

}  // namespace

std::optional<std::uint64_t> memory_size(std::string_view words) {
  double number = 0;
  const char* const last = words.data() + words.size();
  const auto [end, error] = std::from_chars(words.data(), last, number);
  if (error != std::errc() || last - end != 1 || !std::isfinite(number)) return std::nullopt;
  const auto unit = std::ranges::find(kUnits, *end);
  if (unit == kUnits.end()) return std::nullopt;
  const double bytes = std::ldexp(number, 10 * static_cast<int>(unit - kUnits.begin() + 1));
  if (!(bytes >= static_cast<double>(kLeastBudget)) || bytes >= 0x1p60) return std::nullopt;
  return static_cast<std::uint64_t>(bytes);
}

std::string memory_text(std::uint64_t bytes) {
  double size = std::max(1.0, static_cast<double>(bytes) / 1024);
  std::size_t unit = 0;
  for (; size >= 1000 && unit + 1 < kUnits.size(); ++unit) size /= 1024;
  const bool round = size >= 10 || size == std::floor(size);
  return fmt::format("{:.{}f} {}B", size, round ? 0 : 1, kUnits[unit]);
}

void require_memory(std::uint64_t bytes, std::string_view what, std::string_view advice) {
  if (bytes > memory_budget()) refuse_memory(bytes, what, advice);
}

void refuse_memory(std::uint64_t bytes, std::string_view what, std::string_view advice) {
  // Some room for all else, in whole numbers of the largest unit.
  const double wanted = 1.2 * static_cast<double>(bytes);
  const bool gigabytes = wanted > 0x1p30;
  throw Refused("{} need about {}, the budget is {}; {}, or --memory {:.0f}{}", what,
                memory_text(bytes), memory_text(memory_budget()), advice,
                std::ceil(std::ldexp(wanted, gigabytes ? -30 : -20)), gigabytes ? 'G' : 'M');
}

}  // namespace lantern
