// The web page of measurements: that it parses, stands alone, and leaves nothing without a choice.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "report/document.hpp"
#include "report/measure_document.hpp"
#include "report/problem_rows.hpp"
#include "report/sample_rows.hpp"

namespace lantern::report {
namespace {

struct Tag {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string of(std::string_view attribute) const {
    for (const auto& [name_of, value] : attributes)
      if (name_of == attribute) return value;
    return "";
  }
};

// Every tag of a page that is strictly nested and quotes all of its attributes; whatever is not is
// a failure. The texts of styles and scripts are skipped.
class Parser {
 public:
  explicit Parser(std::string_view html) : left_(html) { parse(); }
  std::vector<Tag> tags;

 private:
  void parse() {
    while (!left_.empty()) {
      const std::size_t next = left_.find('<');
      EXPECT_EQ(left_.substr(0, next).find('>'), std::string_view::npos);
      if (next == std::string_view::npos) break;
      left_.remove_prefix(next + 1);
      const std::size_t end = left_.find('>');
      ASSERT_NE(end, std::string_view::npos) << left_.substr(0, 80);
      take(left_.substr(0, end));
      left_.remove_prefix(end + 1);
      const bool raw = !open_.empty() && (open_.back() == "style" || open_.back() == "script");
      if (raw) left_.remove_prefix(std::min(left_.find("</" + open_.back()), left_.size()));
    }
    if (!open_.empty()) ADD_FAILURE() << open_.back() << " is not closed";
  }

  void take(std::string_view words) {
    if (words.starts_with("!DOCTYPE")) return;
    if (words.starts_with("/")) {
      ASSERT_FALSE(open_.empty()) << words;
      EXPECT_EQ(open_.back(), words.substr(1));
      open_.pop_back();
      return;
    }
    const bool closed = words.ends_with("/");
    if (closed) words.remove_suffix(1);
    Tag& tag = tags.emplace_back();
    tag.name = words.substr(0, words.find(' '));
    words.remove_prefix(tag.name.size());
    while (!words.empty()) {
      words.remove_prefix(1);
      const std::size_t name_end = std::min(words.find_first_of("= "), words.size());
      auto& [name, value] = tag.attributes.emplace_back(words.substr(0, name_end), "");
      words.remove_prefix(name_end);
      if (!words.starts_with("=")) continue;
      ASSERT_TRUE(words.starts_with("=\"")) << words;
      const std::size_t quote = words.find('"', 2);
      ASSERT_NE(quote, std::string_view::npos) << words;
      value = words.substr(2, quote - 2);
      words.remove_prefix(quote + 1);
    }
    const std::set<std::string> empty = {"meta", "br", "input"};
    if (!closed && !empty.contains(tag.name)) open_.push_back(tag.name);
  }

  std::string_view left_;
  std::vector<std::string> open_;
};

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find(' ', from), text.size());
    words.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return words;
}

// "m3" and "k1".
bool is_choice(const std::string& word) {
  return word.size() > 1 && (word[0] == 'm' || word[0] == 'k') &&
         std::ranges::all_of(word.substr(1), [](char c) { return c >= '0' && c <= '9'; });
}

std::set<std::string> check(const std::string& html) {
  const Parser page(html);
  std::set<std::string> ids, boxes;
  for (const Tag& tag : page.tags) {
    const std::string id = tag.of("id");
    EXPECT_TRUE(id.empty() || ids.insert(id).second) << id;
    if (tag.of("type") == "checkbox") boxes.insert(id);
    EXPECT_EQ(tag.of("src"), "");
  }
  std::set<std::string> chosen;
  for (const Tag& tag : page.tags) {
    const std::string to = tag.of("href");
    EXPECT_TRUE(to.empty() || (to[0] == '#' && ids.contains(to.substr(1)))) << to;
    for (const std::string& word : words_of(tag.of("class")))
      if (is_choice(word)) chosen.insert(word);
  }
  EXPECT_EQ(chosen, boxes);
  for (const std::string& box : boxes)
    EXPECT_NE(html.find(":root:has(#" + box + ":not(:checked)) ." + box + "{display:none}"),
              std::string::npos);
  for (const char* outside : {"://", "url(", "@import"})
    EXPECT_EQ(html.find(outside), std::string::npos) << outside;
  return boxes;
}

std::string page_of(std::span<const Measurement> measurements, const std::vector<Bar>& bars) {
  return to_html(document_of(measurements, bars));
}

TEST(HtmlPage, ParsesStandsAloneAndEverySeriesCanBeChosen) {
  for (const std::size_t problems : {0u, 1u, 9u}) {
    const Measurement m = samples::measurement(problems);
    const std::set<std::string> boxes = check(page_of(std::span(&m, 1), samples::bars()));
    EXPECT_EQ(boxes.size(), looks_of(m.rows).size());
  }
  Measurement untimed = samples::measurement(2);
  for (Row& row : untimed.rows) row.timing = row.processor = {};
  check(page_of(std::span(&untimed, 1), {}));
  check(page_of({}, {}));
}

TEST(HtmlPage, TwoMachinesLieInOnePlotAndTheirStatesAreCompared) {
  std::vector<Measurement> both = {samples::measurement(3), samples::measurement(3)};
  both[1].circumstances.processor = "Another <processor> & \"more\" \x1b";
  std::size_t own = 0;
  for (Row& row : both[1].rows) {
    row.processor.median *= 3;
    own += !row.is_peer();
  }
  std::ranges::find_if(both[1].rows, [](const Row& row) { return !row.is_peer(); })->hash ^= 1;
  const std::string html = page_of(both, {});
  const std::set<std::string> boxes = check(html);
  EXPECT_TRUE(boxes.contains("k0") && boxes.contains("k1") && boxes.contains("m0"));
  EXPECT_NE(html.find("Another &lt;processor&gt; &amp; &quot;more&quot;"), std::string::npos);
  EXPECT_NE(html.find("Of " + std::to_string(own) +
                      " runs of Lantern that machines A and B both "
                      "made, " +
                      std::to_string(own - 1) + " ended in the same state"),
            std::string::npos);
  EXPECT_EQ(html, page_of(both, {}));
}

TEST(HtmlPage, TellsHowEnginesWereRun) {
  Measurement m = samples::measurement(1);
  m.peers = {{"Bullet", "0.16.2", {}}, {"Nobody", "1", {}}};
  m.peers[0].settings.flags = "<some>";
  const std::string html = page_of(std::span(&m, 1), {});
  check(html);
  EXPECT_NE(html.find("&lt;some&gt;"), std::string::npos);
  EXPECT_EQ(html.find("Nobody"), std::string::npos);
}

TEST(HtmlPage, FailedRunsAndQuartilesAreSeen) {
  const Measurement m = samples::measurement(1);
  const std::string html = page_of(std::span(&m, 1), {});
  for (const char* words :
       {"class=\"whisker\"", "class=\"open\"", "class=\"bad\">diverged", "velocity Verlet: order 2",
        "prefers-color-scheme:dark", "@media print"})
    EXPECT_NE(html.find(words), std::string::npos) << words;
}

TEST(WebPlot, PutsEveryPointWhereItBelongs) {
  Plot plot;
  plot.series = {{"a", {{{1, 1e-3}}, {{10, 0}}, {{100, 5}, true}, {{HUGE_VAL, 1}}}}};
  const std::string svg = web_plot(plot, {"m0"});
  const Parser parsed(svg);
  std::vector<double> places;
  std::string marks;
  for (std::size_t i = 0; i + 2 < parsed.tags.size(); ++i) {
    const std::string kind = parsed.tags[i].of("class");
    if (parsed.tags[i].name != "g" || (kind != "mark" && kind != "open")) continue;
    EXPECT_EQ(parsed.tags[i - 1].of("class"), "m0");
    EXPECT_EQ(parsed.tags[i + 1].name, "title");
    places.push_back(std::stod(parsed.tags[i + 2].of("x")));
    marks += kind + " ";
  }
  ASSERT_EQ(places.size(), 3u);  // what is not finite has no place
  EXPECT_NEAR(places[1] - places[0], places[2] - places[1], 1.5) << "decades are equally wide";
  EXPECT_GT(places[1] - places[0], 100);
  EXPECT_EQ(marks, "mark mark open ");
  EXPECT_NE(svg.find("a: 10; 0"), std::string::npos);
}

}  // namespace
}  // namespace lantern::report
