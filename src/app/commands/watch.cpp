#include "app/output/watch.hpp"

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/output/destination.hpp"
#include "app/output/render_job.hpp"
#include "app/terminal.hpp"
#include "base/error.hpp"
#include "base/stop.hpp"

namespace lantern::app {
namespace {

constexpr auto kLook = std::chrono::milliseconds(25);  // a signal is heard as soon

// What is wrong with a scenario, or with what was asked of it, may be mended by the next save: it
// is said, and the watch goes on. A machine without graphics will not be.
void render_and_tell(const RenderOptions& options) {
  try {
    draw_scenarios(options);
  } catch (const UsageError& e) {
    complain(e.what());
  } catch (const IoError& e) {
    complain(e.what());
  }
}

}  // namespace

int watch_scenarios(const RenderOptions& asked) {
  RenderOptions options = asked;
  options.reloading = true;
  const RenderJob checked(options);  // words that no save can mend
  if (Destination(options.output, !options.sheet.empty()).kind() == OutputKind::standard_output)
    throw UsageError("watch draws again and again; -o - takes one picture");
  for (const std::string& file : options.files)
    if (!std::filesystem::exists(file))
      throw IoError(fmt::format("'{}' is not there to be watched", file));
  const struct Leftovers {
    ~Leftovers() { forget_versions(); }
  } at_the_end;
  WatchedFiles watched(options.files);
  render_and_tell(options);
  say(fmt::format("watching {}; Ctrl-C ends", fmt::join(options.files, ", ")));
  while (!stop_asked()) {
    std::this_thread::sleep_for(kLook);
    options.files = watched.changed();
    for (const std::string& file : watched.gone())
      say(fmt::format("'{}' is gone; it is waited for", file));
    for (const std::string& file : watched.back()) say(fmt::format("'{}' is back", file));
    if (!options.files.empty()) render_and_tell(options);
  }
  return kInterrupted;
}

}  // namespace lantern::app
