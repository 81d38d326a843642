// Frames with sides: the same moment under several settings.
#include "draw/sample_frames.hpp"
#include "frame/parts/panels.hpp"

namespace lantern::draw::samples {

Frame sided(std::vector<Frame> sides) {
  Frame frame;
  frame.dimension = sides[0].dimension;
  frame.camera = sides[0].camera;
  frame.bounds = sides[0].bounds;
  frame.title = "The same script under other settings";
  frame.caption = "What stands at the same place of two sides can be compared.";
  frame.step = 3;
  frame.steps = 9;
  frame.panels = sides[0].panels;
  frame.sides = std::move(sides);
  for (std::size_t i = 0; i < frame.sides.size(); ++i) {
    frame.sides[i].add<FrameSide>().name = std::string(1, static_cast<char>('a' + i));
    frame.sides[i].add<FrameSide>().title = "side " + frame.sides[i].get<FrameSide>().name;
    frame.sides[i].caption.clear();
  }
  return frame;
}

Named sides() {
  Frame long_titles = sided({long_texts(), long_texts(), long_texts()});
  for (Frame& side : long_titles.sides)
    side.add<FrameSide>().title = "a title of forty letters, not one more..";
  Frame late = sided({ghosts(4), ghosts(2)});
  late.sides[0].caption = "Blue is stored in 1.1.";
  late.caption.clear();
  late.sides[1].add<FrameSide>().held = true;
  late.sides[0].time = 1.25;
  Frame over_time = sided({ghosts(4), ghosts(3)});
  over_time.panels.push_back(panel_named("chart"));
  over_time.add<FrameChart>().x_name = "time";
  over_time.add<FrameChart>().y_name = "pairs";
  over_time.add<FrameChart>().over_time = true;
  over_time.add<FrameChart>().seconds = 2;
  over_time.add<FrameChart>().series = {{"a", {{0, 6}, {1, 5}}, 0}, {"b", {{0, 1}, {1, 2}}, 0}};
  return {{"two sides", sided({ghosts(4), ghosts(3)})},
          {"three sides", sided({pong(9), pong(20), pong(28)})},
          {"four sides", sided({ghosts(2), ghosts(3), ghosts(4), ghosts(4)})},
          {"sides that hold", late},
          {"sides with a chart", over_time},
          {"sides with long titles", long_titles},
          {"sides of atlases", sided({atlas(12, 4), atlas(12, 9)})},
          {"sides of nothing", sided({empty(), empty()})}};
}

}  // namespace lantern::draw::samples
