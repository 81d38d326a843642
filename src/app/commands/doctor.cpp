#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/lab.hpp"
#include "app/terminal.hpp"
#include "base/child.hpp"
#include "base/json_writer.hpp"
#include "base/printable.hpp"
#include "embedded/version.hpp"
#include "render/context.hpp"

namespace lantern::app {
namespace {

// What Lantern can be measured beside: "Box2D 2.4.1 (single)", or that there is no lab.
std::vector<std::string> found_peers(
    std::vector<std::string> (*Lab::*peers)(std::vector<std::string>&),
    std::vector<std::string>& missing) {
  std::string why;
  if (const Lab* lab = find_lab(&why)) return (lab->*peers)(missing);
  missing.push_back(why);
  return {};
}

// An indented line each.
std::string lines_of(const std::vector<std::string>& found,
                     const std::vector<std::string>& missing) {
  std::string text;
  for (const auto* peers : {&found, &missing})
    for (const std::string& peer : *peers) text += fmt::format("         {}\n", peer);
  return text;
}

int examine(const JsonOnly& options) {
  const auto found = find_program("ffmpeg");
  const std::string ffmpeg = found ? found->string() : "";
  std::vector<std::string> missing, missing_boxes;
  const std::vector<std::string> peers = found_peers(&Lab::engines, missing);
  const std::vector<std::string> boxes = found_peers(&Lab::box_libraries, missing_boxes);
  bool any = false;
  std::string text = fmt::format("Lantern {} ({})\n", kVersion, kSourceHash);
  JsonWriter json = answer_of("doctor");
  json.line().member("version", kVersion).line().key("backends").begin_array();
  for (const BackendReport& r : examine_backends()) {
    any |= r.works;
    text += fmt::format("{:<8} {}\n         {}\n", r.name, r.works ? "works" : "does not work",
                        r.works ? r.library + ", " + r.renderer : r.problem);
    json.line().begin_object().members("name", r.name, "works", r.works, "library", r.library,
                                       "renderer", r.renderer, "problem", r.problem);
    json.end_object();
  }
  text += fmt::format("{:<8} {}\n", "ffmpeg",
                      found ? printable(ffmpeg) : "not found; only needed to make films (ffmpeg)");
  text += "peers    other engines, only needed to measure beside them\n" + lines_of(peers, missing);
  text += "boxes    other libraries of boxes, only needed by bench pairs\n" +
          lines_of(boxes, missing_boxes);
  json.line().end_array().lines("ffmpeg", ffmpeg, "peers", peers, "missing_peers", missing,
                                "box_peers", boxes, "missing_box_peers", missing_boxes);
  json.line().end_object();
  options.json ? answer(json.text()) : print(text);
  return any ? kGood : kNoBackend;
}

}  // namespace

Command doctor_command() {
  return command("doctor", "Graphics backends found, and what to install", examine, json_only);
}

}  // namespace lantern::app
