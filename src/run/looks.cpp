#include "run/looks.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/flat.hpp"

namespace lantern::run {
namespace {

// At rest at both ends.
double eased(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// As wide as it says, in the world's proportions, moved into the world.
Box<2> part_of(const Box<2>& bounds, const ViewSpec& view) {
  const Vec<2> size = bounds.size() * (view.width / bounds.size().x);
  const Vec<2> lo =
      glm::clamp(flat(*view.at) - size / 2.0, bounds.lo, glm::max(bounds.lo, bounds.hi - size));
  return {lo, lo + size};
}

// Counter-clockwise as seen from above.
Vec<3> turned_about(const Vec<3>& middle, const Vec<3>& p, double angle) {
  const Vec<3> way = p - middle;
  const double c = std::cos(angle), s = std::sin(angle);
  return middle + Vec<3>(c * way.x + s * way.z, way.y, c * way.z - s * way.x);
}

}  // namespace

Looks::Looks(const Scenario& scenario) : scenario_(scenario) {
  const WorldSpec& world = scenario.world;
  if (world.has_camera) from_ = Camera{world.camera_eye, world.camera_target};
  for (const Step& step : scenario.steps) goes_round_ |= step.orbit != 0;
}

void Looks::begin(const Step& step, double time) {
  if (step_) angle_ = angle_at(time);
  step_ = &step;
  began_ = time;
  seconds_ = seconds_of(step.verb, scenario_.world.time_step);
  if (step.view) {
    view_.reset();
    if (step.view->at) view_ = part_of(flat(scenario_.world.bounds), *step.view);
  }
  if (!step.camera) return;
  from_ = Camera{step.camera->eye, step.camera->target};
  angle_ = 0;
}

// A step in which no time passes has gone all its way.
double Looks::angle_at(double time) const {
  return angle_ + step_->orbit * eased(seconds_ > 0 ? (time - began_) / seconds_ : 1);
}

void Looks::show(Frame& frame) const {
  frame.display = step_->display.value_or(scenario_.display);
  frame.view = view_;
  if (frame.dimension == 3) aim(frame);
}

void Looks::aim(Frame& frame) const {
  frame.camera = from_;
  if (!goes_round_) return;
  Camera camera = from_.value_or(usual_camera(frame.bounds));
  camera.eye = turned_about(camera.target, camera.eye, angle_at(frame.time));
  camera.goes_round = true;
  frame.camera = camera;
}

}  // namespace lantern::run
