#include "run/narrow_shown.hpp"

#include <algorithm>
#include <utility>

#include "run/engine.hpp"

namespace lantern::run {

void NarrowShown::show(ShapeTests tests) {
  tests_ = std::move(tests);
  drawn_ = Drawn::tests;
}

void NarrowShown::show(FrameSeparation separation) {
  separation_ = std::move(separation);
  drawn_ = Drawn::separation;
}

void NarrowShown::show(FrameSearch search) {
  search_ = std::move(search);
  drawn_ = Drawn::search;
}

void NarrowShown::add_to(Frame& frame, const Engine& engine) const {
  if (tests_) {
    if (drawn_ == Drawn::tests) frame.tested = tests_->tested;
    if (drawn_ == Drawn::tests) frame.contacts = tests_->touching;
    frame.add_count("shapes_tested", tests_->tested.size());
    frame.add_count("narrow_work", tests_->work);
    frame.add_count("touching", tests_->touching.size());
  }
  if (separation_) {
    if (drawn_ == Drawn::separation) frame.put(separation_);
    frame.add_count("axes_tested", separation_->axes.size());
    frame.measures.emplace_back("gap", separation_->gap());
    frame.measures.emplace_back("overlap", separation_->overlap());
  }
  if (search_) {
    if (drawn_ == Drawn::search) frame.put(search_);
    frame.add_count("gjk_steps", search_->steps.size());
    if (search_->answer) frame.measures.emplace_back("distance", search_->answer->distance);
  }
  if (!shows(frame.panels, "difference")) return;
  if (search_) frame.put(engine.difference(search_->a, search_->b));
  std::vector<BodyId> there;
  for (const FrameBody& body : frame.bodies)
    if (!std::holds_alternative<HalfSpace<3>>(body.shape)) there.push_back(body.id);
  if (!frame.find<FrameDifference>() && there.size() > 1)
    frame.put(engine.difference(there[0], there[1]));
}

}  // namespace lantern::run
