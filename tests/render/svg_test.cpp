#include "render/svg.hpp"

#include <clocale>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "draw/font.hpp"
#include "render/renderer.hpp"
#include "render/sample_scene.hpp"
#include "render/support.hpp"

namespace lantern::render {
namespace {

struct Element {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text = {};  // of title, desc and text
};

// Reads the small part of XML that an SVG of ours may use; a failure tells where it is not well-
// formed.
class Xml {
 public:
  explicit Xml(const std::string& text) : text_(text) {}

  std::vector<Element> elements() {
    std::vector<Element> all;
    std::vector<std::string> open;
    while (skip_space(), at_ < text_.size()) {
      EXPECT_EQ(text_[at_], '<') << "text between elements at " << at_;
      if (text_[at_++] != '<') return all;
      if (text_[at_] == '/') {
        ++at_;
        const std::string closed = name();
        EXPECT_FALSE(open.empty());
        if (open.empty()) return all;
        EXPECT_EQ(closed, open.back());
        open.pop_back();
      } else {
        all.push_back(element());
        if (text_[at_] == '/')
          ++at_;
        else
          open.push_back(all.back().name);
      }
      EXPECT_EQ(text_[at_], '>') << "at " << at_;
      ++at_;
      if (!open.empty() &&
          (open.back() == "title" || open.back() == "desc" || open.back() == "text"))
        all.back().text = words();
    }
    EXPECT_TRUE(open.empty());
    return all;
  }

 private:
  void skip_space() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
  }
  std::string name() {
    const std::size_t end = text_.find_first_of(" =/>\n", at_);
    const std::string n = text_.substr(at_, end - at_);
    at_ = end;
    return n;
  }
  Element element() {
    Element e{name(), {}};
    while (skip_space(), text_[at_] != '/' && text_[at_] != '>') {
      const std::string key = name();
      EXPECT_EQ(text_.substr(at_, 2), "=\"");
      const std::size_t end = text_.find('"', at_ + 2);
      const std::string value = text_.substr(at_ + 2, end - at_ - 2);
      EXPECT_EQ(value.find_first_of("<&"), std::string::npos);
      EXPECT_TRUE(e.attributes.emplace(key, value).second) << "twice: " << key;
      at_ = end + 1;
    }
    return e;
  }

  std::string words() {
    const std::size_t end = text_.find('<', at_);
    const std::string found = text_.substr(at_, end - at_);
    EXPECT_EQ(found.find_first_of(">\""), std::string::npos) << found;
    at_ = end;
    return found;
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

std::vector<Element> named(const std::vector<Element>& all, const std::string& name) {
  std::vector<Element> found;
  for (const Element& e : all)
    if (e.name == name) found.push_back(e);
  return found;
}

TEST(Svg, IsWellFormedAndUsesOnlyWhatItDefines) {
  const std::string svg = to_svg(sample_scene(), *theme_named("light"), false, 1600, 900);
  const std::vector<Element> all = Xml(svg).elements();
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all[0].name, "svg");
  EXPECT_EQ(all[0].attributes.at("viewBox"), "0 0 1600 900");
  std::set<std::string> defined, used;
  for (const Element& e : named(all, "path")) {
    EXPECT_TRUE(defined.insert("#" + e.attributes.at("id")).second) << "a glyph defined twice";
  }
  for (const Element& e : named(all, "use")) used.insert(e.attributes.at("xlink:href"));
  EXPECT_EQ(defined, used) << "a glyph without its outline, or an outline for nothing";
  EXPECT_EQ(named(all, "text").size(), 0u) << "text would need a font";
}

TEST(Svg, TransparentLeavesOutThePaper) {
  const DrawList empty = page_of(160, 90, {});
  EXPECT_EQ(named(Xml(to_svg(empty, plain_theme(), false, 16, 9)).elements(), "rect").size(), 1u);
  EXPECT_EQ(named(Xml(to_svg(empty, plain_theme(), true, 16, 9)).elements(), "rect").size(), 0u);
}

TEST(Svg, NumbersHaveAtMostThreeDecimals) {
  const DrawList list = page_of(160, 90,
                                {rect(1.0 / 3, -1.0 / 7, 2e-5, 12.3456, Role::ink),
                                 line(-0.0001, 99999.9999, 5, 5.5, {Role::ink, 2, 1.5})});
  const auto all = Xml(to_svg(list, plain_theme(), true, 16, 9)).elements();
  const auto r = named(all, "rect").at(0).attributes;
  EXPECT_EQ(r.at("x"), "0.333");
  EXPECT_EQ(r.at("y"), "-0.143");
  EXPECT_EQ(r.at("width"), "0");
  EXPECT_EQ(r.at("height"), "12.346");
  const auto l = named(all, "line").at(0).attributes;
  EXPECT_EQ(l.at("x1"), "0") << "never -0";
  EXPECT_EQ(l.at("y1"), "100000");
  EXPECT_EQ(l.at("stroke-dasharray"), "1.5");
}

TEST(Svg, DoesNotHeedTheLocale) {
  const std::string expected = to_svg(sample_scene(), plain_theme(), false, 1600, 900);
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"})
    if (std::setlocale(LC_ALL, name)) break;
  EXPECT_EQ(to_svg(sample_scene(), plain_theme(), false, 1600, 900), expected);
  std::setlocale(LC_ALL, "C");
}

TEST(Svg, HalosLieBelowTheirLetters) {
  const DrawList list =
      page_of(160, 90, {text("ab", 10, 20, 10, Role::ink, 0, Weight::regular, Role::warning)});
  const auto groups = named(Xml(to_svg(list, plain_theme(), true, 16, 9)).elements(), "g");
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].attributes.at("stroke"), "#ff0000");
  EXPECT_EQ(groups[0].attributes.at("stroke-width"), "600") << "6 units, at 100 to the unit";
  EXPECT_EQ(groups[1].attributes.at("fill"), "#000000");
  EXPECT_EQ(groups[1].attributes.count("stroke"), 0u);
}

std::set<std::string> ids(const std::string& svg) {
  std::set<std::string> found;
  for (const Element& e : Xml(svg).elements())
    if (e.attributes.contains("id")) {
      EXPECT_TRUE(found.insert(e.attributes.at("id")).second);
    }
  return found;
}

TEST(Svg, FilesOfDifferentPrefixesShareNoId) {
  const std::set<std::string> a = ids(to_svg(sample_scene(), plain_theme(), false, 1600, 900,
                                             {"A", "a", "one-", false})),
                              b = ids(to_svg(sample_scene(), plain_theme(), false, 1600, 900,
                                             {"A", "a", "two-", false}));
  EXPECT_EQ(a.size(), b.size());
  EXPECT_GT(a.size(), 20u);
  for (const std::string& id : a) EXPECT_FALSE(b.contains(id)) << id;
}

TEST(Svg, SaysWhatItShowsToWhoeverDoesNotSeeIt) {
  const DrawList list = page_of(160, 90, {});
  const auto all = Xml(to_svg(list, plain_theme(), true, 16, 9,
                              {"Trees & <nodes>", "it's \"split\"", "p-", false}))
                       .elements();
  EXPECT_EQ(all.at(0).attributes.at("role"), "img");
  EXPECT_EQ(all.at(0).attributes.at("aria-labelledby"), "p-title p-desc");
  EXPECT_EQ(named(all, "title").at(0).attributes.at("id"), "p-title");
  EXPECT_EQ(named(all, "title").at(0).text, "Trees &amp; &lt;nodes&gt;");
  EXPECT_EQ(named(all, "desc").at(0).attributes.at("id"), "p-desc");
  EXPECT_EQ(named(all, "desc").at(0).text, "it's &quot;split&quot;");
  const auto bare =
      Xml(to_svg(list, plain_theme(), true, 16, 9, {"T", "", "p-", false})).elements();
  EXPECT_EQ(bare.at(0).attributes.at("aria-labelledby"), "p-title");
  EXPECT_TRUE(named(bare, "desc").empty());
}

TEST(Svg, LettersMayBeTextThatHoldsItsWidth) {
  const DrawList list = page_of(
      160, 90, {text("a < b", 80, 20, 10, Role::ink, 0.5, Weight::semibold, Role::warning)});
  const std::string svg = to_svg(list, plain_theme(), true, 16, 9, {"", "", "", true});
  const auto all = Xml(svg).elements();
  EXPECT_TRUE(named(all, "use").empty());
  EXPECT_TRUE(named(all, "path").empty());
  const auto texts = named(all, "text");
  ASSERT_EQ(texts.size(), 2u) << "the halo below, then the letters";
  EXPECT_EQ(texts[0].attributes.at("stroke"), "#ff0000");
  EXPECT_EQ(texts[0].attributes.at("aria-hidden"), "true") << "it is read once";
  const auto& letters = texts[1].attributes;
  EXPECT_EQ(texts[1].text, "a &lt; b");
  EXPECT_EQ(all.at(0).attributes.at("font-family"), "Inter, sans-serif");
  EXPECT_EQ(letters.at("font-weight"), "600");
  const double width = text_width("a < b", 10, Weight::semibold);
  EXPECT_NEAR(std::stod(letters.at("textLength")), width, 1e-3);
  EXPECT_NEAR(std::stod(letters.at("x")), 80 - width / 2, 1e-3);
}

TEST(Svg, RefusesWhatIsNotFinite) {
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_THROW(
      to_svg(page_of(16, 9, {rect(0, 0, infinite, 1, Role::ink)}), plain_theme(), false, 16, 9),
      Refused);
  EXPECT_THROW(to_svg(page_of(16, 9, {}), plain_theme(), false, 0, 9), Refused);
}

std::string graphics_libraries_in_memory() {
  std::ifstream maps("/proc/self/maps");
  std::string found;
  for (std::string map; std::getline(maps, map);)
    for (const char* library : {"libOSMesa", "libEGL", "libGL", "libLLVM", "libcairo", "_dri.so"})
      if (map.find(library) != std::string::npos) found += map + '\n';
  return found;
}

TEST(DISABLED_Child, WritesAnSvg) {
  to_svg(sample_scene(), *theme_named("light"), false, 1600, 900);
  EXPECT_EQ(graphics_libraries_in_memory(), "");
  Context::create(Backend::automatic);
  EXPECT_NE(graphics_libraries_in_memory(), "") << "this test would not see a library";
}

TEST(Svg, LoadsNoGraphicsLibrary) {
  EXPECT_EQ(run_in_new_process("DISABLED_Child.WritesAnSvg", {}), 0);
}

}  // namespace
}  // namespace lantern::render
