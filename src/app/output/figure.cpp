#include <algorithm>

#include "app/output/sinks.hpp"
#include "draw/page.hpp"
#include "draw/tween.hpp"

namespace lantern::app {
namespace {

constexpr double kUsualLetters = 8;  // points
constexpr double kLeastUnits = 420;  // of the page's width: on less nothing has room
constexpr double kMostUnits = 1600;  // more are taken only for letters that are asked for

// A page, and how much of it is drawn upon.
struct Try {
  Figure figure;
  double enlarged = 1;  // letters are, on a high page
  int left_out = 0;
};

std::vector<Try> tries_for(const Frame& frame, double width) {
  constexpr int kTries = 12;
  constexpr double kWider = 1.08;
  std::vector<Try> tries;
  for (; tries.size() < kTries; width *= kWider) {
    const Vec<2> page = page_across(frame, width);
    tries.push_back({{page, {page, Vec<2>(0.0)}}, page.x / width});
  }
  return tries;
}

}  // namespace

// What is drawn is laid out on pages of several widths, and each is cut to what is drawn upon: the
// widest whose part is no wider than was asked for, so that no letters are smaller.
void lay_out_figure(const Sequence& of, RenderJob& job) {
  constexpr double kRim = 2;  // half of the widest line
  const double letters = job.letters > 0 ? job.letters : kUsualLetters;
  double units = kLeastLabel * job.on_paper / letters;
  if (job.letters <= 0) units = std::min(units, kMostUnits);
  std::vector<Try> tries;
  if (units >= kLeastUnits)
    look_at_chosen(of, [&](const Frame& frame, const Staging& staging) {
      const Frame shown = job.shown(frame);
      if (tries.empty()) tries = tries_for(shown, units);
      for (Try& one : tries) {
        const DrawList list = draw_frame(shown, staging, one.figure.page, of.work);
        one.left_out += list.left_out;
        Box<2>& part = one.figure.part;
        for (const DrawShape& shape : list.shapes)
          part = united(part, shrunk(extent_of(shape), -kRim));
      }
    });
  const Figure* best = nullptr;
  for (const Try& one : tries)
    if (one.left_out == 0 && (!best || one.figure.part.size().x <= units * one.enlarged))
      best = &one.figure;
  if (!best)
    throw UsageError(
        "letters of {:.3g} pt leave no room for {} on {:.3g} pt; give more width (--width) or "
        "smaller letters (--letters){}",
        letters, job.options.panel.empty() ? "all panels" : "that panel", job.on_paper,
        job.options.panel.empty() ? ", or one panel alone (--panel)" : "");
  job.set(*best);
}

}  // namespace lantern::app
