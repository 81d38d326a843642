#include "app/frame_walk.hpp"

#include <utility>

#include "app/in_betweens.hpp"
#include "base/stop.hpp"
#include "draw/tween.hpp"

namespace lantern::app {

void FrameWalk::go_on(const Frame& frame, const Staging& staging) {
  before_ = std::exchange(here_, Stop{frame});
  staging_ = &staging;
}

const DrawList& FrameWalk::page_of(Stop& stop) {
  if (!stop.page) stop.page = job_.page_of(stop.frame, *staging_, work_);
  return *stop.page;
}

DrawList FrameWalk::in_between(double t) {
  stop_if_asked();
  ++work_.in_betweens;
  return between(page_before(), page(), t, InBetweens::motion(before_->frame, here_->frame));
}

}  // namespace lantern::app
