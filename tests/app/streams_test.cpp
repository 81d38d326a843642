// Streams that are lost, full or read by a terminal; limits; libraries that are not whole.
#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kTiny = " --size 160x90 ";

std::size_t line_count(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

// A byte that a terminal obeys, as such or in UTF-8, other than a line break.
bool has_raw(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = [&](std::size_t k) {
      return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0u;
    };
    if ((byte(0) < 0x20 && text[i] != '\n') || byte(0) == 0x7f || byte(0) == 0xff) return true;
    if (byte(0) == 0xc2 && byte(1) < 0xa0) return true;
    if (byte(0) == 0xe2 && byte(1) == 0x80 && byte(2) >= 0xa8 && byte(2) <= 0xae) return true;
  }
  return false;
}

void expect_shown(const std::string& text, const std::string& escape) {
  EXPECT_FALSE(has_raw(text)) << text;
  EXPECT_NE(text.find(escape), std::string::npos) << text;
}

// --- lost streams ---

// The pictures of a run with `streams` lost are those of a run with all of them.
TEST(Streams, WithoutStandardErrorTheWorkIsDoneAllTheSame) {
  const fs::path out = fresh_folder("lost-stderr");
  const auto render = [&](const std::string& name, const std::string& streams) {
    return shell("lantern render " + kGhosts + kTiny + "--frames 0-2 -o " + (out / name).string() +
                 streams);
  };
  ASSERT_EQ(render("all", "").code, 0);
  int number = 0;
  for (const char* streams : {" 2>&-", " 2>/dev/full", " <&- >&- 2>&-", " <&- 2>&-", " >&- 2>&-"}) {
    const std::string name = std::to_string(number++);
    EXPECT_EQ(render(name, streams).code, 0) << streams;
    EXPECT_EQ(shell("diff -r " + (out / "all").string() + " " + (out / name).string()).out, "")
        << streams << ": a message stands in a file, or one is missing";
  }
  EXPECT_EQ(shell("told() { lantern check no/such.toml 2>&1; }; unread told").code, 1)
      << "a reader that has gone";
}

TEST(Streams, WithoutStandardErrorTheExitCodeStands) {
  const fs::path folder = fresh_folder("lost-codes");
  write_text(folder / "bad.toml", "title = 1\n");
  for (const char* stream : {" 2>&-", " 2>/dev/full"}) {
    EXPECT_EQ(shell("lantern check " + (folder / "bad.toml").string() + stream).code, 3) << stream;
    EXPECT_EQ(shell(std::string("lantern check no/such.toml") + stream).code, 1) << stream;
    EXPECT_EQ(shell(std::string("lantern rendr") + stream).code, 2) << stream;
  }
}

TEST(Streams, AStandardOutputThatCannotBeWrittenIsSaidInOneLine) {
  for (const char* words : {"--help", "--version", "render --help", "list", "list --json", "doctor",
                            "reference", "schema", "stress --list", "measure --list"})
    for (const char* stream : {" >/dev/full", " >&-"}) {
      const Outcome o =
          shell("cd " LANTERN_ROOT "; lantern --quiet " + std::string(words) + stream);
      EXPECT_EQ(o.code, 1) << words << stream;
      EXPECT_EQ(line_count(o.err), 1u) << words << stream << ": " << o.err;
    }
  EXPECT_EQ(shell("lantern explain " + kGhosts + " >/dev/full").code, 1);
  EXPECT_EQ(shell("lantern check --json " + kGhosts + " >/dev/full").code, 1);
}

TEST(Streams, AReaderThatHasSeenEnoughHearsNothing) {
  for (const char* words : {"list", "--help", "schema"}) {
    const Outcome o = shell("cd " LANTERN_ROOT "; unread lantern " + std::string(words));
    EXPECT_EQ(o.code, 1) << words << ": silence and exit code 1, as of any program in a pipe";
    EXPECT_EQ(o.err, "") << words;
  }
}

// --- terminals ---

TEST(Terminal, GetsNothingRawFromArguments) {
  const Outcome command = shell("lantern \"$(printf '\\033[31mfoo\\302\\233\\342\\200\\256')\"");
  EXPECT_EQ(command.code, 2);
  expect_shown(command.err, "\\x1b[31mfoo\\u009b\\u202e");
  EXPECT_EQ(line_count(command.err), 1u);
  for (const char* words : {"render x --format", "render x --theme", "measure kepler --method",
                            "measure", "stress", "render x --size", "check x --pace"}) {
    const Outcome o =
        shell("lantern " + std::string(words) + " \"$(printf 'a\\033]0;b\\a\\n\\377c')\"");
    EXPECT_NE(o.code, 0) << words;
    expect_shown(o.err, "\\x1b]0;b\\x07");
    EXPECT_EQ(line_count(o.err), 1u) << words << ": " << o.err;
  }
}

TEST(Terminal, GetsNothingRawFromFileNames) {
  const fs::path folder = fresh_folder("raw-names");
  const std::string name = "a\x1b[31m\n\u202e\xff.toml";
  fs::copy_file(kGhosts, folder / ("x" + name));
  write_text(folder / name, "name = \"other\"\ntitle = 1\n");
  const std::string escapes = "a\\x1b[31m\\n\\u202e\\xff.toml";
  const std::string enter = "cd " + folder.string() + "; ";
  for (const char* words : {"check", "render", "explain", "measure"}) {
    const Outcome o = shell(enter + "lantern " + words + " a*.toml");
    EXPECT_EQ(o.code, 3) << words << o.err;
    expect_shown(o.err, escapes);
  }
  const Outcome list = shell(enter + "lantern list .");
  EXPECT_EQ(list.code, 3);
  expect_shown(list.err, escapes);
  const Outcome missing = shell(enter + "lantern check ./no*a*.toml no\"$(printf '\\033')\".toml");
  expect_shown(missing.err, "no\\x1b.toml");
}

TEST(Terminal, GetsNothingRawFromScenarios) {
  const fs::path folder = fresh_folder("raw-texts");
  const auto expect_refused = [&](const std::string& text, const std::string& place) {
    write_text(folder / "raw.toml", text);
    const Outcome o = shell("cd " + folder.string() + "; lantern check raw.toml");
    EXPECT_EQ(o.code, 3) << text << o.err;
    EXPECT_FALSE(has_raw(o.err)) << o.err;
    EXPECT_NE(o.err.find("raw.toml:" + place + ": error: "), std::string::npos) << o.err;
  };
  for (const std::string letter : {"\u009b31m", "\u202e", "\u2066", "\u200f", "\u2028", "\\u001b",
                                   "\\u007f", "\\u009b", "\\u202e"})
    for (const std::string key : {"title", "source"})
      expect_refused((key == "title" ? "" : "title = \"t\"\n") + key + " = \"x" + letter + "\"\n" +
                         "[world]\nsize = [1, 1]\n[[step]]\ndo = \"show\"\n",
                     (key == "title" ? "1:" : "2:") + std::to_string(key.size() + 4));
  expect_refused(
      "title = \"t\"\n[problem]\nsolution = \"stack\"\nseconds = 1\nstep = 1\n"
      "methods = [\"\\u001b]0;pwned\\u0007\"]\n[world]\nsize = [1, 1]\n"
      "[[body]]\nname = \"a\"\nradius = 0.1\nposition = [0.5, 0.5]\n[[step]]\ndo = \"show\"\n",
      "6:12");
}

TEST(Terminal, JsonIsValidWhateverAFileIsCalled) {
  const fs::path folder = fresh_folder("json-names");
  fs::copy_file(kGhosts, folder / "a\xff\x1b\u009b.toml");
  const Outcome o = shell("cd " + folder.string() + "; lantern check --json a*.toml no*.toml");
  EXPECT_FALSE(has_raw(o.out)) << o.out;
  const json report = json::parse(o.out);
  EXPECT_EQ(report["scenarios"][0]["file"], "a\ufffd\x1b\u009b.toml");
}

// --- measure ---

TEST(MeasureErrors, PointAtTheProblemAndLeaveNothingBehind) {
  const fs::path folder = fresh_folder("measure-errors");
  const std::string body = "[[body]]\nname = \"a\"\nradius = 0.1\nposition = [0.5, 0.5]\n";
  write_text(
      folder / "no_stack.toml",
      "title = \"t\"\n[world]\nsize = [1, 1]\n  [problem]\nsolution = \"stack\"\nstep = 1\n" +
          body + "[[step]]\ndo = \"show\"\n");
  // The second body never comes near the first.
  write_text(folder / "waits.toml",
             "title = \"t\"\n[world]\nsize = [9, 9]\ntime_step = 0.1\ncontacts = \"impulse\"\n" +
                 body +
                 "[[body]]\nname = \"b\"\nradius = 0.1\nposition = [8, 8]\n"
                 "[[step]]\ndo = \"insert\"\nbodies = [\"a\", \"b\"]\n"
                 "[[step]]\ndo = \"wait\"\nevent = \"touch\"\nbodies = [\"a\", \"b\"]\n"
                 "at_most = 1\n");
  const Outcome stack =
      shell("cd " + folder.string() + "; lantern measure no_stack.toml -o new/er");
  EXPECT_EQ(stack.code, 3);
  EXPECT_NE(stack.err.find("no_stack.toml:4:3: error: "), std::string::npos) << stack.err;
  EXPECT_NE(stack.err.find("\n    [problem]\n    ^"), std::string::npos) << stack.err;
  EXPECT_FALSE(fs::exists(folder / "new")) << "an empty folder is left";
  const Outcome waits = shell("cd " + folder.string() + "; lantern measure waits.toml -o new");
  EXPECT_EQ(waits.code, 3);
  EXPECT_NE(waits.err.find("waits.toml:17:1: error: no touch of 'a' and 'b' within 1 s"),
            std::string::npos)
      << waits.err;
  EXPECT_FALSE(fs::exists(folder / "new"));
  fs::create_directories(folder / "old");
  EXPECT_EQ(shell("cd " + folder.string() + "; lantern measure no_stack.toml -o old").code, 3);
  EXPECT_TRUE(fs::exists(folder / "old")) << "a folder that was there is the user's";
}

// --- backends and limits ---

TEST(Backend, AutoGoesOnWhereOsmesaIsNotWhole) {
  const fs::path out = fresh_folder("half-osmesa");
  for (const char* lack : {"symbol", "function"}) {
    const std::string fake =
        "export LD_LIBRARY_PATH=" LANTERN_FAKES "/without_" + std::string(lack) + "; ";
    const std::string render = "lantern render " + kGhosts + kTiny + "--frames 0 -o ";
    const Outcome o = shell(fake + render + (out / lack).string());
    EXPECT_EQ(o.code, 0) << lack << ": " << o.err;
    EXPECT_TRUE(fs::exists(out / lack / "ghost_quadtree" / "ghost_quadtree_0000.png"));
    const Outcome only = shell(fake + render + (out / "no").string() + " --backend osmesa");
    EXPECT_EQ(only.code, 4) << "is the library of the test loaded at all? " << only.err;
    EXPECT_NE(only.err.find("install"), std::string::npos) << only.err;
    const json report = json::parse(shell(fake + "lantern doctor --json").out);
    EXPECT_FALSE(report["backends"][0]["works"]) << lack;
    EXPECT_TRUE(report["backends"][1]["works"]) << lack;
  }
}

// Few of the limits that tests/deep/address_space.sh tries.
TEST(AddressSpace, ASmallOneIsToldAndNotRunInto) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer itself needs terabytes of address space";
#endif
  const fs::path out = fresh_folder("address-space");
  for (const char* limit : {"-v 100000", "-v 200000", "-v 225000", "-v 250000", "-v 400000",
                            "-v 500000", "-d 150000", "-d 250000"}) {
    const std::string limited = "ulimit -c 0; ulimit " + std::string(limit) + "; ";
    const Outcome render =
        shell(limited + "lantern render " + kGhosts + kTiny + "--frames 0-1 -o " + out.string());
    EXPECT_TRUE(render.code == 0 || render.code == 4) << limit << ": " << render.code;
    EXPECT_EQ(line_count(render.err), 1u) << limit << ": " << render.err;
    const Outcome doctor = shell(limited + "lantern doctor");
    EXPECT_TRUE(doctor.code == 0 || doctor.code == 4) << limit << ": " << doctor.code;
  }
  const Outcome small =
      shell("ulimit -v 200000; lantern render " + kGhosts + " -o " + out.string());
  EXPECT_NE(small.err.find("out of memory"), std::string::npos) << small.err;
}

}  // namespace
}  // namespace lantern::app
