#include "publish/film.hpp"

#include <array>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <sstream>
#include <stop_token>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/child.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/memory.hpp"
#include "base/printable.hpp"
#include "base/program.hpp"
#include "publish/film_stream.hpp"

namespace lantern::publish {
namespace {

// One is drawn upon, one waits, one is on its way, and the last one may be sent again.
constexpr std::size_t kImages = 4;

constexpr std::array kFilmEndings = {
    std::pair{"mp4", FilmKind::mp4},   std::pair{"webm", FilmKind::webm},
    std::pair{"gif", FilmKind::gif},   std::pair{"apng", FilmKind::apng},
    std::pair{"webp", FilmKind::webp},
};

std::size_t picture_bytes(const FilmSettings& settings) {
  return std::size_t{4} * static_cast<std::size_t>(settings.width) *
         static_cast<std::size_t>(settings.height);
}

// As ffmpeg opens it.
std::string film_target(const PartFile& file) {
  return "file:" + (file.temporary().empty() ? fmt::format("/proc/self/fd/{}", Child::kHandedOn)
                                             : file.temporary().string());
}

std::vector<std::string> film_command(const std::filesystem::path& ffmpeg,
                                      const FilmSettings& settings, const PartFile& file) {
  std::vector<std::string> words = {ffmpeg.string()};
  for (std::string& word : film_words(settings, film_target(file)))
    words.push_back(std::move(word));
  return words;
}

// ffmpeg may end well though the disk was full when it wrote the very last bytes.
bool tells_of_failure(std::string_view said) {
  return said.find("Error writing trailer") != said.npos ||
         said.find("Error closing file") != said.npos;
}

// The last lines that say something, as one; what was written is called by its own name.
std::string last_words(std::string said, const std::string& target, const std::string& path) {
  constexpr std::size_t kMostLines = 3;
  for (auto at = said.find(target); at != said.npos; at = said.find(target, at + path.size()))
    said.replace(at, target.size(), path);
  std::deque<std::string> lines;
  std::istringstream text(said);
  for (std::string line; std::getline(text, line);) {
    line.erase(0, line.find_first_not_of(' '));
    if (line.empty() || line.starts_with("Last message repeated")) continue;
    lines.push_back(printable(line));
    if (lines.size() > kMostLines) lines.pop_front();
  }
  return fmt::format("{}", fmt::join(lines, "; "));
}

}  // namespace

std::optional<FilmKind> film_kind(std::string_view ending) {
  for (const auto& [name, kind] : kFilmEndings)
    if (ending == name) return kind;
  return std::nullopt;
}

std::filesystem::path require_ffmpeg() {
  if (const auto found = find_program("ffmpeg")) return *found;
  throw IoError("films are made by ffmpeg, which is not on the PATH: apt-get install ffmpeg");
}

struct Film::State {
  struct Job {
    std::unique_ptr<Image> image;
    std::uint64_t moment = 0;
  };

  State(const std::filesystem::path& ffmpeg, const FilmSettings& s, const FilePlace& where)
      : settings(s),
        path(where.path()),
        bytes(picture_bytes(s)),
        file(where),
        child(film_command(ffmpeg, s, file), file.descriptor()) {
    for (std::size_t i = 0; i < kImages; ++i) blank_images.push_back(std::make_unique<Image>());
  }

  // Also while the thread waits for ffmpeg to read on.
  ~State() {
    if (!finished) child.end();
  }

  void give_away(const std::stop_token& stop);
  void send(const Job& job);
  void fail();
  void rethrow_locked() const {
    if (error) std::rethrow_exception(error);
  }

  const FilmSettings settings;
  const std::filesystem::path path;
  const std::size_t bytes;  // of a picture
  PartFile file;
  Child child;
  std::unique_ptr<Image> drawn;  // given to be drawn upon
  std::uint64_t shown = 0;       // pictures
  bool begun = false, finished = false;

  std::mutex mutex;
  std::condition_variable_any ready;
  std::condition_variable given;
  std::vector<std::unique_ptr<Image>> blank_images;
  std::deque<Job> jobs;
  Job last;  // that was sent
  bool busy = false;
  std::exception_ptr error;
  std::jthread thread;  // the last member: it ends first
};

void Film::State::fail() {
  const int code = child.finish();
  const std::string words = last_words(child.said(), film_target(file), path.string());
  throw IoError(fmt::format("cannot make '{}': ffmpeg {} {}{}{}", printable(path.string()),
                            code > 128  ? "was ended by signal"
                            : code == 0 ? "wrote no whole film, and ended with exit code"
                                        : "failed with exit code",
                            code > 128 ? code - 128 : code, words.empty() ? "" : ": ", words));
}

void Film::State::send(const Job& job) {
  const auto& pixels = job.image->rgba;
  std::string head = begun ? "" : film_stream_start(settings.width, settings.height, settings.rate);
  begun = true;
  head += film_stream_picture(job.moment, pixels.size());
  if (!child.write(head) ||
      !child.write({reinterpret_cast<const char*>(pixels.data()), pixels.size()}))
    fail();
}

void Film::State::give_away(const std::stop_token& stop) {
  std::unique_lock lock(mutex);
  while (ready.wait(lock, stop, [this] { return !jobs.empty(); })) {
    Job job = std::move(jobs.front());
    jobs.pop_front();
    busy = true;
    lock.unlock();
    std::exception_ptr problem;
    try {
      send(job);
    } catch (...) {
      problem = std::current_exception();
    }
    lock.lock();
    busy = false;
    if (last.image) blank_images.push_back(std::move(last.image));
    last = std::move(job);
    error = problem;
    given.notify_all();
    if (error) return;
  }
}

Film::Film(const std::filesystem::path& ffmpeg, const FilmSettings& settings,
           const FilePlace& place)
    : state_((require_memory(picture_bytes(settings) * kImages, "pictures of a film",
                             "draw smaller ones (--size)"),
              std::make_unique<State>(ffmpeg, settings, place))) {
  State& s = *state_;
  try {
    s.thread = std::jthread([&s](const std::stop_token& stop) { s.give_away(stop); });
  } catch (const std::system_error& problem) {
    throw IoError(fmt::format("cannot start a thread: {}", problem.code().message()));
  }
}

Film::~Film() = default;

Image& Film::blank() {
  State& s = *state_;
  std::unique_lock lock(s.mutex);
  if (!s.drawn) {
    s.given.wait(lock, [&] { return s.error || !s.blank_images.empty(); });
    s.rethrow_locked();
    s.drawn = std::move(s.blank_images.back());
    s.blank_images.pop_back();
  }
  return *s.drawn;
}

void Film::show(std::uint64_t moment) {
  State& s = *state_;
  ++s.shown;
  if (s.settings.kind == FilmKind::gif)  // ffmpeg keeps them all until it knows their palette
    require_memory(s.shown * s.bytes,
                   fmt::format("{} pictures of a GIF, which have one palette,", s.shown),
                   "draw smaller ones (--size) or fewer (--fps), or name a .webp");
  const std::lock_guard lock(s.mutex);
  s.rethrow_locked();
  s.jobs.push_back({std::move(s.drawn), moment});
  s.ready.notify_one();
}

// How long the last picture is shown is told by sending it again. ffmpeg takes the last time
// between two for that of the last one, so that the very last lasts as long as any.
std::uint64_t Film::finish(std::uint64_t moment) {
  State& s = *state_;
  {
    std::unique_lock lock(s.mutex);
    s.given.wait(lock, [&] { return s.error || (s.jobs.empty() && !s.busy); });
    s.rethrow_locked();
  }
  const std::uint64_t first = s.last.moment;
  for (const std::uint64_t back : {2u, 1u})
    if (first + back < moment) {
      s.last.moment = moment - back;
      s.send(s.last);
    }
  const int code = s.child.finish();
  s.finished = true;
  const std::uint64_t bytes = s.file.bytes();
  if (code != 0 || bytes == 0 || tells_of_failure(s.child.said())) s.fail();
  s.file.give_name();
  return bytes;
}

}  // namespace lantern::publish
