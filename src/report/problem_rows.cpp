#include "report/problem_rows.hpp"

#include "geometry/elementary.hpp"
#include "report/document.hpp"

namespace lantern::report {
namespace {

// It chooses its steps itself, and moves the bodies without the world's step.
bool is_adaptive(std::string_view method) { return method == kAdaptive; }

struct KnownMethod {
  std::string_view name, words;
  int look;
};

// The first ones are those that meet most often in one plot.
constexpr std::array<KnownMethod, 19> kKnown{{
    {"velocity_verlet", "velocity Verlet", 0},
    {"explicit_euler", "explicit Euler", 1},
    {"runge_kutta_4", "Runge–Kutta 4", 2},
    {"implicit_midpoint", "implicit midpoint", 3},
    {"semi_implicit_euler", "semi-implicit Euler", 4},
    {"implicit_euler", "implicit Euler", 5},
    {kAdaptive, "Dormand–Prince, adaptive", 6},
    {"kahan_li_8", "Kahan–Li 8", 8},
    {"dormand_prince", "Dormand–Prince", 9},
    {"splitting_2", "splitting, order 2", 14},
    {"splitting_4", "splitting, order 4", 16},
    {"explicit_gyroscopic", "explicit gyroscopic", 15},
    {"exact", "exact turning", 7},
    {"impulse", "impulses", 17},
    {"impulse:100", "impulses (100 sweeps)", 28},
    {"soft", "soft contacts", 18},
    {"soft:16", "soft contacts (16 sub-steps)", 48},
    {"direct", "direct solve", 19},
    {"lecture", "the lecture's solver", 20},
}};

const KnownMethod* known(std::string_view name) {
  for (const KnownMethod& k : kKnown)
    if (k.name == name) return &k;
  return nullptr;
}

// The one of them with the same name; `fresh`, which comes last, if there is none.
template <class Rows>
Rows& with_name(std::vector<Rows>& all, std::string Rows::*name, Rows fresh) {
  const auto found = std::ranges::find(all, fresh.*name, name);
  return found == all.end() ? all.emplace_back(std::move(fresh)) : *found;
}

struct Sample {
  double step = 0, error = 0;
};

double slope(const Sample& a, const Sample& b) {
  return geometry::log(a.error / b.error) / geometry::log(a.step / b.step);
}

double fitted(std::span<const Sample> samples) {
  const auto n = static_cast<double>(samples.size());
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const Sample& s : samples) {
    x += geometry::log(s.step) / n;
    y += geometry::log(s.error) / n;
  }
  for (const Sample& s : samples) {
    const double dx = geometry::log(s.step) - x;
    xx += dx * dx;
    xy += dx * (geometry::log(s.error) - y);
  }
  return xy / xx;
}

constexpr double kBegun = 0.5;  // an error larger than this says nothing of how errors shrink

// The same run by two methods: did it end alike, with the same error?
bool agree(const Row& a, const Row& b) {
  constexpr double kAlike = 1e-9;
  if (a.status != b.status) return false;
  const auto p = a.error(), q = b.error();
  if (!p || !q) return !p && !q;
  return *p == *q || std::abs(*p - *q) <= kAlike * std::max(*p, *q);
}

bool are_equal(const MethodRows& a, const MethodRows& b) {
  std::size_t shared = 0;
  for (const Row& row : a.rows) {
    const auto same = std::ranges::find(b.rows, row.step, &Row::step);
    if (same == b.rows.end() || !row.was_run() || !same->was_run()) continue;
    if (!agree(row, *same)) return false;
    shared += row.error().has_value();
  }
  return shared >= 2;
}

}  // namespace

std::vector<ProblemRows> by_problem(std::span<const Row> rows) {
  std::vector<ProblemRows> problems;
  for (const Row& row : rows)
    with_name(problems, &ProblemRows::problem, {row.problem, row.family, row.variant, {}})
        .rows.push_back(row);
  return problems;
}

std::vector<MethodRows> by_method(const ProblemRows& problem) {
  std::vector<MethodRows> all;
  for (const Row& row : problem.rows)
    with_name(all, &MethodRows::method, {row.method, row.is_peer(), row.version, {}})
        .rows.push_back(row);
  for (MethodRows& c : all) std::ranges::stable_sort(c.rows, std::greater(), &Row::step);
  return all;
}

std::string MethodRows::name() const {
  return is_peer ? method + " " + version : method_words(method);
}

std::string method_words(std::string_view method) {
  if (const KnownMethod* k = known(method)) return std::string(k->words);
  const bool soft = method.starts_with("soft:");
  if (soft || method.starts_with("impulse:")) {
    const std::string_view effort = method.substr(method.find(':') + 1);
    if (soft && effort.starts_with("0.")) return fmt::format("soft contacts (error {})", effort);
    return fmt::format("{} ({} {}{})", soft ? "soft contacts" : "impulses", effort,
                       soft ? "sub-step" : "sweep", effort == "1" ? "" : "s");
  }
  std::string words(method);
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::string norm_words(std::string_view norm) {
  constexpr std::array<std::array<std::string_view, 2>, 11> kWords{{
      {"traj", "state"},
      {"att", "attitude"},
      {"inv", "drift"},
      {"a", "acceleration"},
      {"v", "speed"},
      {"E", "energy"},
      {"p", "momentum"},
      {"L", "angular momentum"},
      {"times", "impact times"},
      {"class", "wrong outcomes"},
      {"hits", "miscounted hits"},
  }};
  for (const auto& [name, words] : kWords)
    if (name == norm) return std::string(words);
  return std::string(norm);
}

std::string main_norm(const ProblemRows& problem) {
  for (const Row& row : problem.rows)
    if (!row.norms.empty()) return row.norms.front().name;
  return "";
}

bool has_whole_errors(const ProblemRows& problem) {
  bool any = false;
  for (const Row& row : problem.rows) {
    const auto error = row.error();
    if (!error || !std::isfinite(*error)) continue;
    const std::string& unit = row.norms.front().unit;
    if (*error != std::floor(*error) || unit == "units" || unit == "rad") return false;
    any = true;
  }
  return any;
}

Looks looks_of(std::span<const Row> rows) {
  Looks looks;
  std::set<int> taken;
  for (const KnownMethod& k : kKnown) taken.insert(k.look);
  for (const Row& row : rows) {
    if (looks.contains(row.method)) continue;
    int look = row.is_peer() ? kFirstPeerLook : 0;
    if (const KnownMethod* k = row.is_peer() ? nullptr : known(row.method)) {
      look = k->look;
    } else {
      const auto of_other_kind = [&](int l) {  // crosses and stars are for peers
        return !row.is_peer() && l % kPlotMarks >= kFirstPeerLook;
      };
      while (taken.contains(look) || of_other_kind(look)) ++look;
    }
    taken.insert(look);
    looks[row.method] = look;
  }
  return looks;
}

std::optional<Order> observed_order(std::span<const Row> rows) {
  constexpr double kOverFloor = 100;  // times the estimate
  constexpr double kEven = 0.35;      // how far a local slope may be from the middle one
  std::vector<Sample> samples;
  for (const Row& row : rows) {
    const auto error = row.error();
    if (is_adaptive(row.method) || !error || !std::isfinite(*error)) continue;
    const double floor = kOverFloor * rounding_floor(static_cast<double>(row.counted.steps));
    if (!(row.step > 0) || *error > kBegun || *error <= floor) continue;
    if (samples.empty() || row.step < samples.back().step) samples.push_back({row.step, *error});
  }
  if (samples.size() < 3) return std::nullopt;
  std::vector<double> slopes;
  for (std::size_t i = 1; i < samples.size(); ++i)
    slopes.push_back(slope(samples[i - 1], samples[i]));
  std::vector<double> sorted = slopes;
  std::ranges::sort(sorted);
  const double middle = sorted[sorted.size() / 2];
  // The longest even piece.
  std::size_t from = 0, length = 0;
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    std::size_t n = 0;
    while (i + n < slopes.size() && std::abs(slopes[i + n] - middle) <= kEven) ++n;
    if (n <= length) continue;
    from = i;
    length = n;
  }
  if (length < 2) return std::nullopt;
  const double order = fitted(std::span(samples).subspan(from, length + 1));
  if (!(order > 0)) return std::nullopt;
  Order seen{order};
  const std::span even = std::span(slopes).subspan(from, length);
  for (const double one : even) seen.spread = std::max(seen.spread, std::abs(one - order));
  constexpr double kSteady = 0.05;  // slopes that are as good as the same
  if (seen.spread > kSteady &&
      (std::ranges::is_sorted(even) || std::ranges::is_sorted(even, std::greater())))
    seen.trend = {even.front(), even.back()};
  return seen;
}

std::span<const Row> observed_floor(std::span<const Row> rows) {
  while (!rows.empty() && !rows.back().error()) rows = rows.first(rows.size() - 1);
  if (rows.empty() || is_adaptive(rows[0].method)) return {};
  const auto order = observed_order(rows);
  const double half = order ? order->exponent / 2 : 0.5;
  const auto stays = [&](const Row& from, const Row& row) {
    const double ratio = geometry::pow(row.step / from.step, half);
    return row.error() && *row.error() > *from.error() * ratio;
  };
  for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
    const auto tail = rows.subspan(i);
    if (rows[i].error() <= kBegun && rows[i - 1].error() > rows[i].error() && rows[i].error() &&
        std::ranges::all_of(tail.subspan(1), [&](const Row& row) { return stays(tail[0], row); }))
      return tail;
  }
  return {};
}

std::optional<double> largest_on_floor(std::span<const Row> rows) {
  std::optional<double> most;
  for (const Row& row : observed_floor(rows)) most = std::max(most, row.error());
  return most;
}

double rounding_floor(double steps) { return kRounding * std::sqrt(std::max(1.0, steps)); }

std::optional<double> WorkCount::of(const Row& row) const {
  const std::uint64_t n = row.counted.*count;
  if (n == 0) return std::nullopt;
  return static_cast<double>(n);
}

WorkCount work_count(const ProblemRows& problem) {
  const WorkCount counts[] = {{"constraint rows", &Counted::constraint_rows},
                              {"force evaluations", &Counted::force_evaluations},
                              {"steps", &Counted::steps}};
  for (const WorkCount& count : counts)
    for (const Row& row : problem.rows)
      if (row.counted.*count.count > 0) return count;
  return counts[2];
}

std::vector<std::vector<std::string>> equal_methods(const ProblemRows& problem) {
  std::vector<std::vector<std::string>> groups;
  if (has_whole_errors(problem)) return groups;  // outcomes, which are right or wrong
  std::vector<MethodRows> left = by_method(problem);
  while (!left.empty()) {
    const MethodRows first = left.front();
    std::vector<std::string> group{first.method};
    std::erase_if(left, [&](const MethodRows& other) {
      if (other.method == first.method) return true;
      const bool equal = !first.is_peer && !other.is_peer && are_equal(first, other);
      if (equal) group.push_back(other.method);
      return equal;
    });
    if (group.size() > 1) groups.push_back(std::move(group));
  }
  return groups;
}

// Of each method that does the world's step, its quickest run that is off by at most so much; the
// quickest first.
std::vector<const Row*> quickest(const ProblemRows& problem, double error) {
  std::map<std::string, const Row*> best;
  std::set<std::string> too_fine;  // what is better than so much is so by chance
  for (const MethodRows& method : by_method(problem))
    if (error < largest_on_floor(method.rows).value_or(0)) too_fine.insert(method.method);
  for (const Row& row : problem.rows) {
    if (is_adaptive(row.method) || !(row.error() <= error) || !row.error() || !seconds_of(row) ||
        too_fine.contains(row.method))
      continue;
    const Row*& known = best[row.method];
    if (!known || row.processor.median < known->processor.median) known = &row;
  }
  std::vector<const Row*> all;
  for (const auto& [method, row] : best) all.push_back(row);
  std::ranges::sort(all, {}, [](const Row* row) { return row->processor.median; });
  return all;
}

std::string who_is_quickest(const ProblemRows& problem) {
  const auto name = [](const Row* row) {
    const std::string words = row->is_peer() ? row->method : method_words(row->method);
    return words.substr(0, words.find(" (double)"));
  };
  // Neighbouring decades at which the same lead.
  struct Range {
    std::string who, over;  // nobody is lead over where some tie
    bool ahead = false;     // each of them of all others
    int from = 0, to = 0;   // decades
    double share = 1, last_share = 1;
  };
  const bool whole = has_whole_errors(problem);
  std::vector<Range> ranges;
  for (int decade = whole ? -15 : -1; decade >= -15; --decade) {
    const std::vector<const Row*> all =
        quickest(problem, whole ? 0 : std::stod(fmt::format("1e{}", decade)));
    if (all.size() < 2) continue;
    std::vector<const Row*> lead, others;
    for (const Row* row : all)
      (all[0]->processor.is_quicker_than(row->processor) ? others : lead).push_back(row);
    std::vector<std::string> first;
    std::ranges::transform(lead, std::back_inserter(first), name);
    std::ranges::sort(first);
    const bool ahead = !others.empty() && std::ranges::all_of(lead, [&](const Row* row) {
      return std::ranges::all_of(others, [&](const Row* other) {
        return row->processor.is_quicker_than(other->processor);
      });
    });
    Range range{listed(first), "", ahead, decade, decade};
    if (first.size() > 3)
      range.who = fmt::format("{} methods, {} among them,", first.size(), first[0]);
    if (first.size() == 1) {
      range.over = name(all[1]);
      range.share = range.last_share = all[0]->processor.median / all[1]->processor.median;
    }
    if (ranges.empty() || ranges.back().who != range.who || ranges.back().over != range.over ||
        ranges.back().to != decade + 1)
      ranges.push_back(range);
    ranges.back().to = decade, ranges.back().last_share = range.last_share;
  }
  if (ranges.empty())
    return "Who is the quickest cannot be told here: no two methods were timed at one error.";
  while (ranges.size() > 3)  // one line: the widest
    ranges.erase(
        std::ranges::min_element(ranges, {}, [](const Range& r) { return r.from - r.to; }));
  std::vector<std::string> clauses;
  for (const Range& r : ranges) {
    const auto error = [](int decade) { return figure(std::stod(fmt::format("1e{}", decade))); };
    std::string clause = whole ? "for a right outcome"
                         : r.from == r.to
                             ? "at an error of " + error(r.from)
                             : fmt::format("at errors of {} to {}", error(r.from), error(r.to));
    const std::string share = fmt::format("{:.2g}", r.share),
                      last = fmt::format("{:.2g}", r.last_share);
    clause += r.over.empty()
                  ? fmt::format(" {} tie{}", r.who, r.ahead ? ", ahead of the others" : "")
                  : fmt::format(" {} costs {} of what {} costs", r.who,
                                share == last ? share : share + " to " + last, r.over);
    clauses.push_back(std::move(clause));
  }
  std::set<double> taken;
  for (const Row& row : problem.rows)
    if (seconds_of(row) && !is_adaptive(row.method)) taken.insert(row.step);
  const std::string finest = figure(*taken.begin()), coarsest = figure(*taken.rbegin());
  const std::string steps = finest == coarsest ? "a step of " + finest
                                               : fmt::format("steps of {} to {}", finest, coarsest);
  // Whose largest step is good enough already might take larger ones.
  const auto rows = by_method(problem);
  const double coarsest_error = whole ? 0 : std::stod(fmt::format("1e{}", ranges.front().from));
  const bool open = std::ranges::any_of(rows, [&](const MethodRows& method) {
    const auto error = method.rows[0].error();
    return !is_adaptive(method.method) && error && *error <= coarsest_error;
  });
  return fmt::format("By the cheapest run that is so good, of those at {} s{}: {}.", steps,
                     open ? " (larger ones, which may be cheaper, were not tried)" : "",
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
  std::vector<std::string> floors;
  std::map<double, std::string> prices;  // of an evaluation
  for (const MethodRows& method : by_method(problem)) {
    if (const auto floor = largest_on_floor(method.rows))
      floors.push_back(fmt::format("{} {}", method.name(), figure(*floor)));
    const Row& most = *std::ranges::max_element(
        method.rows, {}, [](const Row& row) { return row.counted.force_evaluations; });
    if (const auto seconds = seconds_of(most); seconds && most.counted.force_evaluations > 0)
      prices[*seconds / static_cast<double>(most.counted.force_evaluations)] = method.name();
  }
  if (!floors.empty())
    notes.push_back("Floors, where smaller steps bring no smaller error: at most " +
                    fmt::format("{}", fmt::join(floors, ", ")) + ".");
  if (prices.size() > 1 && work_count(problem).count == &Counted::force_evaluations)
    notes.push_back(fmt::format(
        "For each evaluation of the forces the longest run of a method takes {} ({}) to {} ({}): "
        "each bears its share of the step.",
        seconds_text(prices.begin()->first), prices.begin()->second,
        seconds_text(prices.rbegin()->first), prices.rbegin()->second));
  if (adaptive)
    notes.push_back(
        "Dormand–Prince, adaptive, solves the bare equations of motion, without the world's step: "
        "its seconds buy less. Its “step” stands for a tolerance: 1e-3 at the largest, less by the "
        "fifth power, 1e-14 at least.");
  if (left_out > 0)
    notes.push_back(
        fmt::format("{} of {} runs were left out as too long.", left_out, problem.rows.size()));
  return notes;
}

// A sweep in order of cost: a point is on the front if it has less error than all cheaper ones
// (Kung, Luccio, Preparata, "On Finding the Maxima of a Set of Vectors", 1975, for two dimensions).
std::vector<std::size_t> pareto_front(std::span<const Vec<2>> cost_and_error) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < cost_and_error.size(); ++i)
    if (std::isfinite(cost_and_error[i].x) && std::isfinite(cost_and_error[i].y))
      order.push_back(i);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    const Vec<2>&p = cost_and_error[a], &q = cost_and_error[b];
    return p.x < q.x || (p.x == q.x && p.y < q.y);
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || cost_and_error[i].y < cost_and_error[front.back()].y) front.push_back(i);
  return front;
}

std::vector<std::size_t> pareto_front(std::span<const Row> rows, const Cost& cost) {
  std::vector<Vec<2>> points;
  for (const Row& row : rows) {
    const auto error = is_adaptive(row.method) ? std::nullopt : row.error(), price = cost(row);
    points.push_back(error && price ? Vec<2>{*price, *error} : Vec<2>(std::nan("")));
  }
  return pareto_front(points);
}

std::optional<double> seconds_of(const Row& row) {
  if (row.processor.repeats < 1 || !std::isfinite(row.processor.median)) return std::nullopt;
  return row.processor.median;
}

}  // namespace lantern::report
