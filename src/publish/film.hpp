// Films: pictures on their way through ffmpeg into one file.
#pragma once

#include "base/file.hpp"
#include "render/renderer.hpp"
#include "rooms.hpp"

namespace lantern::publish {

enum class FilmKind { mp4, webm, gif, apng, webp };

// "mp4" ...; nothing for another ending.
std::optional<FilmKind> film_kind(std::string_view ending);

struct FilmSettings {
  FilmKind kind = FilmKind::mp4;
  int width = 0, height = 0;  // pixels; of an MP4 both are even
  double rate = 30;           // pictures a second
  bool transparent = false;   // an MP4 cannot be
  std::string title = {};
};

// Pictures a second where nobody says how many.
double usual_rate(FilmKind kind);

// Why there is no such film, and what to ask for instead; nothing if there is.
std::optional<std::string> film_problem(const FilmSettings& settings);

// The program that makes films. Throws IoError that names the package if the machine has none.
fs::path require_ffmpeg();

// What ffmpeg is told, but for its own name: it reads pictures with their times from its standard
// input (publish/film.cpp) and writes `file`, which is "file:" and a path. The same bytes
// whatever the machine's cores.
std::vector<std::string> film_words(const FilmSettings& settings, const std::string& file);

// A file that gets its name when it is whole. Each picture goes to ffmpeg once, with its time, an
// opaque one as an encoder of films takes it (render/planes.hpp); a thread gives it away while the
// next one is drawn, so that only a few are held. All calls belong to one thread. Each throws
// IoError, with ffmpeg's own words, if it has failed by then, and Stopped; then the film is given
// up.
class Film {
 public:
  // `ffmpeg` as require_ffmpeg() gives it; no film_problem(). Makes no folder.
  Film(const fs::path& ffmpeg, const FilmSettings& settings, const FilePlace& place);
  // Without finish(): what stood at the place still does, and nothing else is left.
  ~Film();

  // What was drawn, of the film's size, is shown from this moment on, which is later than the last
  // one, counted in pictures of the film's rate; the first is shown at 0. Takes over what differs
  // from the picture before, all if that was not this film's. Waits while too many are under way.
  void show(const Drawn& drawn, std::uint64_t moment);
  // The last one is shown until this moment. The bytes of the file, which has its name now.
  std::uint64_t finish(std::uint64_t moment);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lantern::publish
