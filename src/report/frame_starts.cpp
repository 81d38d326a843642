// How soon a process has its first picture on the disk.
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <memory>
#include <system_error>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/stop.hpp"
#include "measure/timed.hpp"
#include "render/png.hpp"
#include "render/renderer.hpp"
#include "report/bench_frames.hpp"

namespace lantern::report {
namespace {

// Runs `work` in a process of its own, which has loaded no graphics library yet; gives the seconds
// that it took there.
double seconds_in_new_process(const std::function<void()>& work) {
  int ends[2] = {};
  if (::pipe(ends) != 0) throw BackendError("no pipe to a new process");
  const pid_t child = ::fork();
  if (child < 0) throw BackendError("no new process");
  if (child == 0) {
    double seconds = -1;
    try {
      const Stopwatch watch;
      work();
      seconds = watch.seconds();
    } catch (...) {
      // The parent learns of it by the time that is missing.
    }
    const bool told = ::write(ends[1], &seconds, sizeof seconds) == sizeof seconds;
    ::_exit(told ? 0 : 1);
  }
  double seconds = -1;
  ::close(ends[1]);
  ssize_t got = 0;
  do got = ::read(ends[0], &seconds, sizeof seconds);
  while (got < 0 && errno == EINTR && !stop_asked());
  const bool told = got == sizeof seconds;
  ::close(ends[0]);
  if (stop_asked()) ::kill(child, SIGKILL);
  while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  stop_if_asked();
  if (!told || seconds < 0) throw BackendError("a new process could not draw");
  return seconds;
}

}  // namespace

StartTimes measure_start(const DrawList& list, const std::filesystem::path& folder,
                         const FrameBenchConfig& config, bool shaders_known) {
  const std::filesystem::path path = folder / "first.png";
  const auto prepare = [&] {
    if (!shaders_known) ::setenv("MESA_SHADER_CACHE_DISABLE", "1", 1);
  };
  const auto bare = [&] {
    prepare();
    // Left to the system, as a process would at its end: to take it down is no part of the start.
    Context::create(config.backend).release();
  };
  const auto frame = [&] {
    prepare();
    auto renderer = std::make_unique<Renderer>(Context::create(config.backend), 1280, 720);
    Image image;
    renderer->draw(list, config.theme, false, image);
    write_file(path, encode_png(image, PngEffort::fast, {}, 0));
    static_cast<void>(renderer.release());
  };
  if (shaders_known) seconds_in_new_process(frame);  // fills the cache
  std::vector<double> bare_seconds, frame_seconds;
  for (int i = 0; i < config.rounds; ++i) {
    bare_seconds.push_back(seconds_in_new_process(bare));
    frame_seconds.push_back(seconds_in_new_process(frame));
  }
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  return {shaders_known, quantile(bare_seconds, 0.5), quantile(frame_seconds, 0.5)};
}

}  // namespace lantern::report
