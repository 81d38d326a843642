// What of a run belongs to a shard: the one place that cuts a run into parts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lantern::app {

// `--shard 2/4`: the second of four equal parts of a run.
struct Shard {
  static constexpr std::uint32_t kMost = 10'000;

  std::uint32_t number = 1;  // from 1
  std::uint32_t of = 1;

  std::string text() const;                                       // "2/4"
  std::filesystem::path folder_in(const std::string& out) const;  // OUT/shard-2-of-4
  // Things that come one by one are dealt as cards are: every n-th is this shard's.
  bool has(std::uint64_t position) const { return position % of + 1 == number; }
  bool operator==(const Shard&) const = default;
};

// What stands after --shard; nothing if nothing does. Throws UsageError unless it is "I/N" with
// 1 <= I <= N <= kMost.
std::optional<Shard> parse_shard(const std::string& words);

// Of the frames chosen of one scenario: those that a shard draws.
class Part {
 public:
  Part() = default;  // all
  static Part none() { return {0, 0}; }
  static Part every(std::uint64_t nth, std::uint64_t first) { return {nth, first}; }

  bool is_all() const { return nth_ == 1; }
  bool is_none() const { return nth_ == 0; }
  bool has(std::uint64_t position) const { return nth_ > 0 && position % nth_ == first_; }
  // Of so many.
  std::uint64_t count(std::uint64_t frames) const;

 private:
  Part(std::uint64_t nth, std::uint64_t first) : nth_(nth), first_(first) {}

  std::uint64_t nth_ = 1, first_ = 0;
};

// A part of each of these scenarios, of which is known at most how many frames each gives, if that
// is known. A scenario must be stepped by every shard that draws any of it; so the short ones stay
// whole, the longest first, each with the shard that has least to draw. One that is longer than a
// quarter of a shard's share, or of unknown length, is dealt out frame by frame. The parts of all
// shards have every frame once, whatever the true lengths are.
std::vector<Part> parts_of(const Shard& shard,
                           const std::vector<std::optional<std::uint64_t>>& frames);

// The command line of this process, for advice on what to run again. To be called once.
void remember_command_line(int argc, const char* const* argv);
const std::vector<std::string>& command_line_words();  // without the program's name

// Those words as a shell takes them, "lantern render x.toml --shard 2/4", for another shard.
std::string command_for(const std::vector<std::string>& words, const Shard& shard);

}  // namespace lantern::app
