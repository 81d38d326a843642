#include "report/bench_frames.hpp"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/stop.hpp"
#include "measure/records.hpp"
#include "measure/timed.hpp"
#include "render/pipeline.hpp"
#include "render/png.hpp"
#include "render/renderer.hpp"
#include "report/cairo_peer.hpp"

namespace lantern::report {

template <class Visit>
void each_field(const FrameWriter& f, Visit&& visit) {
  visit(Field("name"), f.name);
  visit(Field("frames_per_second"), f.frames_per_second);
  visit(Field("against_cairo"), f.against_cairo);
  visit(Field("bytes_per_file"), f.bytes_per_file);
  visit(Field("pictures_encoded"), f.pictures_encoded);
}

template <class Visit>
void each_field(const StartTimes& s, Visit&& visit) {
  visit(Field("shaders_known"), s.shaders_known);
  visit(Field("bare_context_seconds"), s.bare_context);
  visit(Field("first_file_seconds"), s.first_file);
}

namespace {

namespace fs = std::filesystem;

struct Round {
  double seconds = 0;
  double bytes = 0;
  double encoded = 1;
};

class Bench {
 public:
  Bench(std::span<const DrawList> lists, const fs::path& folder, const FrameBenchConfig& config)
      : lists_(lists), folder_(folder), config_(config) {}

  Round lantern(PngEffort effort) {
    Pipeline::Config c;
    c.width = config_.width;
    c.height = config_.height;
    c.theme = config_.theme;
    c.effort = effort;
    c.threads = config_.threads;
    Work work;
    Pipeline pipeline(Context::create(config_.backend), c, work);
    // Shaders are compiled with the first frames: that is measured as the time to start.
    for (int i = 0; i < 2; ++i) pipeline.submit(list(config_.frames + i), {}, file(i));
    pipeline.finish();
    const std::uint64_t before = work.frames_encoded;
    const Stopwatch watch;
    for (int i = 0; i < config_.frames; ++i)
      pipeline.submit(list(i), {{"Frame", std::to_string(i)}}, file(i));
    pipeline.finish();
    Round round = finished(watch.seconds());
    round.encoded = static_cast<double>(work.frames_encoded - before) / config_.frames;
    return round;
  }

  // Frames in turn on so many threads, each with a surface of its own.
  Round cairo(int threads) {
    std::vector<std::unique_ptr<CairoPeer>> peers;
    for (int t = 0; t < threads; ++t) {
      peers.push_back(std::make_unique<CairoPeer>(config_.width, config_.height));
      peers.back()->draw(list(t), config_.theme);
    }
    std::exception_ptr error;
    std::mutex mutex;
    const auto work = [&](int t) {
      try {
        for (int i = t; i < config_.frames; i += threads) {
          stop_if_asked();
          peers[static_cast<std::size_t>(t)]->draw(list(i), config_.theme);
          peers[static_cast<std::size_t>(t)]->write_png(file(i));
        }
      } catch (...) {
        const std::lock_guard lock(mutex);
        error = std::current_exception();
      }
    };
    const Stopwatch watch;
    {
      std::vector<std::jthread> others;
      for (int t = 1; t < threads; ++t) others.emplace_back(work, t);
      work(0);
    }
    const double seconds = watch.seconds();
    if (error) std::rethrow_exception(error);
    return finished(seconds);
  }

 private:
  const DrawList& list(int i) const { return lists_[static_cast<std::size_t>(i) % lists_.size()]; }
  fs::path file(int i) const { return folder_ / fmt::format("bench_{:04}.png", i); }

  // Weighs the files and removes them.
  Round finished(double seconds) const {
    Round round;
    round.seconds = seconds;
    for (int i = 0; i < config_.frames; ++i) {
      round.bytes += static_cast<double>(fs::file_size(file(i)));
      fs::remove(file(i));
    }
    return round;
  }

  std::span<const DrawList> lists_;
  const fs::path& folder_;
  const FrameBenchConfig& config_;
};

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

// `rounds` new processes for each of the two times. Writes one file into `folder` and removes it.
// Throws BackendError if a process fails.
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

struct Entry {
  std::string name;
  std::function<Round()> run;
  std::vector<double> seconds;
  Round last;
};

}  // namespace

FrameBenchResult bench_frames(std::span<const DrawList> lists, const fs::path& folder,
                              const FrameBenchConfig& config) {
  if (lists.empty() || config.frames < 1 || config.rounds < 1 || config.threads < 1)
    throw Refused("a frame benchmark needs a draw list, a frame, a round and a thread");
  FrameBenchResult result;
  result.config = config;
  for (const bool known : {false, true})
    result.starts.push_back(measure_start(lists[0], folder, config, known));

  Bench bench(lists, folder, config);
  std::vector<Entry> entries;
  entries.push_back({"lantern, fast", [&] { return bench.lantern(PngEffort::fast); }, {}, {}});
  entries.push_back({"lantern, small", [&] { return bench.lantern(PngEffort::small); }, {}, {}});
  try {
    result.cairo = CairoPeer(1, 1).version();
    entries.push_back({"cairo, 1 thread", [&] { return bench.cairo(1); }, {}, {}});
    entries.push_back({fmt::format("cairo, {} threads", config.threads),
                       [&] { return bench.cairo(config.threads); },
                       {},
                       {}});
  } catch (const BackendError& error) {
    result.cairo = error.what();
  }
  for (int round = 0; round < config.rounds; ++round)
    for (Entry& entry : entries) {
      entry.last = entry.run();
      entry.seconds.push_back(entry.last.seconds);
    }
  for (const Entry& entry : entries)
    result.writers.push_back({entry.name, config.frames / quantile(entry.seconds, 0.5), 0,
                              entry.last.bytes / config.frames, entry.last.encoded});
  if (entries.size() > 2)
    for (FrameWriter& c : result.writers)
      c.against_cairo = c.frames_per_second / result.writers[2].frames_per_second;
  return result;
}

std::string to_table(const FrameBenchResult& result) {
  const FrameBenchConfig& c = result.config;
  std::string text = fmt::format("{} x {}, {} files, median of {} rounds; cairo: {}\n\n", c.width,
                                 c.height, c.frames, c.rounds, result.cairo);
  text += fmt::format("{:<18}{:>12}{:>12}{:>14}{:>10}\n", "", "frames/s", "x cairo", "bytes/file",
                      "encoded");
  for (const FrameWriter& f : result.writers)
    text += fmt::format("{:<18}{:>12.1f}{:>12.2f}{:>14.0f}{:>9.0f}%\n", f.name, f.frames_per_second,
                        f.against_cairo, f.bytes_per_file, 100 * f.pictures_encoded);
  text += "\nfrom the start of a process, ms   bare context   first 1280 x 720 file   ratio\n";
  for (const StartTimes& s : result.starts)
    text += fmt::format("{:<34}{:>12.1f}{:>24.1f}{:>8.2f}\n",
                        s.shaders_known ? "shaders in Mesa's cache" : "shaders never compiled yet",
                        1e3 * s.bare_context, 1e3 * s.first_file, s.first_file / s.bare_context);
  return text;
}

std::string to_json(const FrameBenchResult& result) {
  const FrameBenchConfig& c = result.config;
  JsonWriter json;
  json.begin_object().line().member("format", "lantern.bench.frames/1");
  json.line().member("width", c.width).member("height", c.height).member("frames", c.frames);
  json.line().member("rounds", c.rounds).member("threads", c.threads);
  json.line().member("cairo", result.cairo);
  write_rows("contestants", result.writers, json);
  write_rows("starts", result.starts, json);
  json.line().end_object();
  return json.text() + "\n";
}

}  // namespace lantern::report
