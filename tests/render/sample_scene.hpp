// A page much like a real frame: a world panel with ghosts, a tree panel, labels, caption,
// counters.
#pragma once

#include <cmath>
#include <string>

#include "draw/draw_list.hpp"

namespace lantern::render {

inline RectShape rect(double x, double y, double w, double h, Role fill, Stroke stroke = {},
                      double radius = 0, bool snapped = false) {
  RectShape s;
  s.box = {{x, y}, {x + w, y + h}};
  s.fill = fill;
  s.stroke = stroke;
  s.radius = radius;
  s.snapped = snapped;
  return s;
}

inline LineShape line(double x0, double y0, double x1, double y1, Stroke stroke,
                      bool snapped = false) {
  LineShape s;
  s.from = {x0, y0};
  s.to = {x1, y1};
  s.stroke = stroke;
  s.snapped = snapped;
  return s;
}

inline TextShape text(std::string words, double x, double y, double size, Role role = Role::ink,
                      double align = 0, Weight weight = Weight::regular, Role halo = Role::none) {
  TextShape s;
  s.text = std::move(words);
  s.at = {x, y};
  s.size = size;
  s.role = role;
  s.align = align;
  s.weight = weight;
  s.halo = halo;
  return s;
}

inline PolygonShape ghost_body(double x, double y, double half, Role fill) {
  PolygonShape s;
  for (int i = 0; i <= 32; ++i) {
    const double a = 3.14159265358979 * (1 + i / 32.0);
    s.points.push_back({x + half * std::cos(a), y + half * (std::sin(a) - 0.1)});
  }
  for (int i = 0; i <= 32; ++i) {
    const double t = i / 32.0;
    s.points.push_back(
        {x + half * (1 - 2 * t), y + half * (0.85 + 0.13 * std::cos(t * 8 * 3.14159265358979))});
  }
  s.fill = fill;
  s.stroke = {Role::body_line, 0.06 * half + 0.6, 0};
  return s;
}

inline void add_ghost(DrawList& list, double x, double y, double half, int color) {
  list.shapes.push_back(ghost_body(x, y, half, body_role(color)));
  for (const double side : {-0.35, 0.35}) {
    const double eye = 0.26 * half, pupil = 0.13 * half, at = x + side * half;
    list.shapes.push_back(rect(at - eye, y - 0.35 * half, 2 * eye, 2 * eye, Role::eye, {}, eye));
    list.shapes.push_back(rect(at - pupil + 0.1 * half, y - 0.2 * half, 2 * pupil, 2 * pupil,
                               Role::pupil, {}, pupil));
  }
}

inline void add_world(DrawList& list, double moved) {
  list.shapes.push_back(rect(60, 104, 620, 620, Role::panel, {Role::cell_line_0, 4, 0}, 0, true));
  for (int i = 0; i < 4; ++i)
    list.shapes.push_back(rect(60 + 155 * (i % 2), 104 + 155 * (i / 2), 155, 155, Role::lit_fill,
                               {Role::lit, 3, 0}, 0, true));
  list.shapes.push_back(line(370, 104, 370, 724, {Role::cell_line_1, 3, 0}, true));
  list.shapes.push_back(line(60, 414, 680, 414, {Role::cell_line_1, 3, 0}, true));
  const double at[4][2] = {{131 + moved, 181}, {296, 184}, {214, 344}, {540, 570 + moved}};
  const char* names[4] = {"blue", "red", "pink", "player"};
  for (int i = 0; i < 4; ++i) {
    const double x = at[i][0], y = at[i][1];
    list.shapes.push_back(
        rect(x - 39, y - 40, 78, 80, Role::none, {Role::quiet_ink, 1.5, 4}, 0, true));
    add_ghost(list, x, y, 35, i + 1);
    list.shapes.push_back(
        text(names[i], x, y + 62, 18, Role::ink, 0.5, Weight::regular, Role::lit_fill));
  }
  for (int i = 0; i < 3; ++i)
    list.shapes.push_back(line(at[i][0], at[i][1], at[i + 1][0], at[i + 1][1],
                               {i == 2 ? Role::rejected_pair : Role::pair, 2, i == 2 ? 5.0 : 0.0}));
}

inline void add_tree(DrawList& list) {
  list.shapes.push_back(rect(1156, 143, 96, 50, Role::panel, {Role::cell_line_0, 2.5, 0}, 9));
  list.shapes.push_back(text("root", 1204, 175, 20, Role::ink, 0.5, Weight::semibold));
  for (int i = 0; i < 4; ++i) {
    const double x = 940 + 180 * i;
    list.shapes.push_back(line(1204, 193, x, 305, {Role::cell_line_1, 2.5, 0}));
    list.shapes.push_back(rect(x - 42, 305, 84, 50, i == 0 ? Role::lit_fill : Role::panel,
                               {i == 0 ? Role::lit : Role::cell_line_2, 2.5, i > 1 ? 6.0 : 0.0},
                               9));
    list.shapes.push_back(
        text(std::to_string(i + 1), x, 377, 18, Role::quiet_ink, 0.5, Weight::semibold));
    const double leaf = 760 + 120 * i;
    list.shapes.push_back(line(940, 355, leaf, 495, {Role::lit, 2.5, 0}));
    list.shapes.push_back(rect(leaf - 42, 495, 84, 50, Role::lit_fill, {Role::lit, 2.5, 0}, 9));
    add_ghost(list, leaf, 520, 15, i + 1);
    list.shapes.push_back(
        text("1." + std::to_string(i + 1), leaf, 567, 18, Role::lit, 0.5, Weight::semibold));
  }
}

// `step` moves things a little and changes the texts, so that frames differ.
inline DrawList sample_scene(int step = 0) {
  DrawList list;
  list.shapes.push_back(text("Ghosts in a quadtree", 60, 57, 26, Role::ink, 0, Weight::semibold));
  list.shapes.push_back(
      text("step " + std::to_string(step) + " of 50", 1540, 57, 22, Role::quiet_ink, 1));
  list.shapes.push_back(line(60, 78, 1540, 78, {Role::rule, 1.5, 0}, true));
  add_world(list, 0.7 * step);
  add_tree(list);
  for (int i = 0; i < 24; ++i)  // names in rows, as in a crowded tree
    list.shapes.push_back(text("node " + std::to_string(i + step), 712 + 104 * (i % 8),
                               610 + 32 * (i / 8), 18, Role::quiet_ink));
  list.shapes.push_back(line(60, 752, 1540, 752, {Role::rule, 1.5, 0}, true));
  list.shapes.push_back(text(
      "The blue ghost overflows child 1: it holds 3, its limit is 2, so it splits.", 60, 800, 30));
  list.shapes.push_back(
      text("The pink ghost lies across 1.3 and 1.4 and is stored in both.", 60, 846, 30));
  list.shapes.push_back(text(std::to_string(step % 7) + " pairs to test", 1540, 800, 30, Role::ink,
                             1, Weight::semibold));
  list.shapes.push_back(text("6 by brute force", 1540, 846, 26, Role::quiet_ink, 1));
  return list;
}

}  // namespace lantern::render
