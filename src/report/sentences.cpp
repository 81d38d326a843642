#include "report/sentences.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace lantern {
namespace {

struct Best {
  const Row* row = nullptr;
  double cost = 0;
  std::vector<std::string> equal;  // other methods at the same cost
};

using Rows = std::vector<const Row*>;

bool meets(const Row& row, double bound) {
  const auto error = row.error();
  return error && std::isfinite(*error) && *error <= bound;
}

// The cheapest of `rows`; nothing if none has a cost. Of equal ones that with less error, then the
// first.
Best cheapest(const Rows& rows, const Cost& cost) {
  Best best;
  for (const Row* row : rows) {
    const auto price = cost(*row);
    if (!price) continue;
    const bool less = !best.row || *price < best.cost ||
                      (*price == best.cost && *row->error() < *best.row->error());
    if (less) best = {row, *price, {}};
  }
  for (const Row* row : rows)
    if (best.row && row->method != best.row->method && cost(*row) == best.cost &&
        row->error() == best.row->error())
      best.equal.push_back(method_words(row->method));
  return best;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

std::string count_text(double n, const std::string& name) {
  if (n == 1) return "1 " + name.substr(0, name.size() - 1);  // all names end with an s
  if (n < 1e6) return fmt::format("{:.0f} {}", n, name);
  return figure(n) + " " + name;
}

// "0.8 ms at h = 0.005 s, 2060 force evaluations".
std::string price(const Row& row, const WorkCount& work, bool brief) {
  const bool adaptive = row.method.starts_with("dormand");
  const std::string at =
      adaptive ? "in steps of its own" : fmt::format("at h = {} s", figure(row.step));
  const auto seconds = seconds_of(row);
  const auto count = brief && seconds ? std::nullopt : work.of(row);
  std::string text = seconds ? seconds_text(*seconds) + " " + at : at;
  if (count) text += ", " + count_text(*count, work.name);
  return text;
}

std::string peer_name(const Row& row) { return row.method + " " + row.version; }

class Teller {
 public:
  Teller(const ProblemRows& problem, bool brief) : work_(work_count(problem)), brief_(brief) {
    bound_ = error_bound(problem);
    for (const ContestantRows& c : by_contestant(problem)) {
      if (!c.is_peer) ++methods_;
      bool any = false;
      for (const Row& row : c.rows) any = any || (bound_ && meets(row, *bound_));
      if (!any && !c.is_peer) never_.push_back(method_words(c.method));
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
    const std::string limit = figure(*bound_);
    if (own_.empty()) return only_peers(limit);
    const Best best = cheapest(own_, cost(timed_));
    const Row& row = best.row ? *best.row : *own_.front();
    const Best peer = cheapest(peers_, cost(timed_ && timed_peers_));
    const bool peer_first = peer.row && best.row && peer.cost < best.cost && timed_ && timed_peers_;
    const std::string name = method_words(row.method);
    const std::string own_price = price(row, work_, brief_);
    std::string text;
    if (peer_first)
      text = fmt::format("The cheapest under {} is {}, a peer: {}; of Lantern's methods, {}: {}",
                         limit, peer_name(*peer.row), price(*peer.row, work_, brief_), name,
                         own_price);
    else if (methods_ == 1)
      text = fmt::format("{} gets under {} with {}", capital(name), limit, own_price);
    else if (best.equal.empty())
      text = fmt::format("The cheapest method under {} is {}: {}", limit, name, own_price);
    else
      text = fmt::format("The cheapest methods under {} are {}, equally: {}", limit,
                         listed(together(name, best.equal)), own_price);
    return text + never() + ".";
  }

 private:
  Cost cost(bool timed) const {
    if (timed) return seconds_of;
    return [this](const Row& row) { return work_.of(row); };
  }

  static std::vector<std::string> together(std::string first, std::vector<std::string> others) {
    others.insert(others.begin(), std::move(first));
    std::vector<std::string> unlike;
    for (std::string& name : others)
      if (std::find(unlike.begin(), unlike.end(), name) == unlike.end())
        unlike.push_back(std::move(name));
    return unlike;
  }

  static std::string capital(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z')
      text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text;
  }

  std::string never() const {
    if (never_.empty() || brief_) return "";
    if (never_.size() > 3)
      return fmt::format("; {} of Lantern's methods never get there", never_.size());
    return fmt::format("; {} never {} there", listed(never_), never_.size() == 1 ? "gets" : "get");
  }

  std::string only_peers(const std::string& limit) const {
    const Best peer = cheapest(peers_, cost(timed_peers_));
    const Row& row = peer.row ? *peer.row : *peers_.front();
    const std::string who =
        methods_ == 0 ? "Only peers were run" : "No method of Lantern gets under " + limit;
    return fmt::format("{}; the cheapest peer {} is {}: {}.", who,
                       methods_ == 0 ? "under " + limit : "that does", peer_name(row),
                       price(row, work_, brief_));
  }

  std::string nothing() const {
    std::vector<std::string> parts;
    for (std::size_t s = 1; s < 4; ++s)
      if (runs_[s] > 0)
        parts.push_back(
            fmt::format("{} {}", runs_[s],
                        s == 2 ? "not a number" : std::string(to_string(static_cast<Status>(s)))));
    if (runs_[0] > 0 || parts.empty()) return "No run has an error that could be compared.";
    return fmt::format("No run got to its end: {}.", listed(parts));
  }

  WorkCount work_;
  bool brief_ = false;
  std::optional<double> bound_;
  std::size_t methods_ = 0;
  std::vector<std::string> never_;
  Rows own_, peers_;
  bool timed_ = false, timed_peers_ = false;
  std::size_t runs_[4] = {};
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

std::vector<std::string> sentences(const Measurement& measurement) {
  std::vector<std::string> all;
  for (const ProblemRows& problem : by_problem(measurement.rows)) all.push_back(sentence(problem));
  return all;
}

std::string short_sentence(const ProblemRows& problem) { return Teller(problem, true).text(); }

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

}  // namespace lantern
