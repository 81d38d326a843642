// Boxes of a user's own, and what is wrong in their files.
#include <cstdint>
#include <cstring>
#include <fstream>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "fresh_folder.hpp"
#include "measure/boxes/worlds.hpp"

namespace lantern::measure {
namespace {

namespace fs = std::filesystem;

fs::path written(const std::string& name, const std::string& bytes) {
  static const fs::path folder = fresh_folder("box_files");
  std::ofstream(folder / name, std::ios::binary) << bytes;
  return folder / name;
}

// The first mistake told of the file.
Diagnostic mistake(const std::string& name, const std::string& bytes) {
  try {
    read_boxes(written(name, bytes), 1);
  } catch (const ScenarioError& error) {
    return error.diagnostics().at(0);
  }
  ADD_FAILURE() << "nothing is wrong with: " << bytes;
  return {};
}

TEST(BoxFiles, CsvHasCornersOrNamedColumns) {
  const BoxScene flat = read_boxes(written("flat.csv", "0,0,1,2\r\n# two\n\n 3 , 4,5,6"), 1);
  ASSERT_EQ(flat.dimension(), 2);
  EXPECT_EQ(flat.name, "flat");
  const auto& frames = std::get<BoxUpdates<2>>(flat.boxes).frames;
  ASSERT_EQ(frames[0].size(), 2u);
  EXPECT_EQ(frames[0][1].box, (Box<2>{{3, 4}, {5, 6}}));
  ASSERT_GT(frames.size(), 1u);
  EXPECT_NE(frames[1], frames[0]);
  const BoxScene solid = read_boxes(
      written("solid.csv", "static,x,y,z,half_x,half_y,half_z\n1,1,1,1,1,1,1\n0,4,4,4,1,2,3\n"), 1);
  const auto& space = std::get<BoxUpdates<3>>(solid.boxes).frames;
  EXPECT_EQ(space[0][1].box, (Box<3>{{3, 2, 1}, {5, 6, 7}}));
  EXPECT_TRUE(space[0][0].is_static);
  EXPECT_EQ(space[1][0], space[0][0]);
}

TEST(BoxFiles, CsvMayBeAnyTable) {
  const std::string text =
      "t;name;cx;cy;w;h;key\n0;a;1;2;2;4;7\n0;b;9;9;1;1;3\n1;b;8;9;1;1;3\n1;a;2;2;2;4;7\n";
  const BoxScene scene =
      read_boxes(written("any.csv", text), 1, "frame=t,x=cx,y=cy,width=w,height=h,id=key");
  const auto& frames = std::get<BoxUpdates<2>>(scene.boxes).frames;
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0][1].box, (Box<2>{{0, 0}, {2, 4}})) << "by their keys";
  EXPECT_EQ(frames[1][1].box, (Box<2>{{1, 0}, {3, 4}}));
  EXPECT_NE(scene.words.find("which move: 2 frames"), std::string::npos) << scene.words;
  EXPECT_NE(read_boxes(written("still.csv", "0,0,1,2\n3,4,5,6\n"), 1).words.find("at one moment"),
            std::string::npos);
  EXPECT_THROW(read_boxes(written("any.csv", text), 1, "x=cx,radius=w"), Refused);
}

TEST(BoxFiles, CsvMayBeInAnyOrderWithNamesForIds) {
  const BoxScene scene = read_boxes(
      written(
          "shuffled.csv",
          "frame\tid\tlo_x\tlo_y\thi_x\thi_y\tnote\n2\tant\t+8\t0\t9\t1\tx\n1\tbee\t0\t0\t1\t1\t\n"
          "1\tant\t5\t0\t6\t1\ty\n2\tbee\t0\t0\t1\t1\tz\n"),
      1);
  const auto& frames = std::get<BoxUpdates<2>>(scene.boxes).frames;
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0][0].box, (Box<2>{{5, 0}, {6, 1}})) << "of the ant";
  EXPECT_EQ(frames[1][0].box, (Box<2>{{8, 0}, {9, 1}}));
  EXPECT_EQ(frames[1][1].id, 1u);
  EXPECT_NE(scene.words.find("not used: note ("), std::string::npos) << scene.words;
  const BoxScene ends = read_boxes(written("ends.csv", "0,0,1,2,\n3,4,5,6,\n"), 1);
  EXPECT_EQ(std::get<BoxUpdates<2>>(ends.boxes).frames[0][1].box, (Box<2>{{3, 4}, {5, 6}}));
  std::string long_film = "frame,lo_x,lo_y,hi_x,hi_y\n";
  for (int frame = 0; frame < 30; ++frame)
    for (const char* box : {",0,0,1,1\n", ",2,2,3,3\n"}) long_film += std::to_string(frame) + box;
  EXPECT_NE(read_boxes(written("film.csv", long_film), 1).words.find("the first 24 of 30 frames"),
            std::string::npos);
}

// What --columns names is there, or the file would be misread.
TEST(BoxFiles, ColumnsThatAreNotThereAreTold) {
  const std::string text = "t,obj,lo_x,lo_y,hi_x,hi_y\n0,1,0,0,1,1\n0,2,1,1,2,2\n";
  const fs::path file = written("moving.csv", text);
  EXPECT_NE(read_boxes(file, 1).words.find("not used: t, obj ("), std::string::npos);
  for (const char* columns : {"frame=time", "x=foo", "id=obj,frame=time"}) {
    try {
      read_boxes(file, 1, columns);
      ADD_FAILURE() << columns;
    } catch (const ScenarioError& error) {
      const Diagnostic& told = error.diagnostics().at(0);
      EXPECT_NE(told.message.find("no column is called '"), std::string::npos) << told.message;
      EXPECT_EQ(told.suggestion, "there are t, obj, lo_x, lo_y, hi_x, hi_y");
      EXPECT_EQ(told.where.line, 1);
    }
  }
  EXPECT_EQ(read_boxes(file, 1, "frame=t,id=obj").words.find("not used"), std::string::npos);
}

TEST(BoxFiles, AllBadLinesOfCsvAreTold) {
  std::string text = "0,0,1,1\n";
  for (int i = 0; i < 14; ++i) text += "0,0,x,1\n";
  try {
    read_boxes(written("many.csv", text), 1);
    FAIL();
  } catch (const ScenarioError& error) {
    ASSERT_EQ(error.diagnostics().size(), 11u);
    EXPECT_EQ(error.diagnostics()[9].where.line, 11);
    EXPECT_EQ(error.diagnostics()[10].message, "4 more bad lines");
  }
}

TEST(BoxFiles, CsvMistakesHaveTheirPlace) {
  const struct {
    const char *text, *message;
    int line, column;
  } kMistakes[] = {
      {"0,0,1,1\n0,0,1\n", "3 values, where 4 are expected", 2, 5},
      {"0,0,1,1\n0,0,one,1\n", "'one' is no finite number", 2, 5},
      {"0,0,1,1\n0,0,1e400,1\n", "'1e400' is no finite number", 2, 5},
      {"0,0,nan,1\n", "'nan' is no finite number", 1, 5},
      {"2,0,1,1\n", "the box ends before it begins", 1, 5},
      {"x,y,half_x,half_y\n0,0,-1,1\n", "a half size is negative", 2, 5},
      {"x,y,half_x,hlf_y\n", "column 'half_y' is missing", 1, 1},
      {"x,y,width,height\n0,0,1,-1\n", "a size is negative", 2, 7},
      {"frame,id,lo_x,lo_y,hi_x,hi_y\n1,a,0,0,1,1\n2,a,0,0,1,1\n2,b,1,1,2,2\n",
       "box 'b' is not in the first frame, but in frame 2", 4, 1},
      {"frame,id,lo_x,lo_y,hi_x,hi_y\n1,7,0,0,1,1\n1,8,0,0,1,1\n2,8,1,1,2,2\n",
       "box 7 is not in frame 2", 2, 1},
      {"frame,id,lo_x,lo_y,hi_x,hi_y\n1,7,0,0,1,1\n2,7,0,0,1,1\n2,7,1,1,2,2\n",
       "box 7 is twice in frame 2", 4, 3},
      {"frame,lo_x,lo_y,hi_x,hi_y\n1,0,0,1,1\n1,1,1,2,2\n2,1,1,2,2\n", "box 1 is not in frame 2", 3,
       1},
      {"0,5;0;1;1\n", "'0,5' is no finite number", 1, 1},
      {"x,y,x,half_y\n", "column 'x' is there twice", 1, 5},
      {"lo_x,lo_y,hi_x\n", "column 'hi_y' is missing", 1, 1},
      {"lo_x,lo_y,hi_x,hi_y,half_x\n", "column 'x' is missing", 1, 1},
      {"static,lo_x,lo_y,hi_x,hi_y\n2,0,0,1,1\n", "static is 0 or 1", 2, 1},
  };
  for (const auto& one : kMistakes) {
    const Diagnostic told = mistake("bad.csv", one.text);
    EXPECT_EQ(told.message, one.message) << one.text;
    EXPECT_EQ(told.where.line, one.line) << one.text;
    EXPECT_EQ(told.where.column, one.column) << one.text;
    EXPECT_FALSE(told.source_line.empty());
  }
  EXPECT_EQ(mistake("bad.csv", "x,y,half_x,hlf_y\n").suggestion,
            "is it 'hlf_y'? --columns half_y=hlf_y");
  EXPECT_EQ(mistake("bad.csv", "0;0;1,5;1\n").suggestion, "write 0.5, not 0,5");
  EXPECT_THROW(read_boxes(written("empty.csv", ""), 1), Refused);
  EXPECT_THROW(read_boxes(written("one.csv", "0,0,1,1"), 1), Refused);
  EXPECT_THROW(read_boxes("no/such.csv", 1), IoError);
}

std::string broadmark(std::int32_t objects, std::int32_t told, int frames) {
  std::string bytes(256, '\0');
  const std::int32_t counts[] = {objects, told, 0, 0};
  bytes.append(reinterpret_cast<const char*>(counts), sizeof counts);
  const auto box = [&](float lo, float hi) {
    const float corners[] = {lo, lo, lo, 0, hi, hi, hi, 0};
    bytes.append(reinterpret_cast<const char*>(corners), sizeof corners);
  };
  box(-10, 10);
  for (int frame = 0; frame < frames; ++frame)
    for (int i = 0; i < objects; ++i)
      box(static_cast<float>(frame + i), static_cast<float>(frame + i + 2));
  return bytes;
}

TEST(BoxFiles, BroadmarksFramesAreRead) {
  const BoxScene scene = read_boxes(written("fall.aabbs", broadmark(3, 4, 5)), 1);
  const auto& frames = std::get<BoxUpdates<3>>(scene.boxes).frames;
  ASSERT_EQ(frames.size(), 5u);
  ASSERT_EQ(frames[4].size(), 3u);
  EXPECT_EQ(frames[4][2].box, (Box<3>{Vec<3>(6.0), Vec<3>(8.0)}));
}

TEST(BoxFiles, BroadmarksMistakesAreTold) {
  const std::string good = broadmark(3, 4, 5);
  EXPECT_NE(mistake("short.aabbs", good.substr(0, 300)).message.find("too short"),
            std::string::npos);
  EXPECT_NE(mistake("cut.aabbs", good.substr(0, good.size() - 8)).message.find("96 bytes a frame"),
            std::string::npos);
  EXPECT_NE(mistake("none.aabbs", broadmark(3, 4, 0)).message.find("a frame"), std::string::npos);
  EXPECT_NE(mistake("text.aabbs", std::string(500, 'x')).message.find("no counts"),
            std::string::npos);
  EXPECT_NE(mistake("negative.aabbs", broadmark(-1, 4, 1)).message.find("no counts"),
            std::string::npos);
  std::string inverted = good;
  const float far = 1e9f;
  std::memcpy(inverted.data() + 304 + 32, &far, sizeof far);
  EXPECT_NE(mistake("inverted.aabbs", inverted).message.find("object 1 of frame 0"),
            std::string::npos);
}

}  // namespace
}  // namespace lantern::measure
