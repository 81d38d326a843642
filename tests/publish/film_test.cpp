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

// The picture of this number, of which `parts` differ from that of the number before.
void show(Film& film, std::uint64_t moment, std::uint64_t before, std::uint64_t number,
          std::uint8_t grey, const std::vector<PixelRect>& parts) {
  const Image image{400, 300, std::vector<std::uint8_t>(std::size_t{400} * 300 * 4, grey)};
  film.show({image, std::vector<bool>(300, true), parts, 0, number, before}, moment);
}
void paint(Film& film, std::uint64_t moment) { show(film, moment, moment, moment + 1, 7, {}); }

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
  EXPECT_NEAR(static_cast<double>(bytes), 22 * 400 * 300 * 3 / 2, 22 * 100);
  EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), {}), 2);
}

// The pictures of what was written, each a grey of one part and one of the rest.
TEST(Film, TakesOverWhatDiffersUnlessAnotherPictureCameBetween) {
  const fs::path ffmpeg = silent_ffmpeg(), file = ffmpeg.parent_path() / "x.webp";
  const std::vector<PixelRect> part = {{0, 0, 32, 16}};
  Film whole(ffmpeg, film(FilmKind::webp), file);
  show(whole, 0, 4, 5, 10, part);    // the first one: all, whatever was drawn before
  show(whole, 1, 5, 9, 20, part);    // others drew, but not this renderer
  show(whole, 2, 10, 11, 30, part);  // the tenth was not shown here
  whole.finish(3);
  const std::string written = read_file(file, std::size_t{1} << 30);
  const auto count = [&](char grey) {
    return static_cast<int>(std::count(written.begin(), written.end(), grey));
  };
  constexpr int kAll = 400 * 300 * 4, kPart = 32 * 16 * 4, kHeads = 200;
  EXPECT_NEAR(count(10), 2 * kAll - kPart, kHeads);
  EXPECT_NEAR(count(20), kPart, kHeads);
  EXPECT_NEAR(count(30), kAll, kHeads);
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
