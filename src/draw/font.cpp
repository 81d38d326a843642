#include "draw/font.hpp"

#include <array>
#include <atomic>
#include <charconv>
#include <mutex>
#include <optional>

#include <fmt/format.h>

#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>

#include "base/check.hpp"
#include "base/printable.hpp"
#include "embedded/font.hpp"

namespace lantern::draw {
namespace {

constexpr int kReplacement = 0xfffd;

std::atomic<std::uint64_t> faces{0};

// Where the tables of a weight's file are: enough to ask which letters it has.
stbtt_fontinfo tables_in(std::string_view file) {
  stbtt_fontinfo info{};
  LANTERN_CHECK(stbtt_InitFont(&info, reinterpret_cast<const unsigned char*>(file.data()), 0), !=,
                0);
  return info;
}
stbtt_fontinfo tables_of(Weight weight) { return tables_in(font_file(weight)); }

// One weight, measured and kerned. Immutable once made, so every thread may use it.
struct FontFace {
  explicit FontFace(const stbtt_fontinfo& tables) : info(tables) {
    ++faces;
    em_per_unit = static_cast<double>(stbtt_ScaleForMappingEmToPixels(&info, 1.0f));
    for (int c = 0; c < kAscii; ++c) ascii_[c] = stbtt_FindGlyphIndex(&info, c);
    for (int a = 0; a < kAscii; ++a)
      for (int b = 0; b < kAscii; ++b)
        kern_[a * kAscii + b] = stbtt_GetGlyphKernAdvance(&info, ascii_[a], ascii_[b]);
    advances_.resize(info.numGlyphs);
    for (int g = 0; g < info.numGlyphs; ++g)
      stbtt_GetGlyphHMetrics(&info, g, &advances_[g], nullptr);
    int top = 0;
    stbtt_GetGlyphBox(&info, ascii_['H'], nullptr, nullptr, nullptr, &top);
    cap_height = top * em_per_unit;
  }

  int glyph(int codepoint) const {
    return codepoint < kAscii ? ascii_[codepoint] : stbtt_FindGlyphIndex(&info, codepoint);
  }
  // Space from the origin of `a` to that of `b` after it, in ems.
  double advance(int a, int glyph_a, int b, int glyph_b) const {
    const int kern = a < kAscii && b < kAscii ? kern_[a * kAscii + b]
                                              : stbtt_GetGlyphKernAdvance(&info, glyph_a, glyph_b);
    return (advances_[glyph_a] + kern) * em_per_unit;
  }
  double advance(int glyph) const { return advances_[glyph] * em_per_unit; }

  static constexpr int kAscii = 128;
  stbtt_fontinfo info;
  double em_per_unit = 0, cap_height = 0;
  std::array<int, kAscii> ascii_{};
  std::array<int, kAscii * kAscii> kern_{};  // of pairs of characters, font units
  std::vector<int> advances_;                // of glyphs, font units
};

std::string (*more_letters)() = nullptr;

// The typeface that has more letters; null if there is none.
const FontFace* more_face() {
  static const std::string file = more_letters ? more_letters() : "";
  static const std::optional<FontFace> made =
      file.empty() ? std::nullopt : std::optional<FontFace>(tables_in(file));
  return made ? &*made : nullptr;
}

const FontFace& face(Weight weight) {
  static std::array<std::once_flag, kWeights.size()> once;
  static std::array<std::optional<FontFace>, kWeights.size()> made;
  const auto i = static_cast<std::size_t>(weight);
  std::call_once(once[i], [&] { made[i].emplace(tables_of(weight)); });
  return *made[i];
}

// The code point at `at`, which moves behind it. A malformed byte gives U+FFFD and is one byte
// long.
int next_codepoint(std::string_view text, std::size_t& at) {
  const auto [bytes, code] = first_letter(text.substr(at));
  at += bytes;
  return !code ? kReplacement : *code < ' ' ? ' ' : static_cast<int>(*code);
}

// A glyph of the other typeface has a number behind all of the bundled one's.
bool is_of(const FontFace& f, int glyph) { return glyph < f.info.numGlyphs; }
int glyph_of(const FontFace& f, int code) {
  const int own = f.glyph(code);
  if (own != 0 || code <= ' ') return own;
  const FontFace* more = more_face();
  const int other = more ? more->glyph(code) : 0;
  return other == 0 ? 0 : f.info.numGlyphs + other;
}
double advance_of(const FontFace& f, int glyph) {
  return is_of(f, glyph) ? f.advance(glyph) : more_face()->advance(glyph - f.info.numGlyphs);
}
// The face that has the glyph, and its number there.
std::pair<const FontFace&, int> found_in(const FontFace& f, int glyph) {
  if (is_of(f, glyph)) return {f, glyph};
  return {*more_face(), glyph - f.info.numGlyphs};
}

// Calls place(glyph, x in ems, letter) for each glyph; gives the width of the line in ems.
double walk(std::string_view text, Weight weight, const auto& place) {
  const FontFace& f = face(weight);
  double x = 0;
  int last = -1, last_glyph = 0;
  for (std::size_t at = 0; at < text.size();) {
    const int code = next_codepoint(text, at);
    const int glyph = glyph_of(f, code);
    if (last >= 0)
      x += is_of(f, last_glyph) && is_of(f, glyph) ? f.advance(last, last_glyph, code, glyph)
                                                   : advance_of(f, last_glyph);
    place(glyph, x, code);
    last = code;
    last_glyph = glyph;
  }
  return last < 0 ? 0.0 : x + advance_of(f, last_glyph);
}

}  // namespace

void set_more_letters(std::string (*file)()) { more_letters = file; }

std::string_view font_file(Weight weight) {
  static constexpr std::array files = {&font::inter_regular_otf, &font::inter_semibold_otf,
                                       &font::inconsolata_otf};
  return *files[static_cast<std::size_t>(weight)];
}

std::uint64_t faces_made() { return faces; }

bool has_glyph(char32_t letter) {
  static const stbtt_fontinfo tables = tables_of(Weight::regular);
  // Control characters are drawn as blanks.
  if (letter < ' ' || stbtt_FindGlyphIndex(&tables, static_cast<int>(letter)) != 0) return true;
  const FontFace* more = more_face();
  return more && more->glyph(static_cast<int>(letter)) != 0;
}

double text_width(std::string_view text, double size, Weight weight) {
  return size * walk(text, weight, [](int, double, int) {});
}

double cap_height(Weight weight) { return face(weight).cap_height; }

std::vector<PlacedGlyph> shape_text(std::string_view text, double size, Weight weight) {
  std::vector<PlacedGlyph> glyphs;
  glyphs.reserve(text.size());
  walk(text, weight, [&](int glyph, double x, int letter) {
    glyphs.push_back({glyph, x * size, static_cast<char32_t>(letter)});
  });
  return glyphs;
}

GlyphBitmap rasterise_glyph(int of_weight, Weight weight, double pixels, double shift) {
  const auto [f, glyph] = found_in(face(weight), of_weight);
  const stbtt_fontinfo* info = &f.info;
  const float scale = stbtt_ScaleForMappingEmToPixels(info, static_cast<float>(pixels));
  GlyphBitmap bitmap;
  unsigned char* coverage =
      stbtt_GetGlyphBitmapSubpixel(info, scale, scale, static_cast<float>(shift), 0.0f, glyph,
                                   &bitmap.width, &bitmap.height, &bitmap.left, &bitmap.top);
  if (!coverage) return {};  // a space
  bitmap.coverage.assign(coverage, coverage + bitmap.width * bitmap.height);
  stbtt_FreeBitmap(coverage, nullptr);
  return bitmap;
}

std::vector<PathStep> glyph_path(int of_weight, Weight weight) {
  const auto found = found_in(face(weight), of_weight);
  const FontFace& f = found.first;
  const int glyph = found.second;
  stbtt_vertex* vertices = nullptr;
  const int count = stbtt_GetGlyphShape(&f.info, glyph, &vertices);
  std::vector<PathStep> path;
  const auto in_ems = [&](int units) {
    double ems = 0;  // of five digits: nobody sees more
    const std::string digits = fmt::format("{:.5g}", units == 0 ? 0.0 : units * f.em_per_unit);
    std::from_chars(digits.data(), digits.data() + digits.size(), ems);
    return ems;
  };
  const auto point = [&](int x, int y) { path.back().points.push_back({in_ems(x), in_ems(-y)}); };
  for (int i = 0; i < count; ++i) {
    const stbtt_vertex& v = vertices[i];
    const bool moves = v.type == STBTT_vmove, is_cubic = v.type == STBTT_vcubic;
    if (moves && !path.empty()) path.emplace_back();
    path.push_back({moves ? 'M' : v.type == STBTT_vline ? 'L' : is_cubic ? 'C' : 'Q'});
    if (v.type == STBTT_vcurve || is_cubic) point(v.cx, v.cy);
    if (is_cubic) point(v.cx1, v.cy1);
    point(v.x, v.y);
  }
  stbtt_FreeShape(&f.info, vertices);
  if (!path.empty()) path.emplace_back();
  return path;
}

}  // namespace lantern::draw
