// The same bytes on both backends, with any number of threads, on any CPU. Each way runs in a
// process of its own, since Mesa reads its settings but once.
#include <cstdlib>

#include <gtest/gtest.h>

#include "base/file.hpp"
#include "render/renderer.hpp"
#include "render/sample_scene.hpp"
#include "render/support.hpp"

namespace lantern::render {
namespace {

void append(std::string& to, const Image& image) {
  to.append(reinterpret_cast<const char*>(image.rgba.data()), image.rgba.size());
}

// All kinds of shapes, in sizes where a page unit is no whole number of pixels.
std::string pictures(Backend backend) {
  std::string bytes;
  for (const auto& [width, height] : {std::pair{1280, 720}, {1001, 567}}) {
    Renderer renderer(Context::create(backend), width, height);
    Image image;
    for (const int step : {0, 3, 0}) {
      renderer.draw(sample_scene(step), *theme_named("light"), false, image);
      append(bytes, image);
    }
    renderer.draw(sample_scene(1), *theme_named("dark"), true, image);
    append(bytes, image);
  }
  return bytes;
}

TEST(DISABLED_Child, DrawsPictures) {
  const char* path = std::getenv("LANTERN_TEST_PICTURES");
  const char* backend = std::getenv("LANTERN_TEST_BACKEND");
  ASSERT_TRUE(path && backend);
  write_file(path, pictures(*backend_named(backend)));
}

std::string pictures_in_new_process(const std::string& backend,
                                    std::map<std::string, std::string> variables) {
  const auto path = fresh_folder("backends") / "pictures";
  variables["LANTERN_TEST_PICTURES"] = path.string();
  variables["LANTERN_TEST_BACKEND"] = backend;
  // Mesa's cache might hand us code that it compiled with other settings.
  variables["MESA_SHADER_CACHE_DISABLE"] = "1";
  EXPECT_EQ(run_in_new_process("DISABLED_Child.DrawsPictures", variables), 0);
  return read_file(path, std::size_t{1} << 30);
}

using Way = std::pair<const char*, std::map<std::string, std::string>>;

class SameBytes : public testing::TestWithParam<Way> {};

TEST_P(SameBytes, AsInThisProcess) {
  static const std::string expected = pictures(Backend::osmesa);
  const std::string actual = pictures_in_new_process(GetParam().first, GetParam().second);
  ASSERT_EQ(actual.size(), expected.size());
  std::size_t differing = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) differing += actual[i] != expected[i];
  EXPECT_EQ(differing, 0u) << "channels differ: golden images would hold on one machine only";
}

// The rest is Mesa's own work, which the sanitizers do not watch: the release build draws so.
const Way kWays[] = {
    {"egl", {}},
#ifndef __SANITIZE_ADDRESS__
    {"osmesa", {{"LP_NUM_THREADS", "0"}}},
    {"osmesa", {{"LP_NUM_THREADS", "1"}}},
    {"osmesa", {{"LP_NUM_THREADS", "2"}}},
    {"egl", {{"LP_NUM_THREADS", "0"}}},
    {"osmesa", {{"GALLIUM_OVERRIDE_CPU_CAPS", "sse2"}}},
    {"osmesa", {{"GALLIUM_OVERRIDE_CPU_CAPS", "avx"}}},
    {"osmesa", {{"GALLIUM_OVERRIDE_CPU_CAPS", "avx2"}}},
    {"egl", {{"GALLIUM_OVERRIDE_CPU_CAPS", "sse2"}}},
    {"osmesa", {{"LP_NATIVE_VECTOR_WIDTH", "128"}}},
#endif
};

std::string way_name(const testing::TestParamInfo<Way>& info) {
  std::string name = info.param.first;
  for (const auto& [key, value] : info.param.second) name += "_" + key + "_" + value;
  return name;
}

INSTANTIATE_TEST_SUITE_P(Ways, SameBytes, testing::ValuesIn(kWays), way_name);

TEST(Renderer, FirstFrameHasTheBytesOfLaterOnes) {
  // The first frames are drawn without the programs that later ones use for insides and masks.
  Renderer renderer(Context::create(Backend::automatic), 1600, 900);
  Image first, last;
  renderer.draw(sample_scene(), *theme_named("light"), false, first);
  for (int i = 0; i < 20; ++i) {  // all is drawn anew, until other programs are worth compiling
    renderer.draw(sample_scene(), *theme_named("dark"), false, last);
    renderer.draw(sample_scene(), *theme_named("light"), false, last);
  }
  EXPECT_EQ(first, last) << "a frame would depend on whether it was rendered alone";
}

TEST(Renderer, FrameDoesNotDependOnTheFramesBeforeIt) {
  Renderer used(Context::create(Backend::automatic), 800, 450);
  Image image, alone;
  for (int step = 0; step < 60; ++step) {  // enough to empty the store of masks in between
    DrawList list = sample_scene(step);
    for (int i = 0; i < 8; ++i) add_ghost(list, 300 + 0.37 * step, 300, 200 + i, 1);
    used.draw(list, *theme_named("light"), step % 3 == 0, image);
  }
  used.draw(sample_scene(7), *theme_named("light"), false, image);
  Renderer fresh(Context::create(Backend::automatic), 800, 450);
  fresh.draw(sample_scene(7), *theme_named("light"), false, alone);
  EXPECT_EQ(image, alone) << "frame N would not be the same frame alone and in a range";
}

}  // namespace
}  // namespace lantern::render
