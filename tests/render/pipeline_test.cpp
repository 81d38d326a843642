#include "render/pipeline.hpp"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <set>

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/resource.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "render/sample_scene.hpp"
#include "render/support.hpp"

// All threads are made by this: a test can let the machine refuse to make more than so many.
namespace {
std::atomic<int> threads_left = 1'000'000;
}

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes,
                              void* (*start)(void*), void* argument) noexcept {
  static const auto real =
      reinterpret_cast<decltype(&pthread_create)>(::dlsym(RTLD_NEXT, "pthread_create"));
  return threads_left-- > 0 ? real(thread, attributes, start, argument) : EAGAIN;
}

namespace lantern::render {
namespace {

namespace fs = std::filesystem;

Pipeline::Config config(int threads) {
  Pipeline::Config c;
  c.width = 320;
  c.height = 180;
  c.theme = *theme_named("light");
  c.pixels_per_metre = 5000;
  c.threads = threads;
  return c;
}

fs::path file(const fs::path& folder, int i) { return folder / (std::to_string(i) + ".png"); }

std::vector<PngText> texts(int i) { return {{"Frame", std::to_string(i)}}; }

TEST(Pipeline, FilesAreThoseOfOneThread) {
  constexpr int kFrames = 24;
  Renderer renderer(Context::create(Backend::automatic), 320, 180);
  std::vector<std::string> expected;
  for (int i = 0; i < kFrames; ++i) {
    Image image;
    renderer.draw(sample_scene(i / 2), *theme_named("light"), false, image);
    expected.push_back(encode_png(image, PngEffort::fast, texts(i), 5000));
  }
  for (int threads = 1; threads <= 4; ++threads) {
    const fs::path folder = fresh_folder("pipeline");
    Work work;
    Pipeline pipeline(renderer, config(threads), work);
    for (int i = 0; i < kFrames; ++i)
      pipeline.submit(sample_scene(i / 2), texts(i), file(folder, i));
    pipeline.finish();
    for (int i = 0; i < kFrames; ++i)
      ASSERT_TRUE(read_file(file(folder, i), 1 << 24) == expected[static_cast<std::size_t>(i)])
          << "frame " << i << " of " << threads << " threads";
    EXPECT_EQ(work.frames_drawn, 24u);
    EXPECT_EQ(work.frames_encoded, 12u) << "every second picture equals the one before";
  }
}

TEST(Pipeline, WhatDoesNotChangeIsNeitherDrawnNorEncoded) {
  const fs::path folder = fresh_folder("pipeline");
  Work work;
  Renderer renderer(Context::create(Backend::automatic), 320, 180);
  Pipeline pipeline(renderer, config(2), work);
  for (int i = 0; i < 5; ++i) pipeline.submit(sample_scene(), texts(i), file(folder, i));
  pipeline.finish();
  EXPECT_EQ(work.frames_drawn, 5u);
  EXPECT_EQ(work.frames_encoded, 1u);
  EXPECT_EQ(work.frames_written, 5u);
  EXPECT_EQ(work.pixels_drawn, 320u * 180u) << "once";
  EXPECT_EQ(work.bands_packed, 6u) << "of 32 rows";
  EXPECT_EQ(work.bands_kept, 0u) << "a picture that is the same has no bands of its own";

  DrawList list = sample_scene();
  list.shapes.emplace_back(rect(0, 0, 20, 20, Role::warning));
  pipeline.submit(list, texts(5), file(folder, 5));
  pipeline.finish();
  EXPECT_EQ(work.frames_encoded, 2u);
  EXPECT_EQ(work.bands_packed, 7u) << "what changed is in the first one";
  EXPECT_EQ(work.bands_kept, 5u);
  EXPECT_LE(work.pixels_drawn, 320u * 180u + 32u * 32u);
}

TEST(Pipeline, TellsOfEachFileOnceAndOneAtATime) {
  const fs::path folder = fresh_folder("pipeline");
  Pipeline::Config c = config(4);
  std::multiset<fs::path> written;
  std::atomic<int> inside = 0;
  c.written = [&](const fs::path& path) {
    EXPECT_EQ(++inside, 1) << "two calls at once";
    EXPECT_TRUE(fs::exists(path)) << "told before the file was there";
    written.insert(path);
    --inside;
  };
  Work work;
  Renderer renderer(Context::create(Backend::automatic), 320, 180);
  Pipeline pipeline(renderer, c, work);
  for (int i = 0; i < 30; ++i) pipeline.submit(sample_scene(i), texts(i), file(folder, i));
  pipeline.finish();
  EXPECT_EQ(written.size(), 30u);
  for (int i = 0; i < 30; ++i) EXPECT_EQ(written.count(file(folder, i)), 1u);
}

TEST(Pipeline, MakesDoWithTheThreadsThereAre) {
  const fs::path folder = fresh_folder("few-threads");
  Work work;
  for (const int possible : {0, 1, 3}) {
    Renderer renderer(Context::create(Backend::automatic), 320, 180);  // and its backend's threads
    threads_left = possible;
    try {
      Pipeline pipeline(renderer, config(8), work);
      threads_left = 1'000'000;
      for (int i = 0; i < 9; ++i) pipeline.submit(sample_scene(i), texts(i), file(folder, i));
      pipeline.finish();
      EXPECT_GT(possible, 0);
      for (int i = 0; i < 9; ++i) EXPECT_TRUE(fs::remove(file(folder, i))) << possible;
    } catch (const IoError& error) {
      EXPECT_EQ(possible, 0) << error.what();
      EXPECT_NE(std::string(error.what()).find("cannot start a thread"), std::string::npos);
    }
    threads_left = 1'000'000;
  }
}

// Submits until the pipeline gives up; true if it threw an IoError.
bool gives_up(Pipeline& pipeline, const Folder& folder) {
  try {
    for (int i = 0; i < 200; ++i)
      pipeline.submit(sample_scene(i), texts(i), {folder, std::to_string(i)});
    pipeline.finish();
  } catch (const IoError&) {
    return true;
  }
  return false;
}

TEST(Pipeline, StopsWhenTheFolderVanishes) {
  const fs::path folder = fresh_folder("vanishing");
  Work work;
  Renderer renderer(Context::create(Backend::automatic), 320, 180);
  Pipeline pipeline(renderer, config(3), work);
  pipeline.submit(sample_scene(), texts(0), file(folder, 0));
  pipeline.finish();
  const Folder held(folder);
  fs::remove_all(folder);
  EXPECT_TRUE(gives_up(pipeline, held));
  EXPECT_LT(work.frames_drawn, 100u) << "it went on drawing for nothing";
  EXPECT_THROW(pipeline.finish(), IoError) << "the error stays";
}

TEST(Pipeline, StopsWhenTheDiskIsFull) {
  const fs::path folder = fresh_folder("full");
  // A limit on the size of files fails in the same call of the system as a full disk.
  rlimit old{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old), 0);
  const rlimit tight{1000, old.rlim_max};
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  Work work;
  Renderer renderer(Context::create(Backend::automatic), 320, 180);
  Pipeline pipeline(renderer, config(2), work);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tight), 0);
  const bool stopped = gives_up(pipeline, Folder(folder));
  ::setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_TRUE(stopped);
  EXPECT_TRUE(fs::is_empty(folder)) << "half a frame was left";
}

TEST(Pipeline, RethrowsAnyErrorAsItWas) {
  struct Mine : std::runtime_error {
    using std::runtime_error::runtime_error;
  };
  const fs::path folder = fresh_folder("pipeline");
  Pipeline::Config c = config(2);
  c.written = [](const fs::path&) { throw Mine("mine"); };
  Work work;
  Renderer renderer(Context::create(Backend::automatic), 320, 180);
  Pipeline pipeline(renderer, c, work);
  EXPECT_THROW(
      {
        pipeline.submit(sample_scene(), texts(0), file(folder, 0));
        pipeline.finish();
      },
      Mine);
}

TEST(Pipeline, GivesUpWhatIsNotBegunWithoutFinish) {
  const fs::path folder = fresh_folder("pipeline");
  Work work;
  {
    Renderer renderer(Context::create(Backend::automatic), 320, 180);
    Pipeline pipeline(renderer, config(1), work);
    for (int i = 0; i < 4; ++i) pipeline.submit(sample_scene(i), texts(i), file(folder, i));
  }
  for (const auto& entry : fs::directory_iterator(folder))
    EXPECT_TRUE(decode_png(read_file(entry.path(), 1 << 24))) << "half a frame was left";
}

}  // namespace
}  // namespace lantern::render
