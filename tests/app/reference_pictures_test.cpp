// The pictures of the reference page are what Lantern draws of its examples today.
#include <gtest/gtest.h>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

TEST(ReferencePictures, AreTodaysAndSmall) {
  const fs::path folder = fresh_folder("reference");
  fs::copy(repository("scenarios/reference"), folder, fs::copy_options::recursive);
  const Outcome o = shell("lantern reference --pictures " + folder.string());
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find(", 0 of them new"), std::string::npos)
      << o.out << "draw them anew: build/lantern reference --pictures scenarios/reference";
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(folder)) bytes += entry.file_size();
  EXPECT_LT(bytes, 480u << 10);
}

TEST(ReferencePictures, AreDrawnAnewWhereTheyAreNotRight) {
  const fs::path folder = fresh_folder("reference-again");
  fs::copy(repository("scenarios/reference"), folder, fs::copy_options::recursive);
  write_text(folder / "looks.png", "no picture");
  const Outcome o = shell("lantern reference --pictures " + folder.string());
  EXPECT_NE(o.out.find(", 1 of them new"), std::string::npos) << o.out << o.err;
  EXPECT_EQ(read_text(folder / "looks.png"),
            read_text(repository("scenarios/reference/looks.png")));
}

}  // namespace
}  // namespace lantern::app
