#include <map>

#include <gtest/gtest.h>

#include "draw/layout_check.hpp"
#include "draw/marks.hpp"
#include "draw/page.hpp"
#include "draw/sample_frames.hpp"

namespace lantern::draw {
namespace {

using frame::PairState;

const Frame& ledger(const std::string& name) {
  static const samples::Named all = samples::ledgers();
  for (const auto& [known, frame] : all)
    if (known == name) return frame;
  throw std::invalid_argument(name);
}

// Cells by their keys: where they lie, and what is painted.
std::map<std::string, std::vector<DrawShape>> cells_of(const DrawList& list) {
  std::map<std::string, std::vector<DrawShape>> cells;
  for (std::size_t r = 0; r < list.runs.size(); ++r) {
    const std::size_t end = r + 1 < list.runs.size() ? list.runs[r + 1].first : list.shapes.size();
    for (std::size_t i = list.runs[r].first; i < end; ++i)
      if (list.runs[r].key.starts_with("ledger/"))
        cells[list.runs[r].key].push_back(list.shapes[i]);
  }
  return cells;
}

TEST(Ledger, HasACellForEachPair) {
  const auto cells = cells_of(samples::page_of(ledger("ledger5")));
  for (int a = 0; a < 5; ++a)
    for (int b = a + 1; b < 5; ++b)
      EXPECT_TRUE(cells.contains("ledger/" + std::to_string(a) + "-" + std::to_string(b)))
          << a << b;
}

TEST(Ledger, KeySumsToAllPairs) {
  const DrawList list = samples::page_of(ledger("ledger5"));
  EXPECT_TRUE(says(list, "10 pairs"));
  EXPECT_TRUE(says(list, "1 static, never tested"));
  int sum = 0;
  for (const LabelBox& label : list.labels)
    for (const char* words : {"static, never tested", "ruled out", "not looked at", "candidate",
                              "box overlap", "apart by box", "apart by shape", "contact"})
      if (label.text.find(words) != std::string::npos) sum += std::stoi(label.text);
  EXPECT_EQ(sum, 10);
}

TEST(Ledger, SaysNothingOfStatesThatDoNotOccur) {
  const DrawList list = samples::page_of(ledger("ledger_broad"));
  for (const char* words : {"apart by box", "apart by shape", "contact"})
    EXPECT_FALSE(says_part(list, words)) << words << ", in the broad phase";
}

// A cell keeps its place when other bodies come.
TEST(Ledger, StandsStillWhileBodiesCome) {
  Frame few = ledger("ledger_few"), fewer = few;
  fewer.bodies.erase(fewer.bodies.begin() + 1);
  std::erase_if(fewer.pairs, [](const FramePair& p) { return p.pair.a == 1 || p.pair.b == 1; });
  std::erase_if(fewer.contacts,
                [](const FrameContact& c) { return c.pair.a == 1 || c.pair.b == 1; });
  const auto before = cells_of(samples::page_of(fewer)), after = cells_of(samples::page_of(few));
  ASSERT_TRUE(before.contains("ledger/3-4"));
  EXPECT_TRUE(reach_of(before.at("ledger/3-4")[0]) == reach_of(after.at("ledger/3-4")[0]));
  EXPECT_FALSE(before.contains("ledger/1-4"));
}

// In grey nothing but shapes is left.
TEST(Ledger, StatesDifferInShape) {
  std::set<std::string> seen;
  for (std::size_t s = 0; s < frame::kPairStates; ++s) {
    DrawList list;
    draw_pair_mark(static_cast<PairState>(s), false, {{0, 0}, {12, 12}}, list);
    std::string kinds;
    for (const DrawShape& shape : list.shapes) {
      kinds += std::to_string(shape.index());
      if (const auto* rect = std::get_if<RectShape>(&shape))
        kinds += rect->fill == Role::contact ? "filled" : rect->box.size().x > 6 ? "open" : "dot";
      if (s == 1) kinds += "weak";  // the only one whose outline is the page's hairline
    }
    EXPECT_TRUE(seen.insert(kinds).second) << "state " << s << " looks as another one: " << kinds;
  }
}

TEST(Ledger, OfManyBodiesIsADensity) {
  const DrawList cells = samples::page_of(ledger("ledger40")),
                 density = samples::page_of(ledger("ledger41"));
  EXPECT_FALSE(says(cells, "tested"));
  EXPECT_TRUE(says(density, "tested"));
  EXPECT_TRUE(says(density, "820 pairs"));
  EXPECT_LT(samples::page_of(ledger("ledger300")).shapes.size(), 2500u);
}

}  // namespace
}  // namespace lantern::draw
