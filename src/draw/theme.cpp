#include "draw/theme.hpp"

#include <cmath>

namespace lantern {
namespace {

using Hues = std::array<std::uint32_t, 8>;

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

struct Palette {
  std::string_view name;
  std::uint32_t paper, panel, ink, quiet_ink, rule;
  std::array<std::uint32_t, 4> cell_lines;
  std::uint32_t lit, lit_ink, lit_fill, passed_fill;
  Hues bodies;
  std::uint32_t body_line, eye, pupil;
  std::uint32_t pair, rejected_pair, static_body, asleep, contact, ray, frustum, warning;
  std::uint32_t free_space;
  Hues body_marks;
  std::uint32_t view_fill;
  std::array<std::uint32_t, 4> sectors;
};

constexpr Theme theme_of(const Palette& p) {
  Theme theme{p.name, {}};
  const auto set = [&](Role role, std::uint32_t hex) {
    theme.colors[static_cast<std::size_t>(role)] = rgb(hex);
  };
  set(Role::none, p.paper);
  set(Role::paper, p.paper);
  set(Role::panel, p.panel);
  set(Role::ink, p.ink);
  set(Role::quiet_ink, p.quiet_ink);
  set(Role::rule, p.rule);
  for (std::uint32_t depth = 0; depth < 4; ++depth) set(cell_line_role(depth), p.cell_lines[depth]);
  set(Role::lit, p.lit);
  set(Role::lit_ink, p.lit_ink);
  set(Role::lit_fill, p.lit_fill);
  set(Role::passed_fill, p.passed_fill);
  for (int color = 1; color <= 8; ++color) {
    set(body_role(color), p.bodies[color - 1]);
    set(body_mark_role(color), p.body_marks[color - 1]);
  }
  set(Role::body_line, p.body_line);
  set(Role::eye, p.eye);
  set(Role::pupil, p.pupil);
  set(Role::pair, p.pair);
  set(Role::rejected_pair, p.rejected_pair);
  set(Role::static_body, p.static_body);
  set(Role::asleep, p.asleep);
  set(Role::contact, p.contact);
  set(Role::ray, p.ray);
  set(Role::frustum, p.frustum);
  set(Role::warning, p.warning);
  set(Role::free_space, p.free_space);
  set(Role::view_fill, p.view_fill);
  for (unsigned tone = 0; tone < kSectorTones; ++tone) set(sector_role(tone), p.sectors[tone]);
  const auto mix = [&](Role role, Role from, const Color& to, double part) {
    const Color a = theme.colors[static_cast<std::size_t>(from)];
    theme.colors[static_cast<std::size_t>(role)] = mixed(a, to, part);
  };
  const auto shade = [&](Role role) {
    mix(in_tone(role, Tone::lit), role, {255, 255, 255}, 0.38);
    mix(in_tone(role, Tone::shade), role, {0, 0, 0}, 0.36);
  };
  for (int color = 1; color <= 8; ++color) shade(body_role(color));
  shade(Role::static_body);
  shade(Role::asleep);
  return theme;
}

// The hues start from Okabe and Ito, "Color Universal Design" (2008): vermilion, reddish purple,
// yellow, blue, bluish green, sky blue, orange; the violet is ours. They are moved until every two
// stay apart for protan, deutan and tritan eyes (tests/draw/theme_test.cpp).
constexpr Palette kLight{
    .name = "light",
    .paper = 0xfdfcf9,
    .panel = 0xffffff,
    .ink = 0x161b26,
    .quiet_ink = 0x5b6577,
    .rule = 0xdedfe2,
    .cell_lines = {0x2f3d57, 0x46546e, 0x76839a, 0x9aa6b8},
    .lit = 0xbf7a00,
    .lit_ink = 0x8a5800,
    .lit_fill = 0xfff0c2,
    .passed_fill = 0xfffaeb,
    .bodies = {0xd2491a, 0xd083b0, 0xf6e03a, 0x0f6cba, 0x17995f, 0x66c4f8, 0xe8940a, 0x4a1a8e},
    .body_line = 0x161b26,
    .eye = 0xffffff,
    .pupil = 0x161b26,
    .pair = 0xc2185b,
    .rejected_pair = 0x76839a,
    .static_body = 0xc5ccd6,
    .asleep = 0xaab3c0,
    .contact = 0xb3261e,
    .ray = 0x0b7285,
    .frustum = 0x5f3dc4,
    .warning = 0xb3261e,
    .free_space = 0xf3f2ee,
    .body_marks = {0xa83510, 0xb25f92, 0xcdb716, 0x08508e, 0x0c7546, 0x38a3df, 0xbd7400, 0x6b3cb4},
    .view_fill = 0xf1ecfd,
    .sectors = {0xeaf2f8, 0xf6efe4, 0xeaf4ea, 0xf5eaf1},
};

constexpr Palette kDark{
    .name = "dark",
    .paper = 0x11141b,
    .panel = 0x191d26,
    .ink = 0xf3f5f9,
    .quiet_ink = 0x9da7b8,
    .rule = 0x2b303b,
    .cell_lines = {0xb9c3d6, 0x97a3b8, 0x6c788d, 0x505b6e},
    .lit = 0xf0b030,
    .lit_ink = 0xf7c14d,
    .lit_fill = 0x3c3114,
    .passed_fill = 0x262317,
    .bodies = {0xe8643c, 0xd79abe, 0xfae340, 0x3c86cc, 0x3cc78a, 0xa6d0fc, 0xe6960f, 0x8a5ff2},
    .body_line = 0xf7f8fb,
    .eye = 0xffffff,
    .pupil = 0x11141b,
    .pair = 0xff7bac,
    .rejected_pair = 0x7d889b,
    .static_body = 0x4a5364,
    .asleep = 0x5d6778,
    .contact = 0xff8a70,
    .ray = 0x66d9e8,
    .frustum = 0xb197fc,
    .warning = 0xff8a70,
    .free_space = 0x151922,
    .body_marks = {0xb8431f, 0xb56f99, 0xd2b71c, 0x2668a6, 0x229a66, 0x74aee8, 0xb87406, 0x6a40cc},
    .view_fill = 0x262038,
    .sectors = {0x1b2936, 0x2e2719, 0x1b2c22, 0x2c1f2c},
};

// Greys only. Neighbouring bodies differ in lightness, and each carries its own emblem, dark on the
// light ones and light on the dark ones, so that a photocopy can still be read.
constexpr Palette kPrint{
    .name = "print",
    .paper = 0xffffff,
    .panel = 0xffffff,
    .ink = 0x000000,
    .quiet_ink = 0x505050,
    .rule = 0xc8c8c8,
    .cell_lines = {0x202020, 0x404040, 0x707070, 0x989898},
    .lit = 0x000000,
    .lit_ink = 0x000000,
    .lit_fill = 0xd9d9d9,
    .passed_fill = 0xf2f2f2,
    .bodies = {0x636363, 0xc0c0c0, 0xf4f4f4, 0x464646, 0x828282, 0xdadada, 0xa1a1a1, 0x2a2a2a},
    .body_line = 0x000000,
    .eye = 0xffffff,
    .pupil = 0x000000,
    .pair = 0x000000,
    .rejected_pair = 0x808080,
    .static_body = 0xcfcfcf,
    .asleep = 0xe4e4e4,
    .contact = 0x000000,
    .ray = 0x303030,
    .frustum = 0x505050,
    .warning = 0x000000,
    .free_space = 0xfafafa,
    .body_marks = {0xf0f0f0, 0x303030, 0x606060, 0xe8e8e8, 0xffffff, 0x404040, 0x101010, 0xd0d0d0},
    .view_fill = 0xededed,
    .sectors = {0xffffff, 0xe6e6e6, 0xf4f4f4, 0xdcdcdc},
};

constexpr std::array<Theme, 3> kThemes{theme_of(kLight), theme_of(kDark), theme_of(kPrint)};

}  // namespace

std::span<const Theme> themes() { return kThemes; }

std::optional<Theme> theme_named(std::string_view name) {
  for (const Theme& theme : kThemes)
    if (theme.name == name) return theme;
  return std::nullopt;
}

}  // namespace lantern
