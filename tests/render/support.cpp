#include "render/support.hpp"

#include <cstdlib>
#include <memory>
#include <ostream>
#include <utility>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file.hpp"
#include "render/renderer.hpp"

namespace lantern::render {

Theme plain_theme() {
  Theme theme{"plain", {}};
  theme.colors.fill({128, 128, 128});
  theme.colors[static_cast<std::size_t>(Role::paper)] = {255, 255, 255};
  theme.colors[static_cast<std::size_t>(Role::ink)] = {0, 0, 0};
  theme.colors[static_cast<std::size_t>(Role::warning)] = {255, 0, 0};
  return theme;
}

DrawList page_of(double width, double height, std::vector<DrawShape> shapes) {
  DrawList list;
  list.page = {width, height};
  list.shapes = std::move(shapes);
  return list;
}

namespace {

// The renderer of the last size asked for, kept within a test: the next one may make contexts of
// its own. It must go before main ends: in the exit handlers the GL library may be torn down before
// a static object of ours is.
class LastRenderer : public testing::EmptyTestEventListener {
 public:
  Renderer& of(int width, int height) {
    // A context is current from when it is made until the next one is: one at a time.
    if (!renderer_ || size_ != std::pair(width, height)) {
      renderer_.reset();
      renderer_ = std::make_unique<Renderer>(Context::create(Backend::automatic), width, height);
      size_ = {width, height};
    }
    return *renderer_;
  }
  void OnTestEnd(const testing::TestInfo&) override { renderer_.reset(); }

 private:
  std::unique_ptr<Renderer> renderer_;
  std::pair<int, int> size_;
};

LastRenderer& last_renderer = *[] {
  auto* listener = new LastRenderer;
  testing::UnitTest::GetInstance()->listeners().Append(listener);
  return listener;
}();

}  // namespace

Image drawn(const DrawList& list, int width, int height, bool transparent, const Theme& theme) {
  Image image;
  last_renderer.of(width, height).draw(list, theme, transparent, image);
  return image;
}

Rgba at(const Image& image, int x, int y) {
  const std::uint8_t* p = &image.rgba[4 * (static_cast<std::size_t>(y) * image.width + x)];
  return {p[0], p[1], p[2], p[3]};
}

std::ostream& operator<<(std::ostream& to, const Rgba& p) {
  return to << '(' << p.r << ", " << p.g << ", " << p.b << ", " << p.a << ')';
}

int run_in_new_process(const std::string& name, const std::map<std::string, std::string>& added) {
  const std::string filter = "--gtest_filter=" + name;
  const pid_t child = ::fork();
  if (child == 0) {
    // A share of the tests would leave out the very one that is asked for.
    ::unsetenv("GTEST_TOTAL_SHARDS");
    ::unsetenv("GTEST_SHARD_INDEX");
    for (const auto& [key, value] : added) ::setenv(key.c_str(), value.c_str(), 1);
    ::execl("/proc/self/exe", "tests_render", filter.c_str(), "--gtest_also_run_disabled_tests",
            "--gtest_brief=1", nullptr);
    ::_exit(127);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace lantern::render
