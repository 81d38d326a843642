#include "render/svg.hpp"

#include <clocale>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "render/renderer.hpp"
#include "render/sample_scene.hpp"
#include "render/support.hpp"

namespace lantern::render {
namespace {

struct Element {
  std::string name;
  std::map<std::string, std::string> attributes;
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
