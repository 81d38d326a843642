#include "report/sentences.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "report/claims.hpp"
#include "report/pareto.hpp"

namespace lantern::report {
namespace {

using Rows = std::vector<const Row*>;

bool meets(const Row& row, double bound) {
  const auto error = row.error();
  return error && std::isfinite(*error) && *error <= bound;
}

std::string count_text(double n, const std::string& name) {
  if (n == 1) return "1 " + name.substr(0, name.size() - 1);  // all names end with an s
  if (n < 1e6) return fmt::format("{:.0f} {}", n, name);
  return figure(n) + " " + name;
}

// "0.8 ms at h = 0.005 s, 2060 force evaluations".
std::string price(const Row& row, const WorkCount& work, bool brief) {
  const std::string at = is_adaptive(row.method) ? "in steps of its own"
                                                 : fmt::format("at h = {} s", figure(row.step));
  const auto seconds = seconds_of(row);
  const auto count = brief && seconds ? std::nullopt : work.of(row);
  std::string text = seconds ? seconds_text(*seconds) + " " + at : at;
  if (count) text += ", " + count_text(*count, work.name);
  return text;
}

std::string peer_name(const Row& row) { return row.method + " " + row.version; }

std::string name_of(const Row& row) {
  return row.is_peer() ? "the peer " + row.method : method_words(row.method);
}

class Teller {
 public:
  Teller(const ProblemRows& problem, bool brief)
      : work_(work_count(problem)), brief_(brief), counts_wrong_(has_whole_errors(problem)) {
    bound_ = error_bound(problem);
    for (const MethodRows& c : by_method(problem)) {
      if (!c.is_peer) ++methods_;
      bool any = false;
      for (const Row& row : c.rows) any = any || (bound_ && meets(row, *bound_));
      if (!any && !c.is_peer) short_.emplace_back(c, problem);
    }
    if (!brief)
      for (const std::vector<std::string>& group : equal_methods(problem)) {
        std::vector<std::string> names;
        for (const std::string& method : group) names.push_back(method_words(method));
        equal_ += fmt::format("; {} give equal errors", listed(names));
      }
    for (const Row& row : problem.rows) {
      ++runs_[static_cast<std::size_t>(row.status)];
      if (bound_ && meets(row, *bound_)) (row.is_peer() ? peers_ : own_).push_back(&row);
    }
    for (const Row* row : own_) timed_ = timed_ || seconds_of(*row).has_value();
    for (const Row* row : peers_) timed_peers_ = timed_peers_ || seconds_of(*row).has_value();
  }

  std::string text() const {
    if (!bound_) return nothing();
    if (own_.empty()) return only_peers();
    Rows own = cheapest(own_, timed_);
    if (own.empty()) own = {own_.front()};
    Rows all = own_;
    if (timed_ && timed_peers_) all.insert(all.end(), peers_.begin(), peers_.end());
    const Rows best = timed_ ? cheapest(all, timed_) : own;
    const bool has_own = std::ranges::any_of(best, [](const Row* row) { return !row->is_peer(); });
    const bool has_peer = std::ranges::any_of(best, [](const Row* row) { return row->is_peer(); });
    std::string text;
    if (!has_own)
      text = fmt::format("The cheapest {} {}; of Lantern's methods, {}", limit(), with_verb(best),
                         with_price(own));
    else if (methods_ == 1 && !has_peer)
      text = alone(*own[0]);
    else if (has_peer)
      text = fmt::format("The cheapest {} {}", limit(), with_verb(best));
    else
      text = fmt::format("The cheapest method{} {} {}", best.size() > 1 ? "s" : "", limit(),
                         with_verb(best));
    return text + (brief_ ? "" : shortfall_words(short_)) + equal_ + ".";
  }

 private:
  Rows cheapest(const Rows& rows, bool timed) const {
    if (timed) return cheapest_rows(rows, seconds_of, true);
    return cheapest_rows(
        rows, [this](const Row& row) { return work_.of(row); }, false);
  }

  // "under 1e-6"; of errors that are counted, "that is exact".
  std::string limit() const {
    if (!counts_wrong_) return "under " + figure(*bound_);
    return *bound_ < 1 ? "without an error" : fmt::format("with {} wrong at most", figure(*bound_));
  }

  std::string price_of(const Row& row) const { return price(row, work_, brief_); }

  // "is velocity Verlet: 2 ms at ..."; of several, "are A with 2 ms at ... and B with ..., which".
  std::string with_verb(const Rows& rows) const {
    if (rows.size() > 1) return "are " + with_price(rows);
    const Row& row = *rows[0];
    const std::string name = row.is_peer() ? peer(row) + ", a peer" : name_of(row);
    return fmt::format("is {}: {}", name, price_of(row));
  }

  // Equals have no counted work beside: they would be told apart by it.
  std::string with_price(const Rows& rows) const {
    if (rows.size() == 1) return name_of(*rows[0]) + ": " + price_of(*rows[0]);
    const bool timed = seconds_of(*rows[0]).has_value(), each = timed && !brief_;
    const std::size_t most = brief_ ? 2 : 4;
    const std::size_t named = rows.size() > most ? most - 1 : rows.size();
    std::vector<std::string> names;
    for (std::size_t i = 0; i < named; ++i)
      names.push_back(each ? name_of(*rows[i]) + " with " + price(*rows[i], work_, true)
                           : name_of(*rows[i]));
    if (named < rows.size()) names.push_back(fmt::format("{} others", rows.size() - named));
    if (each) return listed(names) + ", which cost the same within the spread";
    return listed(names) + ", equally: " + price_of(*rows[0]);
  }

  // Where it is brief, a legend tells the version.
  std::string peer(const Row& row) const { return brief_ ? row.method : peer_name(row); }

  std::string alone(const Row& row) const {
    const std::string name = method_words(row.method);
    const char* gets = is_plural(name) ? "get" : "gets";
    const std::string there = counts_wrong_ ? "through " + limit() : limit();
    return fmt::format("{} {} {} with {}", capital(name), gets, there, price_of(row));
  }

  std::string only_peers() const {
    Rows best = cheapest(peers_, timed_peers_);
    if (best.empty()) best = {peers_.front()};
    const std::string who = methods_ == 0 ? "Only peers were run"
                                          : fmt::format("No method of Lantern gets {}{}{}",
                                                        counts_wrong_ ? "through " : "", limit(),
                                                        within_runs_made(short_));
    const char* s = best.size() > 1 ? "s" : "";
    const std::string which = methods_ == 0 ? limit() : *s ? "that do" : "that does";
    if (best.size() > 1)
      return fmt::format("{}; the cheapest peers {} are {}{}.", who, which, with_price(best),
                         equal_);
    return fmt::format("{}; the cheapest peer {} is {}: {}{}.", who, which, peer(*best[0]),
                       price_of(*best[0]), equal_);
  }

  std::string nothing() const {
    std::vector<std::string> parts;
    for (std::size_t s = 1; s < runs_.size(); ++s)
      if (runs_[s] > 0)
        parts.push_back(fmt::format("{} {}", runs_[s],
                                    static_cast<Status>(s) == Status::nan
                                        ? "not a number"
                                        : std::string(to_string(static_cast<Status>(s)))));
    if (runs_[0] > 0 || parts.empty()) return "No run has an error that could be compared.";
    return fmt::format("No run got to its end: {}.", listed(parts));
  }

  WorkCount work_;
  bool brief_ = false;
  bool counts_wrong_ = false;
  std::optional<double> bound_;
  std::size_t methods_ = 0;
  std::vector<Shortfall> short_;  // methods that miss the bound
  std::string equal_;             // what is to be said of methods that are
  Rows own_, peers_;
  bool timed_ = false, timed_peers_ = false;
  std::array<std::size_t, kStatusNames.size()> runs_{};
};

}  // namespace

std::optional<double> error_bound(const ProblemRows& problem) {
  std::optional<double> least;
  for (const Row& row : problem.rows)
    if (const auto error = row.error(); error && std::isfinite(*error))
      least = std::min(least.value_or(*error), *error);
  if (!least) return std::nullopt;
  // Each from its own text: a product of tens would miss the double nearest to 1e-5.
  constexpr double kBounds[] = {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1};
  for (const double bound : kBounds)
    if (*least <= bound) return bound;
  double bound = 1;
  while (bound < *least && bound < 1e300) bound *= 10;
  return std::max(bound, *least);
}

std::string sentence(const ProblemRows& problem) { return Teller(problem, false).text(); }

std::string short_sentence(const ProblemRows& problem) { return Teller(problem, true).text(); }

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

std::string capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z')
    text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

std::string seconds_text(double seconds) {
  if (!std::isfinite(seconds)) return "?";
  const double size = std::abs(seconds);
  if (size >= 1 || size == 0) return fmt::format("{:.3g} s", seconds);
  if (size >= 0.9995e-4) return fmt::format("{:.3g} ms", seconds * 1e3);
  if (size >= 0.9995e-7) return fmt::format("{:.3g} µs", seconds * 1e6);
  return fmt::format("{:.3g} ns", seconds * 1e9);
}

std::string figure(double number) {
  if (!std::isfinite(number)) return "?";
  const double size = std::abs(number);
  if (size == 0) return "0";
  if (size >= 0.9995e-3 && size < 1e5) {
    if (size >= 999.5) return fmt::format("{:.0f}", number);
    return fmt::format("{:.3g}", number);
  }
  std::string text = fmt::format("{:.2e}", number);
  const std::size_t e = text.find('e');
  std::string lead = text.substr(0, e);
  while (lead.back() == '0') lead.pop_back();
  if (lead.back() == '.') lead.pop_back();
  return fmt::format("{}e{}", lead, std::stoi(text.substr(e + 1)));
}

}  // namespace lantern::report
