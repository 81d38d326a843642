#include <optional>

#include "draw/font.hpp"
#include "draw/panels.hpp"

namespace lantern {
namespace {

// One fact of the line under the diagram: words, or a number and what it counts.
struct Fact {
  std::string words;
  std::optional<std::int64_t> number;
  std::string widest;  // that the words can get
  bool first_count = false;
};

struct Spacing {
  double gap = 0;             // between two facts
  bool counts_apart = false;  // counts begin a line of their own
};

std::vector<Fact> facts_of(const Frame& frame) {
  std::vector<Fact> facts;
  for (std::size_t at = 0; at < frame.settings.size();) {
    const std::size_t comma = std::min(frame.settings.find(", ", at), frame.settings.size());
    facts.push_back({frame.settings.substr(at, comma - at), std::nullopt, "", false});
    at = comma + 2;
  }
  const std::pair<const char*, const char*> counted[] = {
      {"nodes", "node"}, {"leaves", "leaf"}, {"entries", "entry"}};
  for (const auto& [many, one] : counted)
    if (const auto n = frame.count(many))
      facts.push_back({*n == 1 ? one : many, n, many, facts.empty() || !facts.back().number});
  return facts;
}

constexpr double kFactLine = 30;

// Lays the facts out in lines and draws them when `labels` is given; gives the number of lines.
// Counts have cells for two digits at least, so that nothing moves while a small tree grows.
int lay_out_facts(const std::vector<Fact>& facts, const Box<2>& panel, const Spacing& spacing,
                  double top, Labels* labels) {
  const TextStyle style{kLabel, Weight::regular, Role::quiet_ink};
  constexpr double kSpace = 6;
  double x = panel.lo.x;
  int line = 0;
  for (const Fact& fact : facts) {
    double number = 0;  // room for it
    if (fact.number) {
      const auto digits = static_cast<std::int64_t>(std::to_string(*fact.number).size());
      number = Labels::number_width(std::max<std::int64_t>(2, digits), style) + kSpace;
    }
    const std::string words = shortened(fact.words, panel.size().x, style);
    const double width = number + text_width(fact.widest.empty() ? words : fact.widest, style);
    const bool counts_begin = spacing.counts_apart && fact.first_count;
    if (x > panel.lo.x && (counts_begin || x + width > panel.hi.x)) {
      x = panel.lo.x;
      ++line;
    }
    if (labels) {
      const double y = top + line * kFactLine + 20;
      if (fact.number) labels->add_number(*fact.number, {x + number - kSpace, y}, style, panel);
      labels->add(words, {{x + number, y}, 0}, style, panel);
    }
    x += width + spacing.gap;
  }
  return facts.empty() ? 0 : line + 1;
}

// One line if there is room for it, however narrow; otherwise counts begin a line of their own.
Spacing spacing_of(const std::vector<Fact>& facts, const Box<2>& panel) {
  constexpr double kGaps[] = {34, 28, 22, 18, 14};
  for (const double gap : kGaps)
    if (lay_out_facts(facts, panel, {gap, false}, 0, nullptr) <= 1) return {gap, false};
  const int least = lay_out_facts(facts, panel, {14, true}, 0, nullptr);
  for (const double gap : kGaps)
    if (lay_out_facts(facts, panel, {gap, true}, 0, nullptr) == least) return {gap, true};
  return {14, true};
}

}  // namespace

double draw_tree_facts(const Frame& frame, const Box<2>& panel, Labels& labels) {
  const std::vector<Fact> facts = facts_of(frame);
  const Spacing spacing = spacing_of(facts, panel);
  const double height = lay_out_facts(facts, panel, spacing, 0, nullptr) * kFactLine;
  lay_out_facts(facts, panel, spacing, panel.hi.y - height, &labels);
  return height;
}

}  // namespace lantern
