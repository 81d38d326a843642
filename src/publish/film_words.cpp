// What ffmpeg is told.
#include <cmath>

#include <fmt/format.h>

#include "publish/film.hpp"

namespace lantern::publish {
namespace {

using Words = std::vector<std::string>;

// Threads of an encoder decide its bytes, so that they are as many on every machine.
constexpr const char* kThreads = "4";

void add(Words& words, const Words& more) { words.insert(words.end(), more.begin(), more.end()); }

// As sRGB is looked at in a film: the numbers of BT.709, of which the file says so.
std::string in_bt709(const char* pixels) {
  return fmt::format(
      "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_inp,format={}",
      pixels);
}
const Words kBt709 = {"-color_primaries", "bt709", "-color_trc",   "bt709",
                      "-colorspace",      "bt709", "-color_range", "tv"};

// Presentation programs expect a picture at each moment; in the others a still is one picture.
void add_mp4(Words& words, const FilmSettings& s) {
  add(words, {"-vf", fmt::format("{},fps={}", in_bt709("yuv420p"), s.rate), "-c:v", "libx264",
              "-preset", "medium", "-crf", "18", "-threads", kThreads});
  add(words, kBt709);
  add(words, {"-movflags", "+faststart", "-f", "mp4"});
}

void add_webm(Words& words, const FilmSettings& s) {
  add(words, {"-vf",           in_bt709(s.transparent ? "yuva420p" : "yuv420p"),
              "-fps_mode",     "vfr",
              "-c:v",          "libvpx-vp9",
              "-crf",          "24",
              "-b:v",          "0",
              "-deadline",     "good",
              "-cpu-used",     "5",
              "-row-mt",       "1",
              "-tile-columns", "1",
              "-threads",      kThreads});
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

}  // namespace

std::vector<std::string> film_words(const FilmSettings& s, const std::string& file) {
  Words words = {"-nostdin", "-hide_banner", "-loglevel", "error", "-y",
                 "-f",       "matroska",     "-i",        "pipe:0"};
  switch (s.kind) {
    case FilmKind::mp4:
      add_mp4(words, s);
      break;
    case FilmKind::webm:
      add_webm(words, s);
      break;
    case FilmKind::gif:
      add_gif(words, s);
      break;
    case FilmKind::apng:
      add_apng(words, s);
      break;
    case FilmKind::webp:
      add_webp(words, s);
      break;
  }
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

}  // namespace lantern::publish
