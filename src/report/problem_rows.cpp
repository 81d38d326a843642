#include "report/problem_rows.hpp"

#include "geometry/elementary.hpp"

namespace lantern::report {
namespace {

struct KnownMethod {
  std::string_view name, words;  // no words: it is called by its name
  int look;
};

// The first ones are those that meet most often in one plot.
constexpr std::array<KnownMethod, 31> kKnown{{
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
    {"Bullet:10", "", 10},
    {"Bullet:50", "", 11},
    {"Bullet:NNCG", "", 12},
    {"Bullet:Dantzig", "", 13},
    {"Box2D:8,3", "", 22},
    {"Box2D:40,20", "", 23},
    {"Bullet:multibody", "", 24},
    {"Bullet:multibody,RK4", "", 25},
    {"MuJoCo:Euler", "", 26},
    {"MuJoCo:implicit", "", 27},
    {"MuJoCo:RK4", "", 36},
    {"MuJoCo:Euler,hard", "", 37},
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

std::vector<std::optional<double>> assured_errors(const MethodRows& method) {
  std::vector<std::optional<double>> all(method.rows.size());
  std::optional<double> worst = method.floor ? method.floor->largest : 0;
  for (std::size_t i = all.size(); i-- > 0;) {
    const Row& row = method.rows[i];
    if (!row.was_run()) continue;
    const auto error = row.error();
    worst = error && worst ? std::optional(std::max(*worst, *error)) : std::nullopt;
    all[i] = worst;
  }
  return all;
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
    with_name(all, &MethodRows::method, {row.method, row.is_peer(), row.version, {}, {}, {}, {}})
        .rows.push_back(row);
  for (MethodRows& c : all) {
    std::ranges::stable_sort(c.rows, std::greater(), &Row::step);
    c.floor = observed_floor(c.rows);
    c.order = observed_order(std::span(c.rows).first(c.floor ? c.floor->first : c.rows.size()));
    c.assured = assured_errors(c);
  }
  return all;
}

std::string MethodRows::name() const {
  return is_peer ? method + " " + version : method_words(method);
}

std::string method_words(std::string_view method) {
  const KnownMethod* k = known(method);
  if (k && !k->words.empty()) return std::string(k->words);
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
    if (const KnownMethod* k = known(row.method)) {
      look = k->look;
    } else {
      const auto of_other_kind = [&](int l) {  // crosses and stars are for peers
        return row.is_peer() != (l % kPlotMarks >= kFirstPeerLook);
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
  if (length < 2 || from + length + 1 < slopes.size()) return std::nullopt;
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

std::optional<Floor> observed_floor(std::span<const Row> rows) {
  while (!rows.empty() && !rows.back().error()) rows = rows.first(rows.size() - 1);
  if (rows.empty() || is_adaptive(rows[0].method)) return std::nullopt;
  const auto order = observed_order(rows);
  const double half = order ? order->exponent / 2 : 0.5;
  const auto error = [](const Row& row) { return row.error().value_or(HUGE_VAL); };
  for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
    const auto tail = rows.subspan(i);
    const auto most = std::ranges::max_element(tail, {}, error);
    if (error(*most) == 0 || error(*most) > kBegun || error(*most) >= error(rows[i - 1])) continue;
    const double power = tail.size() > 2 ? half : 0;  // one may be slow by chance
    const auto stays = [&](const Row& row) {
      return error(row) >= error(*most) * geometry::pow(row.step / rows[i].step, power);
    };
    if (std::all_of(most, tail.end(), stays)) return Floor{i, rows.size() - 1, error(*most)};
  }
  return std::nullopt;
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

std::vector<Vec<2>> pareto_front(const ProblemRows& problem, const Cost& cost) {
  std::vector<Vec<2>> points, front;
  for (const MethodRows& method : by_method(problem)) {
    const auto& errors = method.assured;
    for (std::size_t i = 0; i < errors.size() && !is_adaptive(method.method); ++i)
      if (const auto price = cost(method.rows[i]); price && errors[i])
        points.push_back({*price, *errors[i]});
  }
  for (const std::size_t i : pareto_front(points)) front.push_back(points[i]);
  return front;
}

std::optional<double> seconds_of(const Row& row) {
  if (row.processor.repeats < 1 || !std::isfinite(row.processor.median)) return std::nullopt;
  return row.processor.median;
}

}  // namespace lantern::report
