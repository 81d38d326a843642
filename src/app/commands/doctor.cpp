#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/answer.hpp"
#include "app/commands/command.hpp"
#include "app/terminal.hpp"
#include "base/json_writer.hpp"
#include "base/printable.hpp"
#include "base/program.hpp"
#include "embedded/version.hpp"
#include "measure/peers.hpp"
#include "render/context.hpp"

namespace lantern::app {
namespace {

struct DoctorOptions {
  bool json = false;
};

Options doctor_options(DoctorOptions& o) { return {json_option(o.json)}; }

// What Lantern can be measured beside: other physics engines, other libraries of boxes.
struct PeerReport {
  std::vector<std::string> found;  // "Box2D 2.4.1 (single)"
  std::vector<std::string> missing;
};

PeerReport examine_peers() {
  PeerReport report;
  for (const auto& peer : load_peers(report.missing))
    report.found.push_back(peer->name() + " " + peer->version());
  return report;
}

PeerReport examine_box_peers() {
  PeerReport report;
  report.found = box_peer_names(report.missing);
  return report;
}

std::string peers_text(const PeerReport& peers) {
  std::string text;
  for (const std::string& peer : peers.found) text += fmt::format("         {}\n", peer);
  for (const std::string& peer : peers.missing) text += fmt::format("         {}\n", peer);
  return text;
}

void write_list(const char* name, const std::vector<std::string>& words, JsonWriter& json) {
  json.line().key(name).begin_array();
  for (const std::string& one : words) json.value(one);
  json.end_array();
}

std::string as_text(const std::vector<BackendReport>& reports, const std::string& ffmpeg,
                    const PeerReport& peers, const PeerReport& box_peers) {
  std::string text = fmt::format("Lantern {} ({})\n", kVersion, kSourceHash);
  for (const BackendReport& r : reports) {
    text += fmt::format("{:<8} {}\n", r.name, r.works ? "works" : "does not work");
    text += fmt::format("         {}\n", r.works ? r.library + ", " + r.renderer : r.problem);
  }
  text += fmt::format("{:<8} {}\n", "ffmpeg",
                      ffmpeg.empty() ? "not found; only needed to make films (ffmpeg)" : ffmpeg);
  text += "peers    other engines, only needed to measure beside them\n" + peers_text(peers);
  text += "boxes    other libraries of boxes, only needed by bench pairs\n" + peers_text(box_peers);
  return text;
}

int examine(const DoctorOptions& options) {
  const std::vector<BackendReport> reports = examine_backends();
  const auto found = find_program("ffmpeg");
  const std::string ffmpeg = found ? found->string() : "";
  const PeerReport peers = examine_peers(), box_peers = examine_box_peers();
  bool any = false;
  JsonWriter json = answer_of("doctor");
  json.line().member("version", kVersion).line().key("backends").begin_array();
  for (const BackendReport& r : reports) {
    any |= r.works;
    json.line().begin_object().member("name", r.name).member("works", r.works);
    json.member("library", r.library).member("renderer", r.renderer);
    json.member("problem", r.problem).end_object();
  }
  json.line().end_array().line().member("ffmpeg", ffmpeg);
  write_list("peers", peers.found, json);
  write_list("missing_peers", peers.missing, json);
  write_list("box_peers", box_peers.found, json);
  write_list("missing_box_peers", box_peers.missing, json);
  json.line().end_object();
  options.json ? answer(json.text()) : print(as_text(reports, printable(ffmpeg), peers, box_peers));
  return any ? kGood : kNoBackend;
}

}  // namespace

Command doctor_command() {
  return command("doctor", "Graphics backends found, and what to install", examine, doctor_options);
}

}  // namespace lantern::app
