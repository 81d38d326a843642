// Files that somebody else has written, and links that somebody has planted: whatever they say, no
// command writes or removes anything but in the folder that it was given.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/process.hpp"
#include "base/random.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Every entry below a folder: a file's bytes, where a link leads to, or that it is a folder.
std::map<std::string, std::string> everything_in(const fs::path& folder, const std::string& but) {
  std::map<std::string, std::string> all;
  for (auto it = fs::recursive_directory_iterator(folder); it != fs::end(it); ++it) {
    const std::string name = it->path().lexically_relative(folder).string();
    if (name == but) {
      it.disable_recursion_pending();
    } else if (it->is_symlink()) {
      all[name] = "-> " + fs::read_symlink(it->path()).string();
    } else {
      all[name] = it->is_directory() ? "/" : read_text(it->path());
    }
  }
  return all;
}

struct Attempt {
  const char* words;   // with the arena as current folder
  const char* reads;   // the folder that a stranger has made
  const char* writes;  // the only one in which something may change
};
constexpr Attempt kCommands[] = {
    {"merge whole parts", "parts", "whole"},
    {"merge parts", "parts", "parts"},
    {"render six.toml --size 80x45 --tween 1 -o out", "out", "out"},
    {"render six.toml --size 80x45 --tween 1 -o parts --shard 1/2", "parts", "parts"},
    {"golden six.toml --size 80x45 --report golden.html", "golden", "golden.html"},
    {"golden six.toml --size 80x45 --update", "golden", "golden"},
    {"compare out golden -o difference", "out", "difference"},
    {"render six.toml --size 80x45 --frames 0 -o 'pages/{scenario}.html'", "pages", "pages"},
    {"measure --from measured -o page", "measured", "page"},
    {"measure projectile --quick --no-peers --method velocity_verlet --step 0.2 -o measured",
     "measured", "measured"},
};

std::string three_steps() {
  std::string text = "title = \"Six\"\n[world]\nsize = [16, 9]\n[structure]\nkind = \"quadtree\"\n";
  for (int i = 1; i <= 3; ++i)
    text += fmt::format("[[body]]\nname = \"b{}\"\nradius = 0.5\nposition = [{}, 5]\n", i, 2 * i);
  for (int i = 1; i <= 3; ++i)
    text += fmt::format("[[step]]\ndo = \"insert\"\nbodies = [\"b{}\"]\n", i);
  return text;
}

class Hostile : public testing::Test {
 protected:
  // arena/ is where commands run; outside/ is beside it, and full of what they might want.
  static void SetUpTestSuite() {
    home() = fresh_folder("hostile");
    const fs::path made = home() / "made";
    fs::create_directories(made);
    fs::create_directories(home() / "outside/six");
    write_text(made / "six.toml", three_steps());
    const std::string render = "cd " + made.string() + " && lantern render six.toml --size 80x45 ";
    for (const char* words : {"--tween 1 -o parts --shard 1/2", "--tween 1 -o parts --shard 2/2"})
      ASSERT_EQ(shell(render + words).code, 0) << words;
    for (const Attempt& command : kCommands)  // those that make what they will read
      if (command.writes == std::string_view(command.reads) && !fs::exists(made / command.reads)) {
        const Outcome o = shell("cd " + made.string() + " && lantern " + command.words);
        ASSERT_EQ(o.code, 0) << command.words << o.err;
      }
    for (const char* name :
         {"six/six_0000.png", "six/manifest.json", "six_0000.json", "manifest.json", "shard.json",
          "golden.txt", "measure.json", "report.html", "six.html", "pwn.svg"})
      write_text(home() / "outside" / name, "precious");
  }
  static fs::path& home() {
    static fs::path folder;
    return folder;
  }

  // A value that no member has, or none of this one.
  json hostile_value() {
    const std::string up = "../../../outside/six", absolute = (home() / "outside/six").string();
    const std::vector<json> values = {"../six",
                                      "../../outside/six",
                                      up,
                                      absolute,
                                      absolute + "/six_0000.png",
                                      "",
                                      ".",
                                      "..",
                                      "six/../../six",
                                      std::string(300, 'a'),
                                      std::string(70'000, 'x'),
                                      "six\n\x1b[31m\x07",
                                      std::string("six\0six", 7),
                                      "sh",
                                      "PNG",
                                      "lantern.manifest/9",
                                      "abc",
                                      -1,
                                      0,
                                      1e300,
                                      18446744073709551615u,
                                      nullptr,
                                      true,
                                      json::array(),
                                      json::object(),
                                      json::array({"../six"})};
    return values[index(values.size())];
  }

  std::size_t index(std::size_t count) {
    return static_cast<std::size_t>(random_.whole(0, static_cast<std::int64_t>(count) - 1));
  }

  std::vector<fs::path> entries(const fs::path& folder, const std::string& ending = "") {
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (ending.empty() || entry.path().extension() == ending) found.push_back(entry.path());
    std::ranges::sort(found);
    return found;
  }

  // One of the members of a file, or a text wherever it stands in all files.
  std::string change_a_member(const fs::path& folder) {
    const std::vector<fs::path> files = entries(folder, ".json");
    const json value = hostile_value();
    if (value.is_string() && random_.whole(0, 2) == 0) {
      for (const fs::path& file : files) {
        std::string text = read_text(file);
        for (std::size_t at = 0; (at = text.find("\"six\"", at)) != text.npos; ++at)
          text.replace(at, 5, value.dump());
        write_text(file, text);
      }
      return "\"six\" is " + value.dump().substr(0, 80);
    }
    const fs::path& file = files[index(files.size())];
    if (random_.whole(0, 3) > 0) return change_in_place(file, value);
    json whole = json::parse(read_text(file));
    const json flat = whole.flatten();
    const std::string path = std::next(flat.begin(), static_cast<long>(index(flat.size()))).key();
    whole[json::json_pointer(path)] = value;
    write_text(file, whole.dump(0) + "\n");
    return file.filename().string() + path + " is " + value.dump().substr(0, 80);
  }

  // Else as Lantern writes it.
  std::string change_in_place(const fs::path& file, const json& value) {
    static const std::regex kMember(R"re("[a-z_ ]+": ("[^"\\\n]*"|[-+.e0-9]+|true|false))re");
    std::string text = read_text(file);
    const std::vector<std::smatch> members(std::sregex_iterator(text.begin(), text.end(), kMember),
                                           {});
    const std::smatch& one = members[index(members.size())];
    const std::string was = one.str();
    text.replace(static_cast<std::size_t>(one.position(1)), static_cast<std::size_t>(one.length(1)),
                 value.dump());
    write_text(file, text);
    return file.filename().string() + ": " + was + " is " + value.dump().substr(0, 80);
  }

  std::string change_a_line(const fs::path& file) {
    std::vector<std::string> lines;
    std::istringstream text(read_text(file));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    std::string& line = lines[index(lines.size())];
    const json value = hostile_value();
    line = line.substr(0, line.find(' ')) + " " +
           (value.is_string() ? value.get<std::string>() : value.dump());
    std::string all;
    for (const std::string& one : lines) all += one + "\n";
    write_text(file, all);
    return "golden.txt has " + line.substr(0, 80);
  }

  // An entry, or the whole folder, leads outside.
  std::string plant_a_link(const fs::path& folder) {
    const std::vector<fs::path> all = entries(folder);
    const fs::path entry = all[index(all.size())];
    const bool is_folder = fs::is_directory(entry);
    fs::remove_all(entry);
    const fs::path target = home() / "outside/six" / (is_folder ? "" : "six_0000.png");
    fs::create_symlink(target, entry);
    return entry.filename().string() + " is a link to " + target.string();
  }

  // LANTERN_HOSTILE_SEED gives others.
  Random random_{std::getenv("LANTERN_HOSTILE_SEED")
                     ? std::strtoull(std::getenv("LANTERN_HOSTILE_SEED"), nullptr, 10)
                     : 1};
};

TEST_F(Hostile, NothingIsWrittenOutside) {
  const char* wished = std::getenv("LANTERN_HOSTILE_FILES");
  const int trials = wished ? std::atoi(wished) : 60;
  const auto outside = everything_in(home() / "outside", "");
  int refused = 0;
  for (int i = 0; i < trials; ++i) {
    const Attempt& command = kCommands[static_cast<std::size_t>(i) % std::size(kCommands)];
    const fs::path arena = home() / "arena", reads = arena / command.reads;
    fs::remove_all(arena);
    fs::copy(home() / "made", arena, fs::copy_options::recursive);
    const bool is_golden = command.reads == std::string_view("golden");
    const auto kind = random_.whole(0, 3);
    const std::string what = kind == 0                ? plant_a_link(reads)
                             : is_golden && kind == 1 ? change_a_line(reads / "six/golden.txt")
                             : entries(reads, ".json").empty() ? plant_a_link(reads)
                                                               : change_a_member(reads);
    const auto before = everything_in(arena, command.writes);
    const Outcome o = shell("cd " + arena.string() + " && lantern " + command.words);
    const std::string told = fmt::format("{}: {}: {}", command.words, what, o.err);
    EXPECT_TRUE(o.code >= 0 && o.code <= 4) << told << o.code;
    EXPECT_EQ(o.err.find("stoi"), o.err.npos) << told;
    EXPECT_EQ(o.err.find("map::at"), o.err.npos) << told;
    EXPECT_EQ(everything_in(home() / "outside", ""), outside) << told;
    EXPECT_EQ(everything_in(arena, command.writes), before) << told;
    refused += o.code != 0;
    if (command.writes == std::string_view("whole") && o.code != 0) {
      EXPECT_FALSE(fs::exists(arena / "whole")) << "refused whole: " << told;
    }
    if (HasFailure()) break;
  }
  EXPECT_GT(refused, trials / 5) << "what is hostile is refused";
  std::printf("%d hostile files, %d refused\n", trials, refused);
}

// What was told of the member, and its value.
class HostilePart : public Hostile {
 protected:
  void SetUp() override {
    arena_ = home() / "arena";
    fs::remove_all(arena_);
    fs::copy(home() / "made", arena_, fs::copy_options::recursive);
  }
  void change(const std::string& file, const char* pointer, const json& value) {
    json whole = json::parse(read_text(arena_ / file));
    whole[json::json_pointer(pointer)] = value;
    write_text(arena_ / file, whole.dump(0) + "\n");
  }
  // In all files, as Lantern writes them else.
  void replace(const std::vector<const char*>& files, std::string_view old, std::string_view by) {
    for (const char* file : files) {
      std::string text = read_text(arena_ / file);
      const std::size_t at = text.find(old);
      ASSERT_NE(at, text.npos) << file << old;
      write_text(arena_ / file, text.replace(at, old.size(), by));
    }
  }
  void expect_refused(const std::string& words) {
    const Outcome o = shell("cd " + arena_.string() + " && lantern merge whole parts");
    EXPECT_NE(o.code, 0);
    EXPECT_NE(o.err.find(words), o.err.npos) << o.err;
    EXPECT_FALSE(fs::exists(arena_ / "whole"));
  }
  fs::path arena_;
};

constexpr const char* kManifestOfPart = "parts/shard-1-of-2/six/manifest.json";
constexpr const char* kRecordOfPart = "parts/shard-1-of-2/shard.json";

TEST_F(HostilePart, IsRefusedWithTheMemberAndItsValue) {
  const struct {
    const char *file, *pointer;
    json value;
    const char* words;
  } cases[] = {
      {kManifestOfPart, "/scenario", "../vic", "scenario is \"../vic\": a scenario's name is"},
      {kManifestOfPart, "/picture_format", "sh", "picture_format is \"sh\": it is one of png, svg"},
      {kManifestOfPart, "/frames/0/file", "/etc/x",
       "frames[0].file is \"/etc/x\": it is \"six_0000.png\""},
      {kManifestOfPart, "/frames/0/frame", -1, "frames[0].frame is -1: it is a whole number"},
      {kManifestOfPart, "/frames/0/in_betweens", 99999999999u,
       "frames[0].in_betweens is 99999999999"},
      {kManifestOfPart, "/theme", "../light", "theme is \"../light\": there is no such theme"},
      {kManifestOfPart, "/frames", 7, "frames is 7: it is a list"},
      {kRecordOfPart, "/inputs/0/name", "../six", "inputs[0].name is \"../six\""},
      {kRecordOfPart, "/settings/tween digits", "abc", "settings.tween digits is \"abc\""},
      {kRecordOfPart, "/settings/size", "99999999999x1",
       "settings.size is \"99999999999x1\": it is a picture's size"},
      {kRecordOfPart, "/settings/format", "../../x",
       "settings.format is \"../../x\": it is one of png, svg"},
      {kRecordOfPart, "/settings/transparent", "maybe", "settings.transparent is \"maybe\""},
      {kRecordOfPart, "/inputs", json::array(), "inputs is []: a run has one or more"},
      {kRecordOfPart, "/command", "measure", "command is \"measure\": it is \"render\""},
      {kRecordOfPart, "/of", 1e300, "of is 1e+300: it is a whole number"},
  };
  for (const auto& one : cases) {
    SetUp();
    change(one.file, one.pointer, one.value);
    expect_refused(one.words);
  }
  SetUp();
  json whole = json::parse(read_text(arena_ / kManifestOfPart));
  whole.erase("frames");
  write_text(arena_ / kManifestOfPart, whole.dump(0));
  expect_refused("frames is missing");
}

// Members that are possible, each by itself, and do not say what was done.
TEST_F(HostilePart, IsRefusedWhereItContradictsItself) {
  const std::vector<const char*> first = {kRecordOfPart},
                                 records = {kRecordOfPart, "parts/shard-2-of-2/shard.json"},
                                 manifest = {kManifestOfPart};
  const struct {
    const std::vector<const char*>& files;
    const char *old, *by, *words;
  } cases[] = {
      {first, "\"here\": 2", "\"here\": 0",
       "inputs[0].chosen is 3 in shard.json: of 'six' the parts have 1 frame"},
      {records, "\"theme\": \"light\"", "\"theme\": \"dark\"",
       "theme is \"light\", the record's settings say \"dark\""},
      {records, "\"size\": \"80x45\"", "\"size\": \"160x90\"", "the record's settings say"},
      {records, "\"transparent\": \"no\"", "\"transparent\": \"yes\"", "the record's settings say"},
      {records, "\"tween\": \"1\"", "\"tween\": \"3\"", "the record's settings say"},
      {records, "\"pace\": \"\"", "\"pace\": \"event\"", "the record's settings say"},
      {records, "\"switches\": \"\"", "\"switches\": \"legend\"", "the record's settings say"},
      {records, "\"frames\": \"\"", "\"frames\": \"0-99999999999999999999\"",
       "settings.frames is \"0-99999999999999999999\""},
      {records, "\"at\": \"\"", "\"at\": \"\", \"mine\": \"\"",
       "settings.mine is \"\": there is no such setting"},
      {manifest, "\"seed\": 1", "\"seed\": 2", "do not say the same of frame 0"},
      {manifest, "\"title\": \"Six\"", "\"title\": \"\\u001b[31mx\"",
       "no scenario has such a title"},
      {first, "\"finished\": true", "\"finished\": false,\n\"finished\": true",
       "is not as Lantern writes it: \"finished\": false,"},
      {manifest, "\"scenario\"", "\"zzz\": \"../y\",\n\"scenario\"",
       "line 3 is not as Lantern writes it: \"zzz\": \"../y\","},
  };
  for (const auto& one : cases) {
    SetUp();
    replace(one.files, one.old, one.by);
    expect_refused(one.words);
  }
  // Nor does a scenario vanish of which no part has any.
  SetUp();
  replace(first, "\"here\": 2, \"chosen\": 3", "\"here\": 0, \"chosen\": 0");
  replace({records[1]}, "\"here\": 1, \"chosen\": 3", "\"here\": 0, \"chosen\": 0");
  expect_refused("inputs[0].chosen is 0 in shard.json: of 'six' the parts have 0 frames");
}

// So deep that whoever follows it by calling himself runs out of stack.
TEST_F(HostilePart, IsRefusedHoweverDeepItIs) {
  const std::string deep =
      "{\"format\": " + std::string(2'000'000, '[') + std::string(2'000'000, ']') + "}";
  write_text(arena_ / kRecordOfPart, deep);
  expect_refused("is no record of a shard that this Lantern can read: format");
}

TEST_F(HostilePart, ThroughALinkIsRefused) {
  const fs::path folder = arena_ / "parts/shard-1-of-2/six";
  fs::rename(folder, arena_ / "elsewhere");
  fs::create_symlink(arena_ / "elsewhere", folder);
  expect_refused("is a link; links are not followed here");
}

// A picture of a run must not come to stand where a link of that name leads to.
TEST_F(HostilePart, ALinkInTheOutputIsNotFollowed) {
  fs::create_directories(arena_ / "whole");
  fs::create_symlink(home() / "outside/six", arena_ / "whole/six");
  const Outcome o = shell("cd " + arena_.string() + " && lantern merge whole parts");
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("'whole/six' is a link"), o.err.npos) << o.err;
  // One that the user gives herself is her word.
  fs::create_directories(home() / "elsewhere");
  fs::create_symlink(home() / "elsewhere", arena_ / "mine");
  EXPECT_EQ(shell("cd " + arena_.string() + " && lantern merge mine parts").code, 0);
  EXPECT_TRUE(fs::exists(home() / "elsewhere/six/six_0000.png"));
}

TEST_F(HostilePart, MeasurementOfSomebodyElseIsRefusedWithTheMember) {
  change("measured/measure.json", "/rows/0/problem", "../pwn");
  const Outcome o = shell("cd " + arena_.string() + " && lantern measure --from measured -o page");
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("rows[0].problem is \"../pwn\": a scenario's name is"), o.err.npos) << o.err;
  EXPECT_FALSE(fs::exists(arena_ / "page"));
}

}  // namespace
}  // namespace lantern::app
