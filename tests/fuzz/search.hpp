// The search: files are made, tried in a process of their own, and what is found is told. A crash
// or a hang ends that process, not the search.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "fuzz/sees_all.hpp"

namespace lantern::fuzz {

struct SearchOptions {
  double minutes = 0;        // 0: `rounds` decide alone
  std::uint64_t rounds = 0;  // files; 0: `minutes` decide alone
  std::uint64_t seed = 1;
  std::uint64_t first = 0;         // the number of the first file
  std::filesystem::path corpus;    // files to begin from; each is tried, too
  std::filesystem::path keep;      // where interesting files go; empty: nowhere
  std::filesystem::path findings;  // where files go that break something; empty: nowhere
  bool verbose = false;
};

struct SearchReport {
  std::uint64_t files = 0, good = 0, ran = 0, drawn = 0, measured = 0, stopped = 0;
  std::uint64_t crashes = 0, hangs = 0, broken = 0;  // signals and aborts; deaf stages; Finding
  std::uint64_t energy = 0;                          // scenes whose energy grew
  double seconds = 0;
  double slowest_stop = 0;                    // seconds from a wish to its stage's end
  std::map<std::string, std::uint64_t> used;  // good files by "table.key" and by verb
  std::vector<std::string> told;              // one line a kind of finding

  std::uint64_t findings() const { return crashes + hangs + broken; }
};

// Tells findings on standard error at once.
SearchReport search(const SearchOptions& options);

// What ran, how often each key was used validly, and which never.
std::string to_text(const SearchReport& report);

}  // namespace lantern::fuzz
