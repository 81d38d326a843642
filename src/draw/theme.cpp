#include "draw/theme.hpp"

namespace lantern::draw {
namespace {

constexpr Color rgb(std::uint32_t hex) {
  return {static_cast<std::uint8_t>(hex >> 16), static_cast<std::uint8_t>(hex >> 8 & 0xff),
          static_cast<std::uint8_t>(hex & 0xff)};
}

// `part` of `b` in `a`.
constexpr Color mixed(const Color& a, const Color& b, double part) {
  const auto mix = [&](int x, int y) {
    return static_cast<std::uint8_t>(x + (y - x) * part + 0.5);
  };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

// A role's colour in each theme.
struct Colors {
  Role role;
  std::uint32_t light, dark, print;
};

// The hues of bodies start from Okabe and Ito, "Color Universal Design" (2008): vermilion, reddish
// purple, yellow, blue, bluish green, sky blue, orange; the violet is ours. They are moved until
// every two stay apart for protan, deutan and tritan eyes (tests/draw/theme_test.cpp).
//
// Print has greys only. Neighbouring bodies differ in lightness, and each carries its own emblem,
// dark on the light ones and light on the dark ones, so that a photocopy can still be read.
//
// Grounds differ by 1.5 : 1 in luminance, or by a mark, so that a projector keeps them apart
// (tests/draw/states_test.cpp).
constexpr Colors kColors[] = {
    {Role::none, 0xfdfcf9, 0x11141b, 0xffffff},
    {Role::paper, 0xfdfcf9, 0x11141b, 0xffffff},
    {Role::panel, language::kLightGround, language::kDarkGround, 0xffffff},
    {Role::ink, 0x161b26, 0xf3f5f9, 0x000000},
    {Role::quiet_ink, 0x495364, 0xa4aec0, 0x505050},
    {Role::rule, 0xdedfe2, 0x2b303b, 0xc8c8c8},
    {Role::cell_line_0, 0x2f3d57, 0xb9c3d6, 0x202020},
    {Role::cell_line_1, 0x46546e, 0x97a3b8, 0x404040},
    {Role::cell_line_2, 0x76839a, 0x6c788d, 0x707070},
    {Role::cell_line_3, 0x8e9aad, 0x505b6e, 0x989898},
    {Role::lit, 0xa86a00, 0xf0b030, 0x000000},
    {Role::lit_ink, 0x6e4600, 0xf7c14d, 0x000000},
    {Role::lit_fill, 0xefce90, 0x503e12, 0xd2d2d2},
    {Role::passed_fill, 0xfff4d6, 0x332b16, 0xf3f3f3},
    {body_role(1), 0xd2491a, 0xe8643c, 0x636363},
    {body_role(2), 0xd083b0, 0xd79abe, 0xc0c0c0},
    {body_role(3), 0xf6e03a, 0xfae340, 0xf4f4f4},
    {body_role(4), 0x0f6cba, 0x3c86cc, 0x464646},
    {body_role(5), 0x17995f, 0x3cc78a, 0x828282},
    {body_role(6), 0x66c4f8, 0xa6d0fc, 0xdadada},
    {body_role(7), 0xe8940a, 0xe6960f, 0xa1a1a1},
    {body_role(8), 0x4a1a8e, 0x8a5ff2, 0x2a2a2a},
    {Role::body_line, 0x161b26, 0xf7f8fb, 0x000000},
    {Role::eye, 0xffffff, 0xffffff, 0xffffff},
    {Role::pupil, 0x161b26, 0x11141b, 0x000000},
    {Role::pair, 0xc2185b, 0xff7bac, 0x000000},
    {Role::rejected_pair, 0x76839a, 0x7d889b, 0x808080},
    {Role::faint_pair, 0xe2a0bc, 0x7a4459, 0xa8a8a8},
    {Role::static_body, 0xc5ccd6, 0x4a5364, 0xcfcfcf},
    {Role::asleep, 0xaab3c0, 0x5d6778, 0xe4e4e4},
    {Role::contact, 0xb3261e, 0xff8a70, 0x000000},
    {Role::ray, 0x0b7285, 0x66d9e8, 0x303030},
    {Role::frustum, 0x5f3dc4, 0xb197fc, 0x505050},
    {Role::warning, 0xb3261e, 0xff8a70, 0x000000},
    {Role::free_space, 0xc5c7ca, 0x3a3f4b, 0xc7c7c7},
    {body_mark_role(1), 0xa83510, 0xb8431f, 0xf0f0f0},
    {body_mark_role(2), 0xb25f92, 0xb56f99, 0x303030},
    {body_mark_role(3), 0xcdb716, 0xd2b71c, 0x606060},
    {body_mark_role(4), 0x08508e, 0x2668a6, 0xe8e8e8},
    {body_mark_role(5), 0x0c7546, 0x229a66, 0xffffff},
    {body_mark_role(6), 0x38a3df, 0x74aee8, 0x404040},
    {body_mark_role(7), 0xbd7400, 0xb87406, 0x101010},
    {body_mark_role(8), 0x6b3cb4, 0x6a40cc, 0xd0d0d0},
    {Role::view_fill, 0xf1ecfd, 0x262038, 0xededed},
    {sector_role(0), 0xeef5fa, 0x17222c, 0xffffff},
    {sector_role(1), 0xfaf4eb, 0x282117, 0xf5f5f5},
    {sector_role(2), 0xeef7ee, 0x17241b, 0xfafafa},
    {sector_role(3), 0xf9f0f6, 0x291d29, 0xf2f2f2},
};

constexpr Theme theme_of(std::string_view name, std::uint32_t Colors::*column) {
  Theme theme{name, {}};
  const auto color = [&](Role role) -> Color& {
    return theme.colors[static_cast<std::size_t>(role)];
  };
  for (const Colors& row : kColors) color(row.role) = rgb(row.*column);
  const auto shade = [&](Role role) {
    color(in_tone(role, Tone::lit)) = mixed(color(role), {255, 255, 255}, 0.38);
    color(in_tone(role, Tone::shade)) = mixed(color(role), {0, 0, 0}, 0.36);
  };
  for (int body = 1; body <= 8; ++body) shade(body_role(body));
  shade(Role::static_body);
  shade(Role::asleep);
  return theme;
}

constexpr std::array<Theme, 3> kThemes{theme_of("light", &Colors::light),
                                       theme_of("dark", &Colors::dark),
                                       theme_of("print", &Colors::print)};

}  // namespace

// In print as grey; what is drawn on it is of the same hue, darker or lighter.
Theme Theme::with(std::span<const BodyPaint> paints) const {
  constexpr Color kWhite{255, 255, 255}, kBlack{0, 0, 0};
  Theme theme = *this;
  const auto color = [&](Role role) -> Color& {
    return theme.colors[static_cast<std::size_t>(role)];
  };
  for (const BodyPaint& paint : paints) {
    Color own = rgb(paint.rgb);
    const double grey = 0.3 * own.r + 0.59 * own.g + 0.11 * own.b;
    if (name == "print") own = mixed(kBlack, kWhite, grey / 255);
    const Role role = body_role(paint.color);
    color(role) = own;
    color(in_tone(role, Tone::lit)) = mixed(own, kWhite, 0.38);
    color(in_tone(role, Tone::shade)) = mixed(own, kBlack, 0.36);
    color(body_mark_role(paint.color)) = mixed(own, grey > 70 ? kBlack : kWhite, 0.3);
  }
  return theme;
}

std::span<const Theme> themes() { return kThemes; }

std::optional<Theme> theme_named(std::string_view name) {
  for (const Theme& theme : kThemes)
    if (theme.name == name) return theme;
  return std::nullopt;
}

}  // namespace lantern::draw
