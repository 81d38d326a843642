// The table of rooms: which room may include which.
#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

// A room sees the rooms of its row and what they see.
const std::map<std::string, std::set<std::string>> kRooms = {
    {"base", {}},
    {"geometry", {"base"}},
    {"lecture", {"geometry"}},
    {"spatial", {"lecture"}},
    {"atlas", {"geometry"}},
    {"physics", {"spatial"}},
    {"language", {"physics", "atlas"}},
    {"frame", {"language"}},
    {"run", {"frame"}},
    {"draw", {"frame"}},
    {"render", {"draw"}},
    {"publish", {"render"}},
    {"live", {"publish", "run"}},
    {"measure", {"run"}},
    {"peers", {"measure"}},
    {"report", {"measure", "draw", "render"}},
    {"app", {"publish", "run"}},
    {"lab", {"app", "report"}},
};

std::set<std::string> seen_from(const std::string& room) {
  std::set<std::string> seen{room};
  for (const std::string& next : kRooms.at(room)) seen.merge(seen_from(next));
  return seen;
}

// "physics" of src/physics/contact/rows.cpp; "src" of what stands in no room.
std::string room_of(const fs::path& path) {
  const fs::path below = path.lexically_relative(repository("src"));
  return std::distance(below.begin(), below.end()) == 1 ? "src" : below.begin()->string();
}

// The sources and headers of src/.
std::vector<fs::path> sources() {
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(repository("src")))
    if (entry.path().extension() == ".cpp" || entry.path().extension() == ".hpp")
      found.push_back(entry.path());
  return found;
}

TEST(Rooms, IncludeOnlyWhatTheTableAllows) {
  const std::regex include("^\\s*#include \"([a-z_]+)/");
  std::size_t includes = 0;
  for (const fs::path& path : sources()) {
    const std::string room = room_of(path);
    if (room == "src" || room == "web") continue;  // rooms.hpp, main.cpp, a page's machine: in none
    ASSERT_TRUE(kRooms.contains(room)) << path << " stands in no room of the table";
    const std::set<std::string> allowed = seen_from(room);
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
      std::smatch match;
      if (!std::regex_search(line, match, include) || match[1] == "embedded") continue;
      ++includes;
      EXPECT_TRUE(allowed.contains(match[1]))
          << path << " includes " << match[1] << ", which its room may not see";
    }
  }
  EXPECT_GT(includes, 100u) << "the search for includes found next to none: is it broken?";
}

// A source's own constant would hide it from the sources that are compiled after it in one unit, so
// that a unity build would draw with another number than any other.
TEST(Rooms, ConstantsOfTheirHeadersAreHiddenByNoSource) {
  const std::regex shared("^inline const\\S* .*\\b(k[A-Z]\\w*)( =|\\{)");
  const std::regex own("\\b(k[A-Z]\\w*)( = |\\{|\\[)");
  std::map<std::string, std::set<std::string>> known;  // by room
  const auto each_line = [](const fs::path& path, const auto& look) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) look(line);
  };
  for (const fs::path& path : sources())
    if (path.extension() == ".hpp")
      each_line(path, [&](const std::string& line) {
        std::smatch match;
        if (std::regex_search(line, match, shared)) known[room_of(path)].insert(match[1]);
      });
  EXPECT_TRUE(known["draw"].contains("kNameGap")) << "the search finds no constants: is it broken?";
  for (const fs::path& path : sources())
    if (path.extension() == ".cpp")
      each_line(path, [&](const std::string& line) {
        if (!line.starts_with("const")) return;  // of the namespace
        for (std::sregex_iterator at(line.begin(), line.end(), own), end; at != end; ++at)
          EXPECT_FALSE(known[room_of(path)].contains((*at)[1]))
              << path << " has a " << (*at)[1] << " of its own beside its room's";
      });
}

TEST(Rooms, HaveANamespaceEach) {
  for (const fs::path& path : sources()) {
    const std::string room = room_of(path);
    // What is in base is in lantern itself, and web stands in for parts of it and of the language.
    if (room == "src" || room == "base" || room == "web") continue;
    EXPECT_NE(read_text(path).find("namespace lantern::" + room), std::string::npos) << path;
  }
}

// src/rooms.hpp says the same as the table above, but that nobody sees the lecture's names.
TEST(Rooms, SeeTheNamesOfThoseThatTheyMayInclude) {
  const std::regex line("namespace ([a-z]+) \\{|using namespace ([a-z]+);");
  const std::string text = read_text(repository("src/rooms.hpp"));
  std::map<std::string, std::set<std::string>> seen;
  std::string room;
  for (std::sregex_iterator it(text.begin(), text.end(), line), end; it != end; ++it) {
    if ((*it)[1].matched) room = (*it)[1];
    if ((*it)[2].matched) seen[room].merge(std::set{seen[(*it)[2]]}), seen[room].insert((*it)[2]);
  }
  for (const auto& entry : kRooms) {
    std::set<std::string> expected = seen_from(entry.first);
    for (const char* unnamed : {"base", "lecture", entry.first.c_str()}) expected.erase(unnamed);
    EXPECT_EQ(seen[entry.first], expected) << entry.first;
  }
}

// A page that names a file which is gone misleads, and so does a link to nowhere.
TEST(Rooms, PagesNameFilesThatAreThere) {
  const std::regex path("`((src|tests|shaders|scenarios)/[A-Za-z0-9_./]+)`");
  const std::regex link("\\]\\(([A-Za-z0-9_./]+)\\)");
  for (const std::string& page : pages()) {
    const std::string text = read_text(repository(page));
    const fs::path folder = fs::path(repository(page)).parent_path();
    std::size_t named = 0;
    for (std::sregex_iterator it(text.begin(), text.end(), path), end; it != end; ++it, ++named)
      EXPECT_TRUE(fs::exists(repository((*it)[1].str()))) << page << " names " << (*it)[1];
    for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it, ++named)
      EXPECT_TRUE(fs::exists(folder / (*it)[1].str())) << page << " leads to " << (*it)[1];
    EXPECT_GT(named, 0u) << page;
  }
}

// A script that compiles a source by name must not outlive it.
TEST(Rooms, ScriptsNameSourcesThatAreThere) {
  const std::regex source("src/[A-Za-z0-9_/]+\\.[ch]pp");
  std::size_t named = 0;
  for (const auto& entry : fs::recursive_directory_iterator(repository("tests"))) {
    if (entry.path().extension() != ".sh") continue;
    const std::string text = read_text(entry.path());
    for (std::sregex_iterator it(text.begin(), text.end(), source), end; it != end; ++it, ++named)
      EXPECT_TRUE(fs::exists(repository(it->str()))) << entry.path() << " names " << it->str();
  }
  EXPECT_GT(named, 0u) << "the search found nothing: is it broken?";
}

// Whoever asks what a structure is like asks its traits (src/spatial/structure_kind.hpp), so that a
// new one is known everywhere. Named are kinds only where one of them is meant, as often as this.
TEST(Rooms, NameNoStructureButWhereItIsMeant) {
  const std::map<std::string, int> allowed = {
      {"draw/panels/comparison.cpp", 1},     // others are compared with brute force
      {"draw/legend.cpp", 1},                // its example
      {"draw/world/world2d_parts.cpp", 1},   // quarters that a quadtree has not made
      {"app/commands/structure.cpp", 2},     // others are timed beside brute force
      {"language/counts.cpp", 1},            // a compiled level is a BSP
      {"run/level_stage.cpp", 1},            // as well
      {"language/tables/structure.cpp", 2},  // a guess of a bad one, octrees in flat worlds
      {"run/watch_contacts.cpp", 1},         // pairs of worlds without a structure
      {"run/structure_picture.hpp", 1},      // what brute force says of itself
      {"run/players.cpp", 1},                // without a structure a world has it
      {"run/tally.cpp", 1},                  // no structure is brute force
      {"measure/broad_phase_cost.cpp", 1},   // brute force is measured once
      {"measure/broad_phase_cost.hpp", 1},   // what a row is of, if nothing is said
      {"measure/step_bench.hpp", 1},         // as well
      {"measure/stress_trees.cpp", 3},       // cases about one of them
  };
  const std::regex kind("StructureKind::(?!none\\b|automatic\\b|own\\b)[a-z]");
  std::size_t named = 0;
  for (const fs::path& path : sources()) {
    const std::string name = fs::relative(path, repository("src"));
    if (name.starts_with("spatial/")) continue;
    const std::string text = read_text(path);
    const auto count = std::distance(std::sregex_iterator(text.begin(), text.end(), kind), {});
    const auto known = allowed.find(name);
    EXPECT_LE(count, known == allowed.end() ? 0 : known->second) << name;
    named += static_cast<std::size_t>(count);
  }
  EXPECT_GT(named, 0u) << "the search found nothing: is it broken?";
}

// Whoever has read these files knows Lantern: so many lines can be read in a day.
TEST(Rooms, HaveASpineThatIsReadInADay) {
  std::ifstream spine(repository("src/SPINE"));
  std::size_t lines = 0, files = 0;
  for (std::string line; std::getline(spine, line);) {
    const std::string file = line.substr(0, line.find(' '));
    if (file.empty() || file == "#") continue;
    const std::string text = read_text(repository("src/" + file));
    EXPECT_FALSE(text.empty()) << "src/SPINE names " << file;
    lines += static_cast<std::size_t>(std::ranges::count(text, '\n'));
    ++files;
  }
  EXPECT_GT(files, 20u) << "the search found next to none: is it broken?";
  EXPECT_LE(lines, 6000u);
}

// src/SIZE grants each room so many lines: what goes beyond is taken out elsewhere, or a raise of
// that file says why. What a room no longer needs it does not keep.
TEST(Rooms, AreAsLargeAsTheyWereGranted) {
  std::map<std::string, int> lines;
  for (const auto& entry : fs::recursive_directory_iterator(repository("src"))) {
    const std::string kind = entry.path().extension();
    if (kind != ".cpp" && kind != ".hpp" && kind != ".js" && kind != ".css" && kind != ".html")
      continue;
    const std::string text = read_text(entry.path());
    lines[room_of(entry.path())] += static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  }
  std::map<std::string, int> granted;
  std::istringstream table(read_text(repository("src/SIZE")));
  for (std::string line; std::getline(table, line);) {
    std::istringstream words(line);
    std::string room;
    int most = 0;
    if (line.starts_with('#') || !(words >> room >> most)) continue;
    granted[room] = most;
  }
  for (const auto& [room, count] : lines) {
    EXPECT_LE(count, granted[room]) << room << " has grown";
    EXPECT_GE(count + std::max(20, count / 50), granted[room]) << room << " has shrunk: lower it";
  }
}

TEST(Rooms, OnlyRenderKnowsGl) {
  for (const auto& entry : fs::recursive_directory_iterator(repository("src"))) {
    if (room_of(entry.path()) == "render") continue;
    const std::string text = entry.is_regular_file() ? read_text(entry.path()) : "";
    EXPECT_EQ(text.find("<GL/"), std::string::npos) << entry.path();
    EXPECT_EQ(text.find("<EGL/"), std::string::npos) << entry.path();
  }
}

// C libraries differ in the last bits of these, and a picture or a count with them. What the lab
// measures errors against has other digits, and what only it shows may use them.
TEST(Rooms, TakeElementaryFunctionsFromGeometry) {
  const std::set<std::string> free = {"measure", "peers", "lab"};
  const std::set<std::string> own = {"elementary", "elliptic", "twofold"};
  const std::regex theirs(
      "\\b(std|glm)::(sin|cos|tan|asin|acos|atan2?|sinh|cosh|tanh|exp2?|expm1|log(2|10|1p)?|pow|"
      "cbrt|hypot)\\(|glm::(angleAxis|slerp|rotate|perspective)\\(|long double");
  std::size_t looked_at = 0;
  for (const fs::path& path : sources()) {
    const std::string name = path.stem();
    if (free.contains(room_of(path)) || own.contains(name)) continue;
    const std::string code = read_text(path);
    std::smatch found;
    EXPECT_FALSE(std::regex_search(code, found, theirs)) << path << ": " << found.str();
    ++looked_at;
  }
  EXPECT_GT(looked_at, 100u) << "the search found nothing: is it broken?";
}

}  // namespace
}  // namespace lantern::app
