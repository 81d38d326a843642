#include "frame/panel.hpp"

#include <utility>

#include "language/counts.hpp"

namespace lantern::frame {
namespace {

std::vector<PanelRun>& runs() {
  static std::vector<PanelRun> all;
  return all;
}

}  // namespace

const PanelRun& run_of(Panel panel) { return runs().at(static_cast<std::size_t>(panel)); }

void add_panel(PanelKind kind, PanelRun run) {
  language::add_panel(std::move(kind));
  language::add_counts(run.counts);
  runs().push_back(std::move(run));
}

}  // namespace lantern::frame
