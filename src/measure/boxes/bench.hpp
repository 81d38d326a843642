// Ours and other libraries at the same boxes in the same run, in turns: all pairs of moving worlds,
// and what rays, boxes and balls meet.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measure/bench.hpp"
#include "measure/boxes/contest.hpp"

namespace lantern::measure {

struct BoxBenchConfig {
  std::vector<const BoxWorkload*> workloads;
  std::vector<std::uint64_t> bodies;  // empty: each workload's own numbers
  bool full = false;                  // or its full ones
  std::optional<BoxScene> own;        // a user's own boxes, measured instead of workloads
  std::vector<std::string> only;      // contestants; empty for all
  bool peers = true;
  int rounds = 9;
  std::uint64_t seed = 1;
  double longest = 1;    // seconds of a step: who would need more is left out
  double seconds = 0.1;  // that a contestant is timed at a stage; at least three rounds
  double search = 0.05;  // seconds that a contestant's best setting is looked for, at least one
};

// One contestant on one stage.
struct BoxBenchRow {
  std::string workload;
  int dimension = 2;
  std::uint64_t bodies = 0;
  std::string contestant;
  std::string version;        // of another library; empty for ours
  std::string setting;        // in words
  std::string status = "ok";  // wrong, left out, refused, missing
  std::string reason;         // of any other status
  Timing timing;              // seconds of the processor for a step, all threads together; of
                              // what is asked, for a question
  double wall = 0;            // by the clock, the median: more than that if the machine is busy,
                              // less if several threads share the work
  std::uint64_t found = 0;    // pairs, or bodies in all answers, of the step that was checked
  std::uint64_t missed = 0, invented = 0;  // of those that were compared
  std::string checked;                     // by what: "brute force"
  std::optional<double> allocations;       // calls for memory in a warm step; the median
  std::optional<double> bytes;             // that it holds for each body, its pairs too
  BoxCounts counts;                        // of the step that was checked

  bool is_peer() const { return !version.empty(); }
  bool is_good() const { return status != "wrong"; }
};

using BoxBenchResult = BenchResult<BoxBenchConfig, BoxBenchRow>;

// How many stages there are.
std::size_t box_stages(const BoxBenchConfig& config);

// Told before each contestant's search and before each stage's rounds.
using BoxBenchWatch = std::function<void(std::size_t stage, const std::string& words)>;

// A stage's rows are added when all of it is done. Before any work: throws Refused for names that
// are none, and for worlds that have more pairs than `most_pairs` or need more memory than the
// budget. Throws Stopped.
void bench_boxes(BoxBenchResult& result, const BoxBenchWatch& watch);

// The quickest peer with right pairs at the stage of a row; null if there is none.
const BoxBenchRow* fastest_peer(const std::vector<BoxBenchRow>& rows, const BoxBenchRow& at);

}  // namespace lantern::measure
