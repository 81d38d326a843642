// Bodies as characters, made of few shapes and points in any size.
#pragma once

#include "draw/draw_list.hpp"
#include "scenario/frame.hpp"

namespace lantern {

// Draws the body so that it fills `place` (page units). Eyes and mouth turn along its velocity.
// Below some 14 units across, and when `plain`, a body is one simple shape.
void draw_character(const FrameBody& body, const Box<2>& place, bool plain, DrawList& list);

// The emblem of a colour around `center`: what tells colours apart without colour.
void draw_emblem(int color, const Vec<2>& center, double radius, DrawList& list);

// The letter of sleep, in this box.
void draw_z(const Box<2>& box, const Stroke& stroke, DrawList& list);
// "z z", for what sleeps; the first letter's upper left corner lies `unit` / 5 under `corner`.
void draw_zz(const Vec<2>& corner, double unit, double width, DrawList& list);

}  // namespace lantern
