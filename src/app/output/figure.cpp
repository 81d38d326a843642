#include <algorithm>

#include "app/output/sinks.hpp"
#include "draw/page.hpp"
#include "draw/tween.hpp"

namespace lantern::app {
namespace {

constexpr double kUsualLetters = 8;  // points
constexpr double kLeastUnits = 420;  // of the page's width: on less nothing has room
constexpr double kRim = 2;           // half of the widest line
constexpr double kMostUnits = 1600;  // more are taken only for letters that are asked for

// A run in which every chosen picture is laid out on pages of several widths, to see how much of
// each is drawn upon. What is shown is cut to that, so that a wider page can be the right one.
class FigureTrial : public StagedSink {
 public:
  FigureTrial(const Sequence& of, double units)
      : of_(of), selection_(of.selection), units_(units) {
    run_scenario(of.scenario, of.pace, *this, of.work, selection_.most());
  }

  // The widest page whose part that is drawn upon is no wider than was asked for, so that no
  // letters are smaller. Nothing if panels have no room on any.
  std::optional<Figure> best() const {
    std::optional<Figure> best;
    for (const Try& one : tries_)
      if (one.left_out == 0 && (!best || one.part.size().x <= units_ * one.enlarged))
        best = {one.page, one.part};
    return best;
  }

 private:
  struct Try {
    Vec<2> page{0.0};
    double enlarged = 1;  // letters are, on a high page
    Box<2> part;
    int left_out = 0;
  };

  void begin(const Frame& frame, const Staging& staging) {
    constexpr int kTries = 12;
    constexpr double kWider = 1.08;
    double width = units_;
    for (int i = 0; i < kTries; ++i, width *= kWider) {
      const Vec<2> page = page_across(frame, staging, width);
      tries_.push_back({page, page.x / width, {page, Vec<2>(0.0)}, 0});
    }
  }

  void draw(const Frame& frame, const Staging& staging) override {
    if (!selection_.takes(frame)) return;
    const Frame shown = of_.job.shown(frame);
    if (tries_.empty()) begin(shown, staging);
    for (Try& one : tries_) {
      const DrawList list = draw_frame(shown, staging, one.page, of_.work);
      one.left_out += list.left_out;
      for (const DrawShape& shape : list.shapes)
        one.part = united(one.part, shrunk(extent_of(shape), -kRim));
    }
  }
  void close(const DirectorReport&) override { selection_.require_some(); }

  const Sequence& of_;
  Selection selection_;  // as it is before the run
  double units_;
  std::vector<Try> tries_;  // each wider than the one before
};

}  // namespace

void lay_out_figure(const Sequence& of, RenderJob& job) {
  const RenderOptions& o = job.options;
  const double letters = job.letters > 0 ? job.letters : kUsualLetters;
  double units = kLeastLabel * job.width / letters;
  if (job.letters <= 0) units = std::min(units, kMostUnits);
  const auto refuse = [&] {
    throw UsageError(
        "letters of {:.3g} pt leave no room for {} on {:.3g} pt; give more width (--width), smaller "
        "letters (--letters), or one panel alone (--panel)",
        letters, o.panel.empty() ? "all panels" : "that panel", job.width);
  };
  if (units < kLeastUnits) refuse();
  const std::optional<Figure> best = FigureTrial(of, units).best();
  if (!best) refuse();
  job.set(*best);
}

}  // namespace lantern::app
