// What is said of a problem's rows: who is the quickest, and what must be known beside the numbers.
#include "geometry/elementary.hpp"
#include "report/document.hpp"
#include "report/problem_rows.hpp"

namespace lantern::report {
namespace {

constexpr int kFinest = -13;   // of the decades that are told: a hundred times rounding
constexpr double kAlike = 10;  // of two errors, one over the other

// What a method takes to be off by at most so much.
struct Standing {
  std::string name;
  Timing time;
  double least = 0;  // seconds that it takes at least, whatever the step
};

// a to b, by the straight line between their logarithms.
double between(double a, double b, double share) { return a * geometry::pow(b / a, share); }

// Nothing if no run is so good. Between the largest step that is and the next larger one; where
// that has failed, or errors are counted, the run takes what it takes, and steps between may take
// less.
std::optional<Standing> standing(const MethodRows& method, double error) {
  const auto& errors = method.assured;
  const Row *good = nullptr, *coarsest = nullptr, *coarser = nullptr;
  double off = 0, coarser_off = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const Row& row = method.rows[i];
    if (!row.was_run()) continue;
    if (!errors[i] || *errors[i] > error) {
      coarser = &row, coarser_off = errors[i].value_or(0);
      continue;
    }
    if (!coarsest) coarsest = &row, off = *errors[i];
    if (seconds_of(row) && (!good || row.processor.median < good->processor.median)) good = &row;
  }
  if (!good) return std::nullopt;
  Standing all{method_words(method.method), good->processor, 0};
  if (good != coarsest) {  // larger steps cost more
    all.least = all.time.median;
    return all;
  }
  if (!coarser) return all;
  if (off > 0 && coarser_off > 0 && seconds_of(*coarser)) {
    const double share = geometry::log(error / off) / geometry::log(coarser_off / off);
    const Timing& other = coarser->processor;
    all.time.median = between(all.time.median, other.median, share);
    all.time.low = between(all.time.low, other.low, share);
    all.time.high = between(all.time.high, other.high, share);
    all.time.repeats = std::min(all.time.repeats, other.repeats);
    all.least = all.time.median;
  } else {
    all.least = all.time.median * good->step / coarser->step;
  }
  return all;
}

// Whether it is, too, if others are measured again and at other steps.
bool is_quicker(const Standing& a, const Standing& b) {
  return a.time.is_quicker_than(b.time) && a.time.median < b.least;
}

// Neighbouring decades at which the same lead.
struct Range {
  std::string who, over;  // nobody is lead over where some tie
  bool ahead = false;     // each of them of all others
  int from = 0, to = 0;   // decades
  double least_share = 1, most_share = 1;
  bool at_most = false;  // the share
  bool goes_on_in(const Range& next) const {
    return who == next.who && over == next.over && ahead == next.ahead && at_most == next.at_most &&
           to == next.to + 1;
  }
  void take(const Range& next) {
    to = next.to;
    least_share = std::min(least_share, next.least_share);
    most_share = std::max(most_share, next.most_share);
  }
};

double of_decade(int decade) { return std::stod(fmt::format("1e{}", decade)); }

// Nothing where fewer than two are so good, or one that might be quicker at larger steps.
std::optional<Range> range_of(std::span<const MethodRows> methods, double error, int decade) {
  std::vector<Standing> lead;
  for (const MethodRows& method : methods)
    if (auto one = standing(method, error)) lead.push_back(std::move(*one));
  if (lead.size() < 2) return std::nullopt;
  std::ranges::sort(lead, {}, [](const Standing& one) { return one.time.median; });
  const auto any_open = [](std::span<const Standing> some) {
    return std::ranges::any_of(some, [](const Standing& one) { return one.least == 0; });
  };
  const Standing first = lead[0], second = lead[1];
  const auto beaten = std::ranges::stable_partition(
      lead, [&](const Standing& one) { return !is_quicker(first, one); });
  const std::vector<Standing> others(beaten.begin(), beaten.end());
  lead.erase(beaten.begin(), beaten.end());
  if (any_open(others) || (lead.size() > 1 && any_open(lead))) return std::nullopt;
  std::vector<std::string> names = mapped(lead, &Standing::name);
  std::ranges::sort(names);
  const bool ahead = !others.empty() && std::ranges::all_of(lead, [&](const Standing& one) {
    return std::ranges::all_of(others, [&](const Standing& o) { return is_quicker(one, o); });
  });
  Range range{listed(names), "", ahead, decade, decade};
  if (names.size() > 3)
    range.who = fmt::format("{} methods, {} among them,", names.size(), names[0]);
  if (names.size() == 1) {
    std::vector<std::string> next{second.name};
    for (const Standing& one : others)
      if (one.name != second.name && !is_quicker(second, one)) next.push_back(one.name);
    std::ranges::sort(next);
    range.over = next.size() > 3 ? fmt::format("the next, of {} that tie,", next.size())
                                 : fmt::format("{}", fmt::join(next, " or "));
    range.least_share = range.most_share = first.time.median / second.least;
    range.at_most = first.least < first.time.median || second.least < second.time.median;
  }
  return range;
}

std::string clause_of(const Range& r, bool whole) {
  const auto error = [](int decade) { return figure(of_decade(decade)); };
  const std::string at = whole            ? "for a right outcome"
                         : r.from == r.to ? "at an error of " + error(r.from)
                                          : "at errors of " + error(r.from) + " to " + error(r.to);
  if (r.over.empty())
    return fmt::format("{} {} tie{}", at, r.who, r.ahead ? ", ahead of the others" : "");
  const double unit = geometry::pow(10, std::floor(geometry::log10(r.most_share)) - 1);
  const double most = r.at_most ? unit * std::ceil(r.most_share / unit) : r.most_share;  // a bound
  std::string share = fmt::format("{:.2g}", most);
  if (const std::string least = fmt::format("{:.2g}", r.least_share); !r.at_most && least != share)
    share = least + " to " + share;
  return fmt::format("{} {} costs {}{} of what {} costs", at, r.who, r.at_most ? "at most " : "",
                     share, r.over);
}

// Where errors hang on steps too little: who is off least, at the largest as at all smaller ones.
std::string who_bears_the_largest_step(std::span<const MethodRows> methods) {
  struct Bearing {
    double seconds = 0, error = 0;
    std::string name;
  };
  double step = 0;
  for (const MethodRows& method : methods)
    for (const Row& row : method.rows)
      if (row.was_run()) step = std::max(step, row.step);
  std::vector<Bearing> all;
  for (const MethodRows& method : methods) {
    const auto row = std::ranges::find(method.rows, step, &Row::step);
    if (row == method.rows.end()) continue;
    const auto error = method.assured[static_cast<std::size_t>(row - method.rows.begin())];
    const auto seconds = seconds_of(*row);
    if (error && seconds) all.push_back({*seconds, *error, method_words(method.method)});
  }
  if (all.size() < 2)
    return "Who is the quickest cannot be told here: no two methods were timed at one error, or at "
           "the largest step.";
  std::ranges::sort(all, {}, &Bearing::error);
  const auto next = std::ranges::find_if(all, [&](const Bearing& one) {
    return one.error > kAlike * std::max(all[0].error, kRounding);
  });
  const double least = std::prev(next)->error;
  std::sort(all.begin(), next, [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
  std::vector<std::string> names;
  for (auto one = all.begin(); one != next; ++one)
    names.push_back(fmt::format("{} in {}{}", one->name, seconds_text(one->seconds),
                                names.empty() ? " at the largest step" : ""));
  if (names.size() > 4) {
    names[3] = fmt::format("{} others", names.size() - 3);
    names.resize(4);
  }
  std::string text = fmt::format("At steps of up to {} s that were run, {} {} {}", figure(step),
                                 listed(names), names.size() == 1 ? "is" : "are",
                                 least > 0 ? "off by at most " + figure(least) : "exact");
  if (next != all.end())
    text += fmt::format(", the next, {}, by up to {}", next->name, figure(next->error));
  return text + ".";
}

}  // namespace

std::string who_is_quickest(const ProblemRows& problem) {
  const bool whole = has_whole_errors(problem);
  std::vector<MethodRows> methods = by_method(problem);
  std::erase_if(methods, [](const MethodRows& method) { return is_adaptive(method.method); });
  std::vector<Range> ranges;
  for (int decade = whole ? kFinest : -1; decade >= kFinest; --decade) {
    auto range = range_of(methods, whole ? 0 : of_decade(decade), decade);
    if (!range) continue;
    if (ranges.empty() || !ranges.back().goes_on_in(*range))
      ranges.push_back(std::move(*range));
    else
      ranges.back().take(*range);
  }
  if (ranges.empty()) return who_bears_the_largest_step(methods);
  while (ranges.size() > 3)  // one line: the widest
    ranges.erase(
        std::ranges::min_element(ranges, {}, [](const Range& r) { return r.from - r.to; }));
  const auto clauses = mapped(ranges, [&](const Range& range) { return clause_of(range, whole); });
  return fmt::format("At given steps, {}: {}.",
                     whole ? "by the cheapest run" : "read between neighbouring runs",
                     fmt::join(clauses, "; "));
}

std::vector<std::string> notes_on(const ProblemRows& problem) {
  std::vector<std::string> notes;
  double reference_error = 0;
  const Norm* norm = nullptr;
  const Row* reference = nullptr;
  std::size_t left_out = 0;
  bool adaptive = false;
  for (const Row& row : problem.rows) {
    reference_error = std::max(reference_error, row.reference_error);
    if (!norm && !row.norms.empty()) norm = &row.norms.front();
    if (!reference && !row.reference.empty()) reference = &row;
    adaptive = adaptive || is_adaptive(row.method);
    left_out += row.status == Status::left_out;
  }
  if (norm && !norm->meaning.empty())
    notes.push_back(fmt::format("“{}”{}: {}.", norm->name,
                                norm->unit == "1" ? "" : " (" + norm->unit + ")", norm->meaning));
  if (reference && reference->reference.find(';') != std::string::npos)
    notes.push_back("Reference: " + reference->reference + ".");
  if (reference_error > kRounding)
    notes.push_back(
        fmt::format("The reference is itself off by about {}, its distance from the same run at "
                    "twice its step; no smaller error is claimed.",
                    figure(reference_error)));
  std::vector<std::string> floors, evaluations;
  std::map<double, std::string> prices;  // of an evaluation
  const bool by_forces = work_count(problem).count == &Counted::force_evaluations;
  bool varied = false;
  for (const MethodRows& method : by_method(problem)) {
    if (method.floor)
      floors.push_back(fmt::format("from {} s on: {} ({})",
                                   figure(method.rows[method.floor->first].step),
                                   figure(method.floor->largest), method.name()));
    std::vector<double> in_a_step;
    for (const Row& row : method.rows)
      if (row.status == Status::ok && row.counted.force_evaluations > 0)
        in_a_step.push_back(static_cast<double>(row.counted.force_evaluations) /
                            static_cast<double>(row.counted.steps));
    if (in_a_step.empty()) continue;
    const auto [least, most] = std::ranges::minmax(in_a_step);
    const std::string few = fmt::format("{:.3g}", least), many = fmt::format("{:.3g}", most);
    varied = varied || few != many;
    evaluations.push_back(
        fmt::format("{} ({})", few == many ? few : few + " to " + many, method.name()));
    const Row& longest = *std::ranges::max_element(
        method.rows, {}, [](const Row& row) { return row.counted.force_evaluations; });
    if (const auto seconds = seconds_of(longest); seconds && !is_adaptive(method.method))
      prices[*seconds / static_cast<double>(longest.counted.force_evaluations)] = method.name();
  }
  if (!floors.empty())
    notes.push_back(fmt::format(
        "Dashed: rounding, 2⁻⁵² √steps as a random walk; and the largest error of the runs {}.",
        fmt::join(floors, ", ")));
  if ((by_forces && !evaluations.empty()) || varied)
    notes.push_back(
        fmt::format("In runs that are ok forces are evaluated so often in a step, more where it is "
                    "taken in parts or solved again: {}.",
                    fmt::join(evaluations, ", ")));
  if (by_forces && prices.size() > 1)
    notes.push_back(
        fmt::format("An evaluation at given steps, with its share of the step, takes {} ({}) to {} "
                    "({}) in the longest runs.",
                    seconds_text(prices.begin()->first), prices.begin()->second,
                    seconds_text(prices.rbegin()->first), prices.rbegin()->second));
  if (adaptive)
    notes.push_back(
        "Dormand–Prince, adaptive, solves the bare equations: its seconds pay for no world's step. "
        "Its “step” stands for a tolerance: 1e-3 of the scene's size and speed at its largest "
        "step, less by the fifth power, 1e-14 at least.");
  for (const std::vector<std::string>& group : equal_methods(problem)) {
    std::vector<std::string> names;
    std::ranges::transform(group, std::back_inserter(names), method_words);
    notes.push_back(
        fmt::format("{} are run as one method here, of which the order is, whatever its "
                    "name: they are off by the same in every run.",
                    listed(names)));
  }
  if (left_out > 0)
    notes.push_back(fmt::format("{} of {} runs {} left out as too long.", left_out,
                                problem.rows.size(), left_out == 1 ? "was" : "were"));
  return notes;
}

}  // namespace lantern::report
