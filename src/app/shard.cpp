#include "app/shard.hpp"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <string_view>

#include <fmt/format.h>

#include "app/terminal.hpp"

namespace lantern::app {
namespace {

constexpr std::string_view kOption = "--shard";

std::optional<std::uint32_t> shard_number(std::string_view digits) {
  std::uint32_t number = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, number);
  return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

std::string for_a_shell(const std::string& word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == word.npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::vector<std::string>& remembered_words() {
  static std::vector<std::string> words;
  return words;
}

}  // namespace

std::string Shard::text() const { return fmt::format("{}/{}", number, of); }

std::filesystem::path Shard::folder_in(const std::string& out) const {
  return std::filesystem::path(out) / fmt::format("shard-{}-of-{}", number, of);
}

std::optional<Shard> parse_shard(const std::string& words) {
  if (words.empty()) return std::nullopt;
  const std::string_view all = words;
  const std::size_t bar = all.find('/');
  const auto number = shard_number(all.substr(0, bar));
  const auto of = bar == all.npos ? std::nullopt : shard_number(all.substr(bar + 1));
  if (!number || !of || *number < 1 || *number > *of || *of > Shard::kMost)
    throw UsageError(fmt::format(
        "--shard {}: give I/N, the I-th of N parts, as 2/4: I from 1 to N, N at most {}", words,
        Shard::kMost));
  return Shard{*number, *of};
}

std::uint64_t Part::count(std::uint64_t frames) const {
  if (is_none() || frames <= first_) return 0;
  return (frames - first_ - 1) / nth_ + 1;
}

std::vector<Part> parts_of(const Shard& shard,
                           const std::vector<std::optional<std::uint64_t>>& frames) {
  constexpr std::uint64_t kPieces = 4;  // a whole scenario is at most this part of a share
  std::uint64_t total = 0;
  for (const auto& count : frames) total += count.value_or(0);
  std::vector<Part> parts(frames.size(), Part::none());
  std::vector<std::size_t> whole;
  std::uint64_t dealt = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i] && *frames[i] <= total / (kPieces * shard.of)) {
      whole.push_back(i);
      continue;
    }
    // The dealing goes on where it stopped, so that remainders do not all fall to the first.
    const std::uint64_t first = (shard.number - 1 + shard.of - dealt % shard.of) % shard.of;
    const Part part = Part::every(shard.of, first);
    if (!frames[i] || part.count(*frames[i]) > 0) parts[i] = part;
    dealt += frames[i].value_or(0);
  }
  std::vector<std::uint64_t> load(shard.of, dealt / shard.of);
  for (std::uint64_t i = 0; i < dealt % shard.of; ++i) ++load[i];
  std::ranges::stable_sort(whole, std::greater(), [&](std::size_t i) { return *frames[i]; });
  for (const std::size_t i : whole) {
    const auto least = std::ranges::min_element(load);
    *least += *frames[i];
    if (static_cast<std::uint64_t>(least - load.begin()) + 1 == shard.number) parts[i] = Part();
  }
  return parts;
}

void remember_command_line(int argc, const char* const* argv) {
  if (argc > 1) remembered_words().assign(argv + 1, argv + argc);
}

const std::vector<std::string>& command_line_words() { return remembered_words(); }

std::string command_for(const std::vector<std::string>& words, const Shard& shard) {
  std::string text = "lantern";
  for (std::size_t i = 0; i < words.size(); ++i) {
    std::string word = words[i];
    if (i > 0 && words[i - 1] == kOption) word = shard.text();
    if (word.starts_with(std::string(kOption) + "="))
      word = fmt::format("{}={}", kOption, shard.text());
    text += " " + for_a_shell(word);
  }
  return text;
}

}  // namespace lantern::app
