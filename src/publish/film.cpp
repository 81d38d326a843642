#include "publish/film.hpp"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <exception>
#include <mutex>
#include <sstream>
#include <stop_token>
#include <system_error>
#include <thread>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/check.hpp"
#include "base/child.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/printable.hpp"
#include "render/planes.hpp"

namespace lantern::publish {
namespace {

std::string big_endian(std::uint64_t number) {
  std::string bytes;
  for (int shift = 56; shift >= 0; shift -= 8)
    bytes += static_cast<char>(static_cast<unsigned char>(number >> shift));
  return bytes;
}

// The length of an element, in 8 bytes of which the first one says so.
std::string length(std::uint64_t bytes) { return big_endian(bytes | std::uint64_t{1} << 56); }

std::string element(std::string_view id, const std::string& content) {
  return std::string(id) + length(content.size()) + content;
}
std::string element(std::string_view id, std::uint64_t number) {
  return element(id, big_endian(number));
}

// As planes.hpp makes them: what MP4 takes, and WebM without transparency.
bool is_planar(const FilmSettings& s) {
  return s.kind == FilmKind::mp4 || (s.kind == FilmKind::webm && !s.transparent);
}

std::size_t picture_bytes(const FilmSettings& s) {
  if (is_planar(s)) return planes_bytes(s.width, s.height);
  return std::size_t{4} * static_cast<std::size_t>(s.width) * static_cast<std::size_t>(s.height);
}

// Matroska, RFC 9559: what stands before the first picture.
std::string stream_start(const FilmSettings& s) {
  constexpr std::string_view kUnknownLength = "\x01\xff\xff\xff\xff\xff\xff\xff";
  const std::string head =
      element("\x1a\x45\xdf\xa3", element("\x42\x82", "matroska") + element("\x42\x87", 4) +
                                      element("\x42\x85", 2));  // DocType, versions
  const auto nanoseconds = static_cast<std::uint64_t>(std::llround(1e9 / s.rate));
  const std::string info = element("\x15\x49\xa9\x66", element("\x2a\xd7\xb1", nanoseconds));
  std::string video = element("\xb0", static_cast<std::uint64_t>(s.width)) +
                      element("\xba", static_cast<std::uint64_t>(s.height)) +
                      element("\x2e\xb5\x24", is_planar(s) ? "I420" : "RGBA");
  if (is_planar(s))  // matrix, colours' place, range, transfer, primaries
    video += element("\x55\xb0", element("\x55\xb1", 1) + element("\x55\xb7", 1) +
                                     element("\x55\xb8", 2) + element("\x55\xb9", 1) +
                                     element("\x55\xba", 1) + element("\x55\xbb", 1));
  const std::string track = element("\xd7", 1) + element("\x73\xc5", 1) +  // number, unique id
                            element("\x83", 1) +                           // it is video
                            element("\x86", "V_UNCOMPRESSED") + element("\xe0", video);
  return head + "\x18\x53\x80\x67" + std::string(kUnknownLength) + info +
         element("\x16\x54\xae\x6b", element("\xae", track));
}

std::string stream_picture(std::uint64_t moment, std::size_t bytes) {
  using namespace std::string_literals;
  const std::string timestamp = element("\xe7", moment);
  const std::string about = "\x81\x00\x00\x80"s;  // of track 1, at the cluster's time, a key frame
  const std::string block = "\xa3" + length(about.size() + bytes) + about;
  return "\x1f\x43\xb6\x75" + length(timestamp.size() + block.size() + bytes) + timestamp + block;
}

using Words = std::vector<std::string>;

// Threads of an encoder decide its bytes, so that they are as many on every machine.
constexpr const char* kThreads = "4";

void add(Words& words, const Words& more) { words.insert(words.end(), more.begin(), more.end()); }

// As sRGB is looked at in a film: the numbers of BT.709, of which the file says so.
const Words kBt709 = {"-color_primaries", "bt709", "-color_trc",   "bt709",
                      "-colorspace",      "bt709", "-color_range", "tv"};

// Presentation programs expect a picture at each moment; in the others a still is one picture.
void add_mp4(Words& words, const FilmSettings& s) {
  add(words, {"-vf", fmt::format("fps={}", s.rate), "-c:v", "libx264", "-preset", "medium", "-crf",
              "18", "-threads", kThreads});
  add(words, kBt709);
  add(words, {"-movflags", "+faststart", "-f", "mp4"});
}

void add_webm(Words& words, const FilmSettings& s) {
  if (s.transparent)
    add(words, {"-vf",
                "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_inp,"
                "format=yuva420p"});
  add(words,
      {"-fps_mode", "vfr", "-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-deadline", "good",
       "-cpu-used", "5", "-row-mt", "1", "-tile-columns", "1", "-threads", kThreads});
  if (s.transparent) add(words, {"-auto-alt-ref", "0"});  // it knows no alpha
  add(words, kBt709);
  add(words, {"-f", "webm"});
}

// One palette of all pictures: with one each, nothing could be left as it was.
void add_gif(Words& words, const FilmSettings& s) {
  add(words, {"-vf",
              fmt::format("split[a][b];[a]palettegen=reserve_transparent={}[p];"
                          "[b][p]paletteuse=dither=none",
                          s.transparent ? 1 : 0),
              "-fps_mode", "vfr", "-loop", "0", "-f", "gif"});
}

void add_apng(Words& words, const FilmSettings& s) {
  add(words, {"-vf", s.transparent ? "format=rgba" : "format=rgb24", "-fps_mode", "vfr", "-c:v",
              "apng", "-pred", "mixed", "-plays", "0", "-f", "apng"});
}

void add_webp(Words& words, const FilmSettings& s) {
  add(words, {"-vf", s.transparent ? "format=bgra" : "format=bgr0", "-fps_mode", "vfr", "-c:v",
              "libwebp_anim", "-lossless", "1", "-loop", "0", "-f", "webp"});
}

struct FilmFormat {
  std::string_view ending;
  FilmKind kind;
  void (*add)(Words& words, const FilmSettings& settings);
};
constexpr FilmFormat kFormats[] = {{"mp4", FilmKind::mp4, add_mp4},
                                   {"webm", FilmKind::webm, add_webm},
                                   {"gif", FilmKind::gif, add_gif},
                                   {"apng", FilmKind::apng, add_apng},
                                   {"webp", FilmKind::webp, add_webp}};

// The one shown last; one waits, one is on its way, and the last one may be sent again.
constexpr std::size_t kPictures = 4;

// As ffmpeg opens it.
std::string film_target(const PartFile& file) {
  return "file:" + (file.temporary().empty() ? fmt::format("/proc/self/fd/{}", Child::kHandedOn)
                                             : file.temporary().string());
}

std::vector<std::string> film_command(const fs::path& ffmpeg, const FilmSettings& settings,
                                      const PartFile& file) {
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
  const auto found = std::ranges::find(kFormats, ending, &FilmFormat::ending);
  return found == std::end(kFormats) ? std::nullopt : std::optional(found->kind);
}

std::vector<std::string> film_words(const FilmSettings& s, const std::string& file) {
  Words words = {"-nostdin", "-hide_banner", "-loglevel", "error", "-y",
                 "-f",       "matroska",     "-i",        "pipe:0"};
  std::ranges::find(kFormats, s.kind, &FilmFormat::kind)->add(words, s);
  add(words,
      {"-metadata", "title=" + s.title, "-fflags", "+bitexact", "-flags:v", "+bitexact", file});
  return words;
}

double usual_rate(FilmKind kind) { return kind == FilmKind::gif ? 25 : 30; }

std::optional<std::string> film_problem(const FilmSettings& s) {
  if (s.kind == FilmKind::mp4 && s.transparent)
    return "an MP4 has no transparency; name a .webm, .webp, .apng or .gif";
  if (s.kind == FilmKind::mp4 && (s.width % 2 != 0 || s.height % 2 != 0))
    return fmt::format("an MP4 has even sides: --size {}x{}", s.width + s.width % 2,
                       s.height + s.height % 2);
  // Less than two hundredths are shown as ten.
  const double hundredths = 100 / s.rate, whole = std::round(hundredths);
  if (s.kind == FilmKind::gif && (whole < 2 || std::abs(hundredths - whole) > 1e-3))
    return fmt::format(
        "a GIF counts in hundredths of a second, two at least: --fps 50, 25, 20, 12.5 or 10");
  return std::nullopt;
}

fs::path require_ffmpeg() {
  if (const auto found = find_program("ffmpeg")) return *found;
  throw IoError("films are made by ffmpeg, which is not on the PATH: apt-get install ffmpeg");
}

struct Film::State {
  struct Job {
    std::vector<std::uint8_t> picture;
    std::uint64_t moment = 0;
  };

  State(const fs::path& ffmpeg, const FilmSettings& s, const FilePlace& where)
      : settings(s),
        path(where.path()),
        bytes(picture_bytes(s)),
        file(where),
        child(film_command(ffmpeg, s, file), file.descriptor()) {
    for (std::size_t i = 1; i < kPictures; ++i) blank.emplace_back();
  }

  // Also while the thread waits for ffmpeg to read on.
  ~State() {
    if (!finished) child.end();
  }

  void take(const Drawn& drawn);
  void give_away(const std::stop_token& stop);
  void send(const Job& job);
  void fail();
  void rethrow_locked() const {
    if (error) std::rethrow_exception(error);
  }

  const FilmSettings settings;
  const fs::path path;
  const std::size_t bytes;  // of a picture
  PartFile file;
  Child child;
  std::vector<std::uint8_t> picture;  // shown last,
  std::uint64_t number = 0;           // of it
  std::uint64_t shown = 0;            // pictures
  bool begun = false, finished = false;

  std::mutex mutex;
  std::condition_variable_any ready;
  std::condition_variable given;
  std::vector<std::vector<std::uint8_t>> blank;
  std::deque<Job> jobs;
  Job last;  // that was sent
  bool busy = false;
  std::exception_ptr error;
  std::jthread thread;  // the last member: it ends first
};

void Film::State::fail() {
  const int code = child.finish();
  const std::string words = last_words(child.said(), film_target(file), path.string());
  throw IoError("cannot make '{}': ffmpeg {} {}{}{}", printable(path.string()),
                code > 128  ? "was ended by signal"
                : code == 0 ? "wrote no whole film, and ended with exit code"
                            : "failed with exit code",
                code > 128 ? code - 128 : code, words.empty() ? "" : ": ", words);
}

void Film::State::send(const Job& job) {
  std::string head = begun ? "" : stream_start(settings);
  begun = true;
  head += stream_picture(job.moment, job.picture.size());
  if (!child.write(head) ||
      !child.write({reinterpret_cast<const char*>(job.picture.data()), job.picture.size()}))
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
    if (!last.picture.empty()) blank.push_back(std::move(last.picture));
    last = std::move(job);
    error = problem;
    given.notify_all();
    if (error) return;
  }
}

Film::Film(const fs::path& ffmpeg, const FilmSettings& settings, const FilePlace& place)
    : state_((require_memory(picture_bytes(settings) * kPictures, "pictures of a film",
                             "draw smaller ones (--size)"),
              std::make_unique<State>(ffmpeg, settings, place))) {
  State& s = *state_;
  try {
    s.thread = std::jthread([&s](const std::stop_token& stop) { s.give_away(stop); });
  } catch (const std::system_error& problem) {
    throw IoError("cannot start a thread: {}", problem.code().message());
  }
}

Film::~Film() = default;

void Film::State::take(const Drawn& drawn) {
  LANTERN_CHECK(drawn.image.width, ==, settings.width);
  LANTERN_CHECK(drawn.image.height, ==, settings.height);
  const std::vector<PixelRect> all = {{0, 0, settings.width, settings.height}};
  const bool follows = !picture.empty() && drawn.before == number;
  picture.resize(bytes);
  number = drawn.number;
  for (const PixelRect& part : follows ? drawn.parts : all) {
    if (is_planar(settings)) {
      put_planes(drawn.image, part, picture);
      continue;
    }
    for (int y = part.y0; y < part.y1; ++y) {
      const std::size_t at = 4 * (static_cast<std::size_t>(y) * settings.width + part.x0);
      std::memcpy(&picture[at], &drawn.image.rgba[at], std::size_t{4} * (part.x1 - part.x0));
    }
  }
}

void Film::show(const Drawn& drawn, std::uint64_t moment) {
  State& s = *state_;
  ++s.shown;
  if (s.settings.kind == FilmKind::gif)  // ffmpeg keeps them all until it knows their palette
    require_memory(s.shown * s.bytes,
                   fmt::format("{} pictures of a GIF, which have one palette,", s.shown),
                   "draw smaller ones (--size) or fewer (--fps), or name a .webp");
  s.take(drawn);
  std::unique_lock lock(s.mutex);
  s.given.wait(lock, [&] { return s.error || !s.blank.empty(); });
  s.rethrow_locked();
  State::Job& job = s.jobs.emplace_back(std::move(s.blank.back()), moment);
  s.blank.pop_back();
  job.picture = s.picture;
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
