// A panel of one's own, in one file: a bar for each body, as long as the body is fast. Its part of
// the frame, how it is gathered, what is told of it beside the picture, and how it is drawn; and a
// count, which captions quote and expectations name as they do Lantern's.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <lantern/app/program.hpp>
#include <lantern/frame/part_fields.hpp>
#include <lantern/language/counts.hpp>

struct Speeds {
  static constexpr std::string_view kName = "speeds";
  struct Speed {
    std::string name;
    double speed = 0;  // units a second
    int color = 1;

    static decltype(auto) fields(const auto& r, auto&& v) {
      return v("name", r.name)("speed", r.speed).drawn(r.color);
    }
  };
  std::vector<Speed> speeds;

  static decltype(auto) fields(const auto& r, auto&& v) { return v("speeds", r.speeds); }
};
template const lantern::frame::PartType& lantern::frame::part_type<Speeds>();

inline const lantern::language::CountRule kWithSpeeds = {
    "with the panel `speeds`", "there is no panel 'speeds'",
    [](const lantern::language::ScriptPast& past) {
      return lantern::language::shows(past.scenario().panels, Speeds::kName);
    },
    &lantern::language::when::bodies};
inline const lantern::language::CountDoc kSpeedCounts[] = {
    {"moving", kWithSpeeds, "body moves/bodies move", "Bodies that move now."}};

inline void gather_speeds(const lantern::run::Stage&, lantern::frame::Frame& frame) {
  for (const auto& body : frame.bodies)
    if (!body.is_static)
      frame.add<Speeds>().speeds.push_back({body.name, glm::length(body.velocity), body.color});
  frame.add_count("moving", static_cast<std::uint64_t>(std::ranges::count_if(
                                frame.get<Speeds>().speeds,
                                [](const Speeds::Speed& body) { return body.speed > 0; })));
}

inline void draw_speeds(const lantern::frame::Frame& frame, const lantern::draw::Staging&,
                        const lantern::geometry::Box<2>& box, lantern::draw::DrawList& list,
                        lantern::draw::Labels& labels) {
  using namespace lantern::draw;
  constexpr double kRow = 40, kNames = 160;
  const auto& speeds = frame.get<Speeds>().speeds;
  double most = 1;
  for (const auto& body : speeds) most = std::max(most, body.speed);
  const TextStyle style{kLabel, Weight::regular, Role::ink};
  lantern::geometry::Vec<2> at = box.lo;
  for (const auto& body : speeds) {
    if (at.y + kRow > box.hi.y) return;
    labels.add(shortened(body.name, kNames, style), {{at.x, at.y + kRow - 12}, 0}, style, box);
    const double room = std::max(0.0, box.hi.x - at.x - kNames);
    list.rect(
        {{at.x + kNames, at.y + 6}, {at.x + kNames + room * body.speed / most, at.y + kRow - 6}},
        Role::lit);
    at.y += kRow;
  }
}

inline lantern::app::OwnPanel speeds_panel() {
  return {{.name = "speeds"},
          {.stage = "speeds panel",
           .shows = {{"speeds",
                      [](const lantern::frame::Frame& frame) {
                        return !frame.get<Speeds>().speeds.empty();
                      }}},
           .gather = gather_speeds,
           .counts = kSpeedCounts},
          {.draw = draw_speeds}};
}
