#include "render/compare.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/check.hpp"
#include "base/hash.hpp"
#include "base/number.hpp"
#include "base/printable.hpp"

namespace lantern::render {
namespace {

using Pixel = std::array<std::uint8_t, 4>;

// Nothing where the image has none.
std::optional<Pixel> pixel(const Image& image, int x, int y) {
  if (x >= image.width || y >= image.height) return std::nullopt;
  Pixel p{};
  std::copy_n(image.rgba.begin() + 4 * (std::ptrdiff_t{y} * image.width + x), 4, p.begin());
  return p;
}

// A pixel that only one of them has differs as much as can be.
int difference(const std::optional<Pixel>& a, const std::optional<Pixel>& b) {
  if (!a || !b) return a || b ? 255 : 0;
  int largest = 0;
  for (std::size_t c = 0; c < 4; ++c) largest = std::max(largest, std::abs((*a)[c] - (*b)[c]));
  return largest;
}

// Marked in a strong red where the images differ, else the expected pixel, washed out.
Pixel marked(const Pixel& expected, bool differs) {
  if (differs) return {214, 0, 0, 255};
  Pixel paled{0, 0, 0, 255};
  for (std::size_t c = 0; c < 3; ++c) {
    // On white, as a viewer would show it.
    const int shown = (expected[c] * expected[3] + 255 * (255 - expected[3])) / 255;
    paled[c] = static_cast<std::uint8_t>(255 - (255 - shown) / 4);
  }
  return paled;
}

void put(Image& image, int x, int y, const Pixel& p) {
  std::ranges::copy(p, image.rgba.begin() + 4 * (std::ptrdiff_t{y} * image.width + x));
}

std::string size_of(const Image& image) {
  return fmt::format("{} x {}", image.width, image.height);
}

// Transparent.
Image blank(int width, int height) {
  return {width, height, std::vector<std::uint8_t>(std::size_t{4} * width * height)};
}

using Json = nlohmann::ordered_json;

constexpr int kDeepest = 64;
constexpr const char* kNothing = "nothing";

std::optional<Json> object_of(std::string_view text) {
  bool too_deep = false;
  const auto watch = [&](int depth, Json::parse_event_t, Json&) {
    too_deep = too_deep || depth > kDeepest;
    return depth <= kDeepest;
  };
  Json json = Json::parse(text.begin(), text.end(), watch, false);
  if (too_deep || !json.is_object()) return std::nullopt;
  return json;
}

// The letters from `first` on, a byte that starts one; what is left out is dots.
std::string shortened(std::string_view text, std::size_t first) {
  constexpr std::size_t kMostLetters = 60;
  const std::string_view from = text.substr(first);
  std::string_view rest = from;
  for (std::size_t i = 0; i < kMostLetters && !rest.empty(); ++i)
    rest.remove_prefix(first_letter(rest).bytes);
  return fmt::format("{}{}{}", first > 0 ? "… " : "", from.substr(0, from.size() - rest.size()),
                     rest.empty() ? "" : " …");
}

std::string shown(const Json& value) { return shortened(value.dump(), 0); }

// Two long values from shortly before they differ.
std::pair<std::string, std::string> shown(const Json& expected, const Json& actual) {
  constexpr std::size_t kLead = 20, kShort = 40;
  const std::string e = expected.dump(), a = actual.dump();
  const auto differ = static_cast<std::size_t>(std::ranges::mismatch(e, a).in1 - e.begin());
  std::size_t first = differ > kShort ? differ - kLead : 0;
  while (first > 0 && (e[first] & 0xc0) == 0x80) --first;
  return {shortened(e, first), shortened(a, first)};
}

// What an element of a list is called: its name, else its id.
std::optional<std::string> called(const Json& element) {
  if (!element.is_object()) return std::nullopt;
  for (const char* key : {"name", "id"})
    if (const auto it = element.find(key); it != element.end())
      return it->is_string() ? it->get<std::string>() : it->dump();
  return std::nullopt;
}

using Called = std::vector<std::pair<std::string, const Json*>>;

// Nothing unless each has a name of its own.
std::optional<Called> all_called(const Json& list) {
  Called all;
  std::map<std::string, int> seen;
  for (const Json& element : list) {
    const auto name = called(element);
    if (!name || ++seen[*name] > 1) return std::nullopt;
    all.emplace_back(*name, &element);
  }
  return all;
}

class FactsWalk {
 public:
  void objects(const std::string& path, const Json& expected, const Json& actual) {
    const auto below = [&](const std::string& key) {
      return path.empty() ? key : path + "." + key;
    };
    for (const auto& [key, value] : expected.items()) {
      const auto it = actual.find(key);
      if (is_of_the_file(path, key)) continue;
      one(below(key), &value, it == actual.end() ? nullptr : &*it);
    }
    for (const auto& [key, value] : actual.items())
      if (!expected.contains(key) && !is_of_the_file(path, key)) one(below(key), nullptr, &value);
  }

  FactsComparison result() && {
    std::ranges::stable_sort(found_, {}, [](const FactsDifference& d) { return rank(d.path); });
    if (found_.size() > FactsComparison::kMost) found_.resize(FactsComparison::kMost);
    return {std::move(found_), total_};
  }

 private:
  static bool is_of_the_file(const std::string& path, const std::string& key) {
    return path.empty() && (key == "made_from" || key == "checksum");
  }

  static int rank(std::string_view path) {
    const auto has = [&](std::string_view part) { return path.find(part) != path.npos; };
    if (has("counts.")) return 0;
    if (has("measures.")) return 1;
    return path.ends_with("hash") || has("since_last_frame") ? 3 : 2;
  }

  // Either may be missing.
  void one(const std::string& path, const Json* expected, const Json* actual) {
    if (!expected || !actual)
      differ(path, expected ? shown(*expected) : kNothing, actual ? shown(*actual) : kNothing);
    else if (expected->is_object() && actual->is_object())
      objects(path, *expected, *actual);
    else if (expected->is_array() && actual->is_array())
      lists(path, *expected, *actual);
    else if (*expected != *actual)
      std::apply([&](const auto&... values) { differ(path, values...); },
                 shown(*expected, *actual));
  }

  void lists(const std::string& path, const Json& expected, const Json& actual) {
    const auto e = all_called(expected), a = all_called(actual);
    if (e && a) return by_name(path, *e, *a);
    if (expected.size() != actual.size())
      return differ(path, counted(expected.size(), "element"), counted(actual.size(), "element"));
    for (std::size_t i = 0; i < expected.size(); ++i)
      one(fmt::format("{}[{}]", path, i), &expected[i], &actual[i]);
  }

  void by_name(const std::string& path, const Called& expected, const Called& actual) {
    std::map<std::string_view, const Json*> others(actual.begin(), actual.end());
    for (const auto& [name, element] : expected) {
      const auto other = others.find(name);
      one(fmt::format("{}[{}]", path, name), element,
          other == others.end() ? nullptr : other->second);
      if (other != others.end()) others.erase(other);
    }
    for (const auto& [name, element] : actual)
      if (others.contains(name)) one(fmt::format("{}[{}]", path, name), nullptr, element);
  }

  // Of very many, the first of the file are kept, and those that come first in any case.
  void differ(const std::string& path, std::string expected, std::string actual) {
    ++total_;
    if (found_.size() < 20 * FactsComparison::kMost || rank(path) == 0)
      found_.push_back({path, std::move(expected), std::move(actual)});
  }

  std::vector<FactsDifference> found_;
  std::size_t total_ = 0;
};

}  // namespace

Comparison compare(const Image& expected, const Image& actual, int tolerance) {
  Comparison result;
  result.same_size = expected.width == actual.width && expected.height == actual.height;
  if (!result.same_size)
    result.sizes = fmt::format("{} pixels, found {}", size_of(expected), size_of(actual));
  if (result.same_size && expected.rgba == actual.rgba) return result;
  for (int y = 0; y < std::max(expected.height, actual.height); ++y)
    for (int x = 0; x < std::max(expected.width, actual.width); ++x) {
      const int d = difference(pixel(expected, x, y), pixel(actual, x, y));
      result.largest = std::max(result.largest, d);
      result.differing += d > tolerance;
    }
  return result;
}

bool passes(const Comparison& comparison, const Image& expected, const Allowance& allowance) {
  const double most = allowance.fraction * static_cast<double>(expected.width) * expected.height;
  return comparison.same_size && static_cast<double>(comparison.differing) <= most;
}

std::string finding(const Comparison& comparison) {
  if (!comparison.same_size) return fmt::format("expected {}", comparison.sizes);
  return fmt::format("{} {}, at most by {}", counted(comparison.differing, "pixel"),
                     comparison.differing == 1 ? "differs" : "differ",
                     counted(comparison.largest, "level"));
}

std::string pixel_hash(const Image& image) {
  Hash hash;
  hash.add(std::uint64_t(image.width)).add(std::uint64_t(image.height));
  hash.add(std::string_view(reinterpret_cast<const char*>(image.rgba.data()), image.rgba.size()));
  return fmt::format("{:016x}", hash.value());
}

Image marked_picture(const Image& expected, const Image& actual, int tolerance) {
  Image picture =
      blank(std::max(expected.width, actual.width), std::max(expected.height, actual.height));
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const auto e = pixel(expected, x, y), a = pixel(actual, x, y);
      const bool differs = !e || !a || difference(e, a) > tolerance;
      if (e || a) put(picture, x, y, marked(e.value_or(Pixel{}), differs));
    }
  return picture;
}

Image difference_picture(const Image& expected, const Image& actual, int tolerance) {
  const Image third = marked_picture(expected, actual, tolerance);
  const int width = third.width;
  Image picture = blank(3 * width, third.height);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < width; ++x) {
      int left = 0;
      for (const Image* image : {&expected, &actual, &third}) {
        if (const auto p = pixel(*image, x, y)) put(picture, left + x, y, *p);
        left += width;
      }
    }
  return picture;
}

std::optional<FactsComparison> compare_facts(std::string_view expected, std::string_view actual) {
  const auto e = object_of(expected), a = object_of(actual);
  if (!e || !a) return std::nullopt;
  const Json none;
  const Json before = e->value("format", none), now = a->value("format", none);
  if (before != now) return FactsComparison{{{"format", shown(before), shown(now)}}, 1};
  FactsWalk walk;
  walk.objects("", *e, *a);
  return std::move(walk).result();
}

bool are_facts(std::string_view text) { return object_of(text).has_value(); }

std::string finding(const FactsComparison& comparison) {
  LANTERN_CHECK(comparison.differences.empty(), ==, false);
  const FactsDifference& first = comparison.differences.front();
  std::string text =
      fmt::format("{}: expected {}, found {}", first.path, first.expected, first.actual);
  if (comparison.total > 1) text += fmt::format(", and {} more", comparison.total - 1);
  return text;
}

}  // namespace lantern::render
