// How far two images, or two files of facts, are apart.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "render/image.hpp"

namespace lantern::render {

struct Comparison {
  bool same_size = false;
  std::uint64_t differing = 0;  // pixels that differ by more than the tolerance
  int largest = 0;              // greatest difference of one channel, 0 ... 255
  std::string sizes = {};       // "640 x 360 pixels, found 320 x 180"; empty if they are the same
};

// How far images may be apart that pass for equal.
struct Allowance {
  int tolerance = 0;    // levels by which a channel may differ, 0 ... 255
  double fraction = 0;  // of the pixels that may differ by more, 0 ... 1
};

// `tolerance` is the greatest difference of a channel that still counts as equal.
Comparison compare(const Image& expected, const Image& actual, int tolerance);

// Of the same size, and no more pixels differ than the allowance's fraction of `expected`.
bool passes(const Comparison& comparison, const Image& expected, const Allowance& allowance);

// "812 pixels differ, at most by 90 levels", or "expected 640 x 360 pixels, found 320 x 180".
std::string finding(const Comparison& comparison);

// Of the size and the pixels, as 16 hexadecimal digits: the same however a file packs them.
std::string pixel_hash(const Image& image);

// The differing pixels marked on the paled expected image.
Image marked_picture(const Image& expected, const Image& actual, int tolerance);

// Expected, actual and the marked picture side by side. Images of different sizes are laid over
// each other from the upper left corner.
Image difference_picture(const Image& expected, const Image& actual, int tolerance);

struct FactsDifference {
  std::string path;              // "counts.pairs", "bodies[ann].position[0]"
  std::string expected, actual;  // as JSON, long ones shortened; "nothing" where there is none
};

struct FactsComparison {
  std::vector<FactsDifference> differences;  // the first kMost; what tells most comes first
  std::size_t total = 0;                     // how many there are
  static constexpr std::size_t kMost = 50;
};

// Counts come first, then measures, then the rest in the order of the file; what follows from the
// rest (hash, since_last_frame) last. What a file was made from is no fact. Elements with a name or
// an id are compared with those of the same; other lists by place, if they are as long. Facts of
// another format differ in nothing else. Nothing if one of the texts is no JSON object, or one that
// is nested more than 64 deep.
std::optional<FactsComparison> compare_facts(std::string_view expected, std::string_view actual);

// Is it a JSON object that compare_facts() takes?
bool are_facts(std::string_view text);

// "counts.pairs: expected 3, found 4, and 5 more"; there must be a difference.
std::string finding(const FactsComparison& comparison);

}  // namespace lantern::render
