// Ours and other libraries at the same boxes in the same run, in turns: all pairs of moving worlds,
// and what rays, boxes and balls meet.
#pragma once

#include "measure/boxes/worlds.hpp"
#include "measure/row.hpp"

namespace lantern::measure {

// What a contestant can be set to. Two numbers whose neighbours are like it: of our trees the
// capacity 2^first and the depth limit `second`, of others the place in a list.
struct BoxSetting {
  int first = 0, second = 0;
  auto operator<=>(const BoxSetting&) const = default;
};

// What was counted in the last step; nothing where nobody counts.
struct BoxCounts {
  std::optional<double> pair_tests, box_tests, nodes_visited, nodes, entries;
};

// A contestant with one setting on one stage.
class BoxRun {
 public:
  virtual ~BoxRun() = default;
  // Of pairs: the boxes of that frame become these, and all their pairs are found. Else all
  // questions are asked once. Throws Refused as the structure does.
  virtual void step(std::size_t frame) = 0;
  // Of the last step, in order: pairs, or (number of the question, body).
  virtual const std::vector<Pair>& found() const = 0;
  virtual std::optional<std::uint64_t> allocations() const { return std::nullopt; }  // so far
  virtual BoxCounts counts() const { return {}; }
};

struct BoxContestant {
  std::string name;
  std::string version = {};  // of another library; empty for ours
  std::string how = {};      // it is run, of another library
  std::function<bool(const BoxStage&)> can = {};
  std::function<BoxSetting(const BoxStage&)> likely = {};  // from which the quickest is looked for
  std::function<bool(const BoxSetting&)> has = {};
  std::function<std::string(const BoxSetting&)> words = {};  // may be empty
  // The stage and the contestant outlive the run.
  std::function<std::unique_ptr<BoxRun>(const BoxStage&, const BoxSetting&)> start = {};
};

// Ours: each kind, `auto` first where there is one, and then it without what it keeps of the last
// step.
std::vector<BoxContestant> own_box_contestants();

// How many axes a level of the tree of that name halves.
int halved_axes(const std::string& tree, int dimension);

// The libraries whose modules are there; a line in `missing` for each other.
std::vector<BoxContestant> peer_box_contestants(std::vector<std::string>& missing);

// Brings pairs into the order of their ids; `bodies` is more than any of these. What others find is
// ordered by this within their time.
void into_order(std::vector<Pair>& pairs, std::uint32_t bodies);

// --- what is to be found on a stage: by comparing all with all where that is possible, else by a
// sample and by each other ---

// Up to so many bodies all pairs are compared; beyond, those of a sample.
inline constexpr std::size_t kMostForced = 20000, kSample = 2000;

class BoxTruth {
 public:
  // Of the stage as it is at the frame.
  BoxTruth(const BoxStage& stage, std::size_t frame);

  struct Verdict {
    std::uint64_t missed = 0, invented = 0;
  };
  // `found` in order and without repeats.
  Verdict judge(std::span<const Pair> found) const;

  // Whether only the pairs of a sample are known.
  bool is_sample() const { return is_sample_; }
  std::string words() const;  // "brute force"

 private:
  template <int D>
  void force(const BoxStage& stage, std::size_t frame);
  template <int D>
  void force_sample(Boxes<D> boxes);
  template <int D>
  void answer(const BoxStage& stage);

  bool is_sample_ = false;
  std::size_t stride_ = 1;  // each such body is in the sample
  std::vector<Pair> truth_;
};

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
  std::uint64_t frames = 1;                // in which boxes move: that step is the first
  std::optional<double> found_in_all;      // these frames; nothing if steps are long

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
