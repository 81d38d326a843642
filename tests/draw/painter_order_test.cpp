#include <cmath>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "draw/world/world3d_parts.hpp"

namespace lantern::draw {
namespace {

const Box<3> kWorld{{-5, -5, -5}, {5, 5, 5}};
const Box<2> kOrderPanel{{0, 0}, {800, 600}};

Vec<3> random_point(Random& random, double reach) {
  Vec<3> p;
  for (int i = 0; i < 3; ++i) p[i] = random.between(-reach, reach);
  return p;
}

Convex random_piece(Random& random, double reach) {
  Convex c;
  c.center = random_point(random, reach);
  c.axes = matrix(turned(Rotation<3>{}, random_point(random, 2)));
  const auto kind = random.whole(0, 2);
  if (kind == 0)
    for (int i = 0; i < 3; ++i) c.half[i] = random.between(0.1, 1.2);
  else
    c.radius = random.between(0.2, 0.9);
  if (kind == 2) c.half.y = random.between(0.1, 1.0);
  return c;
}

Vec<3> random_point_in(const Convex& c, Random& random) {
  Vec<3> p = c.center;
  for (int i = 0; i < 3; ++i) p += c.axes[i] * (c.half[i] * random.between(-1, 1));
  return p + random_point(random, 0.5) * c.radius;
}

// Far enough apart that no sampled sight line finds them to meet.
bool apart(const Convex& a, const Convex& b) {
  Random random(1);
  for (int i = 0; i < 60; ++i) {
    const Vec<3> from = random_point_in(a, random), to = random_point_in(a, random);
    if (inside_of(b, from, from + (to - from) * 1.0001)) return false;
  }
  const auto reach = [](const Convex& c) { return glm::length(c.half) + c.radius; };
  return glm::length(a.center - b.center) > 0.75 * (reach(a) + reach(b));
}

// Which of the two a sight line meets first: -1 a, 1 b, 0 not both.
int first_met(const Convex& a, const Convex& b, const Vec<3>& eye, const Vec<3>& towards) {
  const Vec<3> end = eye + (towards - eye) * 4.0;
  const auto in_a = inside_of(a, eye, end), in_b = inside_of(b, eye, end);
  if (!in_a || !in_b) return 0;
  if (in_a->second <= in_b->first) return -1;
  return in_b->second <= in_a->first ? 1 : 0;
}

TEST(PainterOrder, WhatASightLineMeetsFirstIsNearer) {
  Random random(3);
  int compared = 0;
  for (int round = 0; round < 1500; ++round) {
    const Convex a = random_piece(random, 3), b = random_piece(random, 3);
    if (!apart(a, b)) continue;
    const Vec<3> eye = glm::normalize(random_point(random, 1)) * 12.0;
    for (int i = 0; i < 12; ++i) {
      const int first = first_met(a, b, eye, random_point_in(i % 2 == 0 ? a : b, random));
      if (first == 0) continue;
      ++compared;
      EXPECT_EQ(nearer(a, b, eye), first < 0) << "round " << round;
      EXPECT_EQ(nearer(b, a, eye), first > 0) << "round " << round << ", asked the other way";
    }
  }
  EXPECT_GT(compared, 300) << "too few sight lines met both: the test says nothing";
}

TEST(PainterOrder, TouchingBoxesOfATowerAreOrdered) {
  Convex lower, upper;
  lower.half = upper.half = {1, 0.5, 1};
  upper.center.y = 1 - 1e-4;  // resting, a little in it
  EXPECT_TRUE(nearer(upper, lower, {3, 9, 3})) << "from above the upper box covers the lower";
  EXPECT_TRUE(nearer(lower, upper, {3, -9, 3})) << "from below the lower covers the upper";
}

TEST(PainterOrder, APartInsideIsWhereSamplesAreInside) {
  Random random(4);
  int met = 0;
  for (int round = 0; round < 400; ++round) {
    const Convex c = random_piece(random, 1);
    const Vec<3> a = random_point(random, 3), b = random_point(random, 3);
    const auto part = inside_of(c, a, b);
    met += part.has_value();
    for (int i = 0; i <= 40; ++i) {
      const double t = i / 40.0;
      const Vec<3> p = a + (b - a) * t;
      Vec<3> nearest = c.center;
      for (int k = 0; k < 3; ++k)
        nearest += c.axes[k] * std::clamp(glm::dot(p - c.center, c.axes[k]), -c.half[k], c.half[k]);
      const double out = glm::length(p - nearest) - c.radius;
      if (std::abs(out) < 1e-6) continue;
      const bool said = part && part->first <= t && t <= part->second;
      EXPECT_EQ(said, out < 0) << "round " << round << ", at " << t;
    }
  }
  EXPECT_GT(met, 30);
}

TEST(PainterOrder, APartInsideAnOutline) {
  const Outline square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  const auto part = inside_of(square, {-2, 1}, {6, 1});
  ASSERT_TRUE(part);
  EXPECT_DOUBLE_EQ(part->first, 0.25);
  EXPECT_DOUBLE_EQ(part->second, 0.5);
  EXPECT_FALSE(inside_of(square, {-2, 3}, {6, 3}));
  EXPECT_FALSE(inside_of(square, {3, -2}, {3, 6}));
}

// A piece whose one shape says by its width which it is.
Piece numbered(const Convex& c, std::size_t number, const View3D& view) {
  Piece piece;
  piece.space = c;
  std::vector<Vec<2>> points;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vec<3> p = c.center;
    for (int i = 0; i < 3; ++i)
      p += c.axes[i] * ((c.half[i] + c.radius) * ((corner >> i & 1u) != 0 ? 1 : -1));
    points.push_back(view.to_page(p));
  }
  piece.outline = hull_of(points);
  piece.shapes.emplace_back(LineShape{{0, 0}, {1, 1}, {Role::ink, double(number), 0}, false});
  return piece;
}

std::vector<std::size_t> painted_order(std::vector<Piece> pieces, const View3D& view) {
  DrawList list;
  paint(std::move(pieces), view, list);
  std::vector<std::size_t> order;
  for (const DrawShape& shape : list.shapes)
    order.push_back(static_cast<std::size_t>(std::get<LineShape>(shape).stroke.width));
  return order;
}

TEST(PainterOrder, TheNearestIsPaintedLastOnEverySightLine) {
  Random random(6);
  int crossings = 0;
  for (int scene = 0; scene < 20; ++scene) {
    std::vector<Convex> solids;
    for (int tries = 0; tries < 300 && solids.size() < 25; ++tries) {
      const Convex c = random_piece(random, 4.5);
      if (std::all_of(solids.begin(), solids.end(),
                      [&](const Convex& other) { return apart(c, other) && apart(other, c); }))
        solids.push_back(c);
    }
    const Vec<3> eye = glm::normalize(random_point(random, 1)) * 25.0;
    const View3D view(kWorld, Camera{eye, {0, 0, 0}, 0.7}, kOrderPanel);
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < solids.size(); ++i) pieces.push_back(numbered(solids[i], i, view));
    const std::vector<std::size_t> order = painted_order(std::move(pieces), view);
    ASSERT_EQ(order.size(), solids.size()) << "each piece is painted once";
    std::vector<std::size_t> place(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = i;
    for (std::size_t a = 0; a < solids.size(); ++a)
      for (std::size_t b = 0; b < solids.size(); ++b)
        for (int i = 0; i < 3 && a != b; ++i) {
          const int first =
              first_met(solids[a], solids[b], eye, random_point_in(solids[a], random));
          if (first == 0) continue;
          ++crossings;
          EXPECT_EQ(place[a] > place[b], first < 0)
              << "scene " << scene << ": a farther solid is painted over a nearer one";
        }
  }
  EXPECT_GT(crossings, 300);
}

// Three bars that cover each other in turn have no order; each must still be painted, once.
TEST(PainterOrder, ARingIsBroken) {
  const View3D view(kWorld, Camera{{0, 0, 30}, {0, 0, 0}, 0.7}, kOrderPanel);
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < 3; ++i) {
    const double turn = 2.0943951023931953 * static_cast<double>(i);
    Convex bar;
    bar.axes = matrix(turned(turned(Rotation<3>{}, Vec<3>(0, 0.35, 0)), Vec<3>(0, 0, turn)));
    bar.half = {4, 0.3, 0.05};
    bar.center = Vec<3>(std::sin(turn), -std::cos(turn), 0) * 1.2;
    pieces.push_back(numbered(bar, i, view));
  }
  std::vector<std::size_t> order = painted_order(pieces, view);
  EXPECT_EQ(order, painted_order(pieces, view)) << "the same ring, broken at another place";
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2}));
}

TEST(PainterOrder, ALineIsThinnerBeforeABody) {
  const View3D view(kWorld, Camera{{0, 0, 30}, {0, 0, 0}, 0.7}, kOrderPanel);
  Convex body;
  body.half = {1, 1, 1};
  Piece edge;
  edge.space = Convex::line({-4, 0, 3}, {4, 0, 3});
  const auto page = view.segment({-4, 0, 3}, {4, 0, 3});
  edge.outline = {page->first, page->second};
  edge.is_line = edge.yields = true;
  edge.shapes.emplace_back(LineShape{page->first, page->second, {Role::lit, 8, 0}, false});
  DrawList list;
  paint({edge, numbered(body, 99, view)}, view, list);
  std::vector<double> widths;
  for (const DrawShape& shape : list.shapes)
    widths.push_back(std::get<LineShape>(shape).stroke.width);
  EXPECT_EQ(widths, (std::vector<double>{99, 8, 4, 8})) << "the body, then the edge in parts";
}

}  // namespace
}  // namespace lantern::draw
