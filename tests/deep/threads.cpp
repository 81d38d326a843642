// The threads that encode, fed with images by hand, so that the thread sanitizer sees them without
// a graphics driver: see threads.sh.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <thread>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/random.hpp"
#include "base/stop.hpp"
#include "render/pipeline.hpp"

namespace lantern::render {
namespace {

namespace fs = std::filesystem;

int failures = 0;

void expect(bool holds, const std::string& what) {
  if (!holds) fmt::print("FAILED: {}\n", what);
  failures += !holds;
}

// Every third one equals the one before.
void paint(Image& image, int number, int side) {
  image.width = image.height = side;
  image.rgba.resize(std::size_t{4} * side * side);
  Random random(static_cast<std::uint64_t>(number - (number % 3 == 2)));
  for (std::uint8_t& byte : image.rgba)
    byte = static_cast<std::uint8_t>(random.bits() % 4 == 0 ? random.bits() : 255);
}

// The rows in which an image differs from the one before.
std::vector<bool> changed(const Image& image, const Image& before) {
  std::vector<bool> rows(static_cast<std::size_t>(image.height), true);
  const auto bytes = std::ptrdiff_t{4} * image.width;
  for (std::size_t y = 0; y < rows.size() && image.rgba.size() == before.rgba.size(); ++y) {
    const auto first = static_cast<std::ptrdiff_t>(y) * bytes;
    rows[y] = !std::equal(image.rgba.begin() + first, image.rgba.begin() + first + bytes,
                          before.rgba.begin() + first);
  }
  return rows;
}

// Each image is painted over the one before, while that may still wait to be encoded.
struct Painter {
  Image image;
  void submit(EncodePool& pool, int number, int side, const fs::path& path);
};

std::vector<PngText> texts(int number) { return {{"Frame", std::to_string(number)}}; }

void Painter::submit(EncodePool& pool, int number, int side, const fs::path& path) {
  const Image before = image;
  paint(image, number, side);
  pool.submit(image, changed(image, before), texts(number), path);
}

EncodePool::Config config(int threads, int side) {
  EncodePool::Config c;
  c.width = c.height = side;
  c.effort = threads % 2 == 0 ? PngEffort::small : PngEffort::fast;
  c.threads = threads;
  return c;
}

void writes_what_one_thread_writes(const fs::path& folder, int threads) {
  constexpr int kFrames = 90, kSide = 40;
  Work work;
  std::vector<fs::path> told;  // one thread at a time
  EncodePool::Config c = config(threads, kSide);
  c.written = [&](const fs::path& path) { told.push_back(path); };
  EncodePool pool(c, work);
  Painter painter;
  for (int i = 0; i < kFrames; ++i) {
    painter.submit(pool, i, kSide, folder / std::to_string(i));
  }
  pool.finish();
  expect(told.size() == kFrames, "each file is told once");
  expect(work.frames_encoded == 2 * kFrames / 3, "equal images are encoded once");
  for (int i = 0; i < kFrames; ++i) {
    Image image;
    paint(image, i, kSide);
    expect(
        read_file(folder / std::to_string(i), 1 << 20) == encode_png(image, c.effort, texts(i), 0),
        fmt::format("file {} of {} threads", i, threads));
  }
}

void an_error_ends_it(const fs::path& folder, int threads) {
  Work work;
  EncodePool pool(config(threads, 16), work);
  Painter painter;
  bool thrown = false;
  try {
    for (int i = 0; i < 200; ++i) {
      painter.submit(pool, i, 16, i < 20 ? folder / std::to_string(i) : folder / "none" / "x");
    }
    pool.finish();
  } catch (const IoError&) {
    thrown = true;
  }
  expect(thrown, "a file that cannot be written is told");
}

// A signal's wish, heard while pictures are under way, and the end without finish().
void may_be_given_up(const fs::path& folder, int threads) {
  Work work;
  std::jthread signal([] { ask_to_stop(); });
  try {
    EncodePool pool(config(threads, 64), work);
    Painter painter;
    for (int i = 0; i < 30; ++i) {
      painter.submit(pool, i, 64, folder / std::to_string(i));
    }
  } catch (const Stopped&) {
    // where it was heard
  }
  signal.join();
  forget_stop();
}

// All threads want the same picture, and the one that encodes it hears the wish.
void what_others_wait_for_may_be_given_up(const fs::path& folder, int threads) {
  constexpr int kSide = 600;
  Work work;
  EncodePool::Config c = config(threads, kSide);
  c.effort = PngEffort::fast;  // hears it at each row
  Image image;
  paint(image, 0, kSide);
  std::vector<bool> rows(kSide, true);
  try {
    EncodePool pool(c, work);
    for (int i = 0; i < threads; ++i, rows.assign(kSide, false))
      pool.submit(image, rows, texts(i), folder / std::to_string(i));
    ask_to_stop();
    pool.finish();
  } catch (const Stopped&) {
    // as wished, if it was not done before
  }
  forget_stop();
}

int run(const fs::path& folder) {
  for (int threads = 1; threads <= 8; ++threads) {
    writes_what_one_thread_writes(folder, threads);
    an_error_ends_it(folder, threads);
    may_be_given_up(folder, threads);
    what_others_wait_for_may_be_given_up(folder, threads);
  }
  fmt::print("{} threads and fewer, {} failures\n", 8, failures);
  return failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace lantern::render

int main(int argc, char** argv) { return argc == 2 ? lantern::render::run(argv[1]) : 2; }
