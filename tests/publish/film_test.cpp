// Which films there are, and what one is told of by whom it is made.
#include "publish/film.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/memory.hpp"

namespace lantern::publish {
namespace {

namespace fs = std::filesystem;

FilmSettings film(FilmKind kind, double rate = 30) {
  FilmSettings settings;
  settings.kind = kind;
  settings.rate = rate;
  settings.width = 400;
  settings.height = 300;
  settings.title = "Two; -y \"words\"";
  return settings;
}

// A folder with a program in it that passes for ffmpeg, and reads all that comes.
fs::path silent_ffmpeg() {
  const fs::path folder = fs::path(LANTERN_TEST_OUTPUT) / "film";
  fs::remove_all(folder);
  make_folder(folder);
  write_file(folder / "ffmpeg", "#!/bin/sh\ncat >&3\n");
  fs::permissions(folder / "ffmpeg", fs::perms::owner_all);
  return folder / "ffmpeg";
}

void paint(Film& film, std::uint64_t moment) {
  Image& image = film.blank();
  image.rgba.assign(std::size_t{400} * 300 * 4, 7);
  film.show(moment);
}

TEST(Film, OfEachKindIsToldOfInOneWordEach) {
  for (const FilmKind kind :
       {FilmKind::mp4, FilmKind::webm, FilmKind::gif, FilmKind::apng, FilmKind::webp}) {
    const auto words = film_words(film(kind), "file:x");
    EXPECT_EQ(words.back(), "file:x");
    EXPECT_EQ(std::count(words.begin(), words.end(), "title=Two; -y \"words\""), 1);
  }
}

TEST(Film, RatesOfAGifAreWholeHundredths) {
  for (const double rate : {50.0, 25.0, 20.0, 12.5, 10.0, 100 / 3.0})
    EXPECT_FALSE(film_problem(film(FilmKind::gif, rate))) << rate;
  for (const double rate : {100.0, 60.0, 30.0, 24.0})
    EXPECT_TRUE(film_problem(film(FilmKind::gif, rate))) << rate;
  EXPECT_FALSE(film_problem(film(FilmKind::gif, usual_rate(FilmKind::gif))));
}

TEST(Film, HasItsNameWhenItIsWhole) {
  const fs::path ffmpeg = silent_ffmpeg(), file = ffmpeg.parent_path() / "x.webm";
  {
    Film given_up(ffmpeg, film(FilmKind::webm), file);
    paint(given_up, 0);
  }
  EXPECT_FALSE(fs::exists(file));
  Film whole(ffmpeg, film(FilmKind::webm), file);
  for (std::uint64_t moment = 0; moment < 20; ++moment) paint(whole, moment);
  EXPECT_FALSE(fs::exists(file));
  const std::uint64_t bytes = whole.finish(30);  // and twice more
  EXPECT_EQ(bytes, fs::file_size(file));
  EXPECT_NEAR(static_cast<double>(bytes), 22 * 400 * 300 * 4, 22 * 100);
  EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), {}), 2);
}

TEST(Film, OfOnePaletteNeedsRoomForAllPictures) {
  const fs::path ffmpeg = silent_ffmpeg();
  const std::uint64_t before = memory_budget();
  set_memory_budget(std::uint64_t{16} << 20);  // 34 pictures
  const auto paint_many = [&](FilmKind kind) {
    Film many(ffmpeg, film(kind), ffmpeg.parent_path() / "x");
    for (std::uint64_t moment = 0; moment < 40; ++moment) paint(many, moment);
  };
  EXPECT_THROW(paint_many(FilmKind::gif), Refused);
  EXPECT_NO_THROW(paint_many(FilmKind::webp));
  set_memory_budget(before);
}

}  // namespace
}  // namespace lantern::publish
