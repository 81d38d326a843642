#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "draw/font.hpp"
#include "draw/labels.hpp"
#include "report/measure_plots.hpp"
#include "report/page_parts.hpp"
#include "report/pages.hpp"

namespace lantern::report {
namespace {

constexpr double kPeersMargin = 60, kPeersTop = 96, kPeersLine = 22, kPeersGap = 10;
constexpr std::size_t kPeerColumns = 6;
// Left ends as shares of the width.
constexpr std::array<double, kPeerColumns + 1> kPeerLeft{0, 0.135, 0.325, 0.455, 0.64, 0.85, 1};
using PeerCells = std::array<std::string, kPeerColumns>;

const TextStyle kPeerHead{kLeastLabel, Weight::regular, Role::quiet_ink, Role::none};
const TextStyle kPeerWords{kLeastLabel, Weight::regular, Role::ink, Role::none};
const TextStyle kPeerName{kLeastLabel, Weight::semibold, Role::ink, Role::none};

std::string engine_of(const PeerRecord& peer) { return peer.name.substr(0, peer.name.find(':')); }

PeerCells cells_of(const PeerRecord& peer) {
  const PeerSettings& s = peer.settings;
  return {peer.name + " " + peer.version,
          s.integrator + "; " + s.solver,
          s.iterations,
          s.joints,
          s.flags,
          s.source};
}

}  // namespace

DrawList draw_peers(const Measurement& measurement) {
  struct Line {
    std::array<std::vector<std::string>, kPeerColumns> cells;
    double height = 0;
    bool begins = false;  // an engine
  };
  DrawList list;
  const double width = list.page.x - 2 * kPeersMargin;
  const auto x = [&](std::size_t column) { return kPeersMargin + kPeerLeft[column] * width; };
  std::vector<Line> lines;
  double height = 0;
  for (std::size_t i = 0; i < measurement.peers.size(); ++i) {
    const PeerRecord& peer = measurement.peers[i];
    Line line;
    line.begins = i == 0 || engine_of(measurement.peers[i - 1]) != engine_of(peer);
    const PeerCells cells = cells_of(peer);
    const PeerCells before = line.begins ? PeerCells() : cells_of(measurement.peers[i - 1]);
    for (std::size_t c = 0; c < kPeerColumns; ++c)
      if (cells[c] != before[c])
        line.cells[c] = wrapped(cells[c], x(c + 1) - x(c) - 18, c == 0 ? kPeerName : kPeerWords);
    for (const auto& words : line.cells)
      line.height = std::max(line.height, kPeersLine * static_cast<double>(words.size()));
    height += line.height + kPeersGap;
    lines.push_back(std::move(line));
  }
  list.page.y = std::max(list.page.y, kPeersTop + kPeersLine + height + 80);
  Labels labels(list);
  draw_page_title("How each engine was run", "and who recommends it so", kPeersMargin, list,
                  labels);
  const Box<2> table{{kPeersMargin, kPeersTop - 20}, {kPeersMargin + width, list.page.y - 50}};
  const auto put = [&](std::size_t column, const std::string& text, double y,
                       const TextStyle& style) {
    labels.add(text, {{x(column), y}, 0}, style, table);
  };
  double y = kPeersTop + 14;
  const char* const heads[kPeerColumns] = {"run as", "integrator; solver", "iterations", "joints",
                                           "flags",  "recommended by"};
  for (std::size_t c = 0; c < kPeerColumns; ++c) put(c, heads[c], y, kPeerHead);
  for (const Line& line : lines) {
    if (line.begins)
      list.crisp_line({kPeersMargin, y + 9}, {kPeersMargin + width, y + 9}, {Role::rule, 1.6});
    y += kPeersGap;
    for (std::size_t c = 0; c < kPeerColumns; ++c)
      for (std::size_t k = 0; k < line.cells[c].size(); ++k)
        put(c, line.cells[c][k], y + kPeersLine * static_cast<double>(k + 1),
            c == 0 ? kPeerName : kPeerWords);
    y += line.height;
  }
  labels.add(shortened(circumstances_text(measurement.circumstances), width, kPeerHead),
             {{kPeersMargin, list.page.y - 26}, 0}, kPeerHead,
             {{kPeersMargin, list.page.y - 50}, {kPeersMargin + width, list.page.y}});
  return list;
}

}  // namespace lantern::report
