#include "live/session.hpp"
namespace lantern::live {
using namespace run; using namespace publish;
std::string Session::ask(std::string_view request) {
  Scenario s = parse_scenario(request, "a.toml"); Work work; std::string out;
  direct(s, s.pace, work, [&](const Frame& f) { LessonFrames l; DrawList d = draw_frame(f, {1600, 711}, work); l.add(f, d, words_of(f, f, s)); out += to_json(f) + l.json() + facts_for_page(f, d) + to_svg(d, *draw::theme_named("light"), false, 100, 100); return true; });
  return out;
}
}
