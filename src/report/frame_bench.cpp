#include <cerrno>
#include <csignal>
#include <system_error>

#include <sys/wait.h>
#include <unistd.h>

#include "render/cairo_painter.hpp"
#include "render/pipeline.hpp"
#include "report/benches.hpp"

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

// The same draw lists through cairo and its own PNG writer: what Lantern's speed is measured
// against. Needs libcairo.so.2, which is loaded when asked for. Geometry, colours and text are
// Lantern's own, the text as outlines.
class CairoPeer {
 public:
  // Throws BackendError, naming the package to install, if there is no cairo.
  CairoPeer(int width, int height) : width_(width), height_(height) {
    constexpr int kRgb24 = 1;
    surface_ = cairo().image_surface_create(kRgb24, width, height);
    cairo().require(cairo().surface_status(surface_));
    context_ = cairo().create(surface_);
    painter_.emplace(context_, CairoPainter::For::pixels);
  }
  ~CairoPeer() {
    if (context_) cairo().destroy(context_);
    cairo().surface_destroy(surface_);
  }
  CairoPeer& operator=(CairoPeer&&) = delete;  // nor any other copy or move

  static std::string version() { return cairo().version_string(); }
  void draw(const DrawList& list, const Theme& theme) {
    painter_->draw(list, theme, true, Canvas(list.page, width_, height_));
  }
  // By cairo_surface_write_to_png. Throws IoError.
  void write_png(const fs::path& path) {
    const int status = cairo().surface_write_to_png(surface_, path.c_str());
    if (status != 0)
      throw IoError("cannot write '{}': {}", path.string(), cairo().status_to_string(status));
  }

 private:
  int width_, height_;
  void* surface_ = nullptr;
  void* context_ = nullptr;
  std::optional<CairoPainter> painter_;
};

// `config.rounds` new processes for each of the two times. Writes one file into `folder` and
// removes it. Throws BackendError if a process fails.
StartTimes measure_start(const DrawList& list, const fs::path& folder,
                         const FrameBenchConfig& config, bool shaders_known) {
  const fs::path path = folder / "first.png";
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
  fs::remove(path, ignored);
  return {shaders_known, quantile(bare_seconds, 0.5), quantile(frame_seconds, 0.5)};
}

struct Round {
  double seconds = 0;
  double bytes = 0;
  std::optional<std::uint64_t> pixels_drawn, bands_packed, bands_kept;
};

// One sequence, written once.
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
    Renderer renderer(Context::create(config_.backend), c.width, c.height);
    Pipeline pipeline(renderer, c, work);
    // Shaders are compiled with the first frames: that is measured as the time to start. The last
    // frame is what stands before the first.
    for (const std::size_t i : {std::size_t{0}, lists_.size() - 1})
      pipeline.submit(lists_[i], {}, file(i));
    pipeline.finish();
    const std::uint64_t pixels = work.pixels_drawn, packed = work.bands_packed,
                        kept = work.bands_kept;
    const Stopwatch watch;
    for (std::size_t i = 0; i < lists_.size(); ++i)
      pipeline.submit(lists_[i], {{"Frame", std::to_string(i)}}, file(i));
    pipeline.finish();
    Round round = finished(watch.seconds());
    round.pixels_drawn = work.pixels_drawn - pixels;
    round.bands_packed = work.bands_packed - packed;
    round.bands_kept = work.bands_kept - kept;
    return round;
  }

  // Frames in turn on so many threads, each with a surface of its own, as cairo's documentation
  // tells: each page is painted, and written by cairo_surface_write_to_png.
  Round cairo(int threads) {
    const auto step = static_cast<std::size_t>(threads);
    std::vector<std::unique_ptr<CairoPeer>> peers;
    for (std::size_t t = 0; t < step; ++t) {
      peers.push_back(std::make_unique<CairoPeer>(config_.width, config_.height));
      peers.back()->draw(lists_[t % lists_.size()], config_.theme);
    }
    std::exception_ptr error;
    std::mutex mutex;
    const auto work = [&](std::size_t t) {
      try {
        for (std::size_t i = t; i < lists_.size(); i += step) {
          stop_if_asked();
          peers[t]->draw(lists_[i], config_.theme);
          peers[t]->write_png(file(i));
        }
      } catch (...) {
        const std::lock_guard lock(mutex);
        error = std::current_exception();
      }
    };
    const Stopwatch watch;
    {
      std::vector<std::jthread> others;
      for (std::size_t t = 1; t < step; ++t) others.emplace_back(work, t);
      work(0);
    }
    const double seconds = watch.seconds();
    if (error) std::rethrow_exception(error);
    return finished(seconds);
  }

 private:
  fs::path file(std::size_t i) const { return folder_ / fmt::format("bench_{:04}.png", i); }

  // Weighs the files and removes them.
  Round finished(double seconds) const {
    Round round;
    round.seconds = seconds;
    for (std::size_t i = 0; i < lists_.size(); ++i) {
      round.bytes += static_cast<double>(fs::file_size(file(i)));
      fs::remove(file(i));
    }
    return round;
  }

  std::span<const DrawList> lists_;
  const fs::path& folder_;
  const FrameBenchConfig& config_;
};

struct Entry {
  std::string name;
  std::function<Round(Bench&)> run;
};

std::vector<Entry> entries_of(const FrameBenchResult& result) {
  std::vector<Entry> entries{
      {"lantern, fast", [](Bench& bench) { return bench.lantern(PngEffort::fast); }},
      {"lantern, small", [](Bench& bench) { return bench.lantern(PngEffort::small); }}};
  if (result.cairo.empty()) return entries;
  entries.push_back({"cairo, 1 thread", [](Bench& bench) { return bench.cairo(1); }});
  const int threads = result.config.threads;
  if (threads > 1)
    entries.push_back({fmt::format("cairo, {} threads", threads),
                       [threads](Bench& bench) { return bench.cairo(threads); }});
  return entries;
}

constexpr std::size_t kCairo = 2;  // on one thread, among the entries

FrameRow row_of(const std::vector<Round>& rounds, const std::vector<Round>* cairo,
                std::size_t frames) {
  const auto count = static_cast<double>(frames);
  std::vector<double> rates, ratios;
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    rates.push_back(count / rounds[i].seconds);
    if (cairo) ratios.push_back((*cairo)[i].seconds / rounds[i].seconds);
  }
  FrameRow row;
  row.frames = frames;
  row.frames_per_second = quantile(rates, 0.5);
  row.lower_quartile = quantile(rates, 0.25);
  row.upper_quartile = quantile(rates, 0.75);
  if (cairo) row.against_cairo = quantile(ratios, 0.5);
  row.bytes_per_file = rounds[0].bytes / count;
  row.pixels_drawn = rounds[0].pixels_drawn;
  row.bands_packed = rounds[0].bands_packed;
  row.bands_kept = rounds[0].bands_kept;
  return row;
}

void bench_sequence(FrameBenchResult& result, const FrameSequence& sequence,
                    const fs::path& folder) {
  const std::vector<Entry> entries = entries_of(result);
  std::vector<std::vector<Round>> rounds(entries.size());
  Bench bench(sequence.lists, folder, result.config);
  for (int round = 0; round < result.config.rounds; ++round)
    for (std::size_t i = 0; i < entries.size(); ++i) rounds[i].push_back(entries[i].run(bench));
  for (std::size_t i = 0; i < entries.size(); ++i) {
    FrameRow row =
        row_of(rounds[i], result.cairo.empty() ? nullptr : &rounds[kCairo], sequence.lists.size());
    row.sequence = sequence.name;
    row.writer = entries[i].name;
    result.rows.push_back(std::move(row));
  }
}

// Leaves out pictures that equal the one before: to write those again is no drawing.
void keep_what_differs(FrameSequence& sequence, const FrameBenchConfig& config) {
  Renderer renderer(Context::create(config.backend), config.width, config.height);
  std::vector<DrawList> kept;
  for (DrawList& list : sequence.lists) {
    const Drawn drawn = renderer.draw(list, config.theme, false);
    if (std::ranges::find(drawn.changed, true) != drawn.changed.end())
      kept.push_back(std::move(list));
    if (kept.size() == config.most_frames) break;
  }
  if (kept.size() < 2) throw Refused(sequence.name + " gives fewer than two pictures that differ");
  sequence.lists = std::move(kept);
}

}  // namespace

// --- how soon a process has its first picture on the disk ---

void bench_frames(FrameBenchResult& result, std::vector<FrameSequence> sequences,
                  const fs::path& folder, const std::function<void(std::size_t)>& begun) {
  const FrameBenchConfig& config = result.config;
  if (sequences.empty() || config.rounds < 1 || config.threads < 1)
    throw Refused("a frame benchmark needs a sequence, a round and a thread");
  for (const FrameSequence& sequence : sequences)
    if (sequence.lists.size() < 2)
      throw Refused(sequence.name + " gives fewer than two pictures that differ");
  try {
    result.cairo = CairoPeer(1, 1).version();
  } catch (const BackendError& error) {
    result.missing.emplace_back(error.what());
  }
  for (const bool known : {false, true})
    result.starts.push_back(measure_start(sequences[0].lists[0], folder, config, known));
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    begun(i);
    keep_what_differs(sequences[i], config);
    bench_sequence(result, sequences[i], folder);
  }
}

std::vector<FrameMean> means_of(const FrameBenchResult& result) {
  std::vector<FrameMean> means;
  for (const FrameRow& row : result.rows) {
    if (std::ranges::find(means, row.writer, &FrameMean::writer) != means.end()) continue;
    FrameMean mean{row.writer, std::nullopt, 0};
    double rows = 0;
    for (const FrameRow& r : result.rows) {
      if (r.writer != row.writer) continue;
      ++rows;
      mean.bytes_per_file += r.bytes_per_file;
      if (r.against_cairo) mean.against_cairo = mean.against_cairo.value_or(0) + *r.against_cairo;
    }
    mean.bytes_per_file /= rows;
    if (mean.against_cairo) *mean.against_cairo /= rows;
    means.push_back(std::move(mean));
  }
  return means;
}

}  // namespace lantern::report
