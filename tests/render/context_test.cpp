#include "render/context.hpp"

#include <cstdlib>

#include <gtest/gtest.h>

#include "base/child.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "render/support.hpp"

namespace lantern::render {
namespace {

TEST(Context, NamesOfBackends) {
  EXPECT_EQ(backend_named("auto"), Backend::automatic);
  EXPECT_EQ(backend_named("osmesa"), Backend::osmesa);
  EXPECT_EQ(backend_named("egl"), Backend::egl);
  EXPECT_EQ(backend_named("glx"), std::nullopt);
}

TEST(Context, ReportsTellWhatWorksOrWhatToInstall) {
  for (const BackendReport& report : examine_backends()) {
    if (report.works) {
      EXPECT_NE(report.renderer.find("OpenGL"), std::string::npos) << report.renderer;
      EXPECT_EQ(report.problem, "");
    } else {
      EXPECT_NE(report.problem.find("package"), std::string::npos) << report.problem;
    }
  }
}

TEST(Context, AutomaticPrefersOsmesa) {
  EXPECT_EQ(Context::create(Backend::automatic)->backend(), "osmesa");
  EXPECT_EQ(Context::create(Backend::egl)->backend(), "egl");
}

TEST(Library, SaysWhyNothingCouldBeLoaded) {
  const Library library({"libnosuch.so.1", "libnosuch.so"});
  EXPECT_FALSE(library.loaded());
  EXPECT_EQ(library.name(), "libnosuch.so");
  EXPECT_NE(library.problem().find("libnosuch"), std::string::npos) << library.problem();
  EXPECT_EQ(library.symbol("anything"), nullptr);
}

// EGL's loader finds no driver then, as on a machine without Mesa's.
TEST(DISABLED_Child, HasNoEglDriver) {
  try {
    Context::create(Backend::egl);
    FAIL() << "a context without a driver";
  } catch (const BackendError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("libgl1-mesa-dri"), std::string::npos) << text;
  }
  EXPECT_EQ(Context::create(Backend::automatic)->backend(), "osmesa");
}

TEST(Context, WithoutDriverNamesThePackage) {
  EXPECT_EQ(run_in_new_process("DISABLED_Child.HasNoEglDriver",
                               {{"__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json"}}),
            0);
}

// Mesa warns of missing graphics cards on standard error; a user would take it for our failure.
TEST(DISABLED_Child, StartsBothBackends) {
  Context::create(Backend::osmesa);
  Context::create(Backend::egl);
}

TEST(Context, StartsSilently) {
  const auto path = fresh_folder("silence") / "stderr";
  testing::internal::CaptureStderr();
  EXPECT_EQ(run_in_new_process("DISABLED_Child.StartsBothBackends", {}), 0);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace lantern::render
