// Changes to a scenario's text: what they say, and that nothing else has changed.
#include "live/edit.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/random.hpp"
#include "language/text/problems.hpp"

namespace lantern::live {
namespace {

TEST(Edit, ReplacesAValueWhereItStands) {
  const std::string text =
      "title = \"a # no comment\"  # one\n"
      "[structure]\n"
      "  capacity   = 2   # two\n"
      "[[body]]\nposition = [ 1,\n  2 ]\n"
      "[[body]] # \"red\"\nname = 'red'\nposition = [3, 4.5] # three\n";
  EXPECT_EQ(value_at(text, "title"), "\"a # no comment\"");
  EXPECT_EQ(value_at(text, "structure.capacity"), "2");
  EXPECT_EQ(value_at(text, "body[0].position"), "[ 1,\n  2 ]");
  EXPECT_EQ(value_at(text, "body[1].position[1]"), "4.5");
  EXPECT_EQ(value_at(text, "structure"), "");
  EXPECT_EQ(value_at(text, "body[2].position"), "");

  const auto with = [&](std::string_view old, std::string_view now) {
    std::string changed = text;
    return changed.replace(text.find(old), old.size(), now);
  };
  EXPECT_EQ(with_value(text, "structure.capacity", "16"), with("2   # two", "16   # two"));
  EXPECT_EQ(with_value(text, "body[1].position[0]", "-1e3"), with("3, 4.5", "-1e3, 4.5"));
  EXPECT_EQ(with_value(text, "body[0].position", "[0, 0]"), with("[ 1,\n  2 ]", "[0, 0]"));
  EXPECT_EQ(with_value(text, "title", "'''\n]'''"), with("\"a # no comment\"", "'''\n]'''"));
  EXPECT_EQ(with_value(text, "body[0].position", ""), with("position = [ 1,\n  2 ]\n", ""));
  EXPECT_EQ(with_value(text, "body[1].position[0]", ""), with("3, 4.5", "4.5"));
  EXPECT_EQ(with_value(text, "body[1].position[1]", ""), with("3, 4.5", "3"));
}

TEST(Edit, OfASlotIsTheSameEachTime) {
  for (const std::string text :
       {"\xEF\xBB\xBF[structure]\r\ncapacity = 2 # two\r\n[[body]]\r\nname = 'a'\r\n[[step]]\r\n",
        "structure = { capacity = 2 }\nbody = [{ name = 'a' }]\nstep = [{ do = 'show' }]\n", ""})
    for (const char* path :
         {"structure.capacity", "world.size[0]", "body[0].position", "step[0].to"}) {
      Slot slot(text, path);
      for (const char* value : {"[1, 2]", "[1.25, -2]", "3"}) {
        const auto said = [&](const auto& act) -> std::string {
          try {
            return act();
          } catch (const Refused& why) {
            return why.what();
          }
        };
        EXPECT_EQ(said([&] { return slot.with(value); }),
                  said([&] { return with_value(text, path, value); }))
            << text << path;
      }
    }
}

TEST(Edit, KnowsWhereEachKindOfValueEnds) {
  for (const std::string_view value :
       {R"("a \" ] # ")", R"('a \')", "\"\"\"a \"\" \\\"\"\" \n # \"\"\"\"\"", "'''\n''a\\'''''",
        "1979-05-27 07:32:00Z", "1979-05-27", "0xfF_0", "-inf", "6.02e+23", "true", "[]",
        "[ # ]\n [1, 2], # '\n [\"]\", '}'], ]", "{}", "{ a.b = [1], \"c.d\" = { e = '}' } }"}) {
    const std::string text =
        fmt::format("a = {}\t# c\nb = [0, {}, 1]\nc = {{ d = {} }}", value, value, value);
    for (const char* path : {"a", "b[1]", "c.d"}) EXPECT_EQ(value_at(text, path), value) << path;
    EXPECT_EQ(with_value(text, "b[1]", "7"),
              fmt::format("a = {0}\t# c\nb = [0, 7, 1]\nc = {{ d = {0} }}", value));
    EXPECT_EQ(with_value(with_value(text, "c.d", "7"), "c.d", value), text);
  }
}

TEST(Edit, PutsAKeyBehindTheLastOfItsTable) {
  const std::string text =
      "title = 't'\n\n[structure]\nkind = 'bvh'  # a tree\n\n# Red.\n[[body]]\nname = 'red'\n";
  EXPECT_EQ(with_value(text, "structure.capacity", "3"),
            "title = 't'\n\n[structure]\nkind = 'bvh'  # a tree\ncapacity = 3\n\n# Red.\n[[body]]\n"
            "name = 'red'\n");
  EXPECT_EQ(with_value(text, "body[0].mass", "2"), text + "mass = 2\n");
  EXPECT_EQ(with_value(text, "source", "'s'"), "title = 't'\nsource = 's'" + text.substr(11));
  EXPECT_EQ(with_value("[a]\n[b]\n", "a.c", "1"), "[a]\nc = 1\n[b]\n");
  EXPECT_EQ(with_value("  [a]\n    b = [\n]", "a.c d", "1"),
            "  [a]\n    b = [\n]\n    \"c d\" = 1");
  EXPECT_EQ(with_value("# All.\n\n# World.\n[a]\n", "b", "1"),
            "# All.\n\nb = 1\n\n# World.\n[a]\n");
  EXPECT_EQ(with_value("", "b", "1"), "b = 1\n");
  EXPECT_EQ(with_value("", "\"b\\n\\\\\"", "1"), "\"b\\n\\\\\" = 1\n");
  // In braces, and behind keys with dots.
  EXPECT_EQ(with_value("world = { size = [16, 6] }\n", "world.gravity", "[0, 1]"),
            "world = { size = [16, 6], gravity = [0, 1] }\n");
  EXPECT_EQ(with_value("world = {}  # none\n", "world.gravity", "1"),
            "world = { gravity = 1 }  # none\n");
  EXPECT_EQ(with_value("[[step]]\nexpect.eager = 1\ndo = 'run'\n", "step[0].expect.pairs", "[\n1]"),
            "[[step]]\nexpect.eager = 1\nexpect.pairs = [\n1]\ndo = 'run'\n");
  EXPECT_EQ(with_value("a = [{ b.c = 1, d = 2 }]", "a[0].b.e", "3"),
            "a = [{ b.c = 1, b.e = 3, d = 2 }]");
}

TEST(Edit, MakesATableThatIsNotThere) {
  const std::string steps = "# First.\n[[step]]\ndo = 'run'\n";
  EXPECT_EQ(with_value("[world]\nsize = 1\n\n" + steps, "structure.capacity", "3"),
            "[world]\nsize = 1\n\n[structure]\ncapacity = 3\n\n" + steps);
  EXPECT_EQ(with_value("a = 1", "structure.capacity", "3"), "a = 1\n\n[structure]\ncapacity = 3\n");
  EXPECT_EQ(with_value("", "a.b.c", "3"), "[a]\nb = { c = 3 }\n");
  EXPECT_EQ(with_value(steps, "step[0].expect.\"for 1\".nodes", "3"),
            steps + "expect = { \"for 1\" = { nodes = 3 } }\n");
  EXPECT_EQ(with_value("[a.b]\nc = 1\n", "a.d", "2"), "[a]\nd = 2\n\n[a.b]\nc = 1\n");
  EXPECT_EQ(with_value("[[a]]\n[a.b.c]\n", "a[0].b.d", "2"), "[[a]]\n[a.b]\nd = 2\n\n[a.b.c]\n");
}

TEST(Edit, TakesAKeyOutWithItsLine) {
  EXPECT_EQ(with_value("a = 1\n  b = 2  # two\nc = 3\n", "b", ""), "a = 1\nc = 3\n");
  EXPECT_EQ(with_value("a = 1\nb = 2", "b", ""), "a = 1");
  EXPECT_EQ(with_value("a = 1\n", "b.c", ""), "a = 1\n");
  EXPECT_EQ(with_value("[a]\nb = 1\n", "a.b", ""), "[a]\n");
  EXPECT_EQ(with_value("a.b = 1\nc = 2\n", "a.b", ""), "c = 2\n");
  EXPECT_EQ(with_value("a = { b = 1, c.d = 2 , e = 3 }", "a.b", ""), "a = { c.d = 2 , e = 3 }");
  EXPECT_EQ(with_value("a = { b = 1, c.d = 2 , e = 3 }", "a.c.d", ""), "a = { b = 1, e = 3 }");
  EXPECT_EQ(with_value("a = { b = 1, c.d = 2 , e = 3 }", "a.e", ""), "a = { b = 1, c.d = 2 }");
  EXPECT_EQ(with_value("a = { b = 1 }", "a.b", ""), "a = { }");
  EXPECT_EQ(with_value("a = [ # one\n  1, # a\n  2 # b\n]", "a[1]", ""),
            "a = [ # one\n  1, # a\n # b\n]");
}

TEST(Edit, KeepsLineEndsAndByteOrderMarks) {
  const std::string text =
      "\xef\xbb\xbf"
      "a = 1 # ü\r\n[b]\r\nc = 2\r\n[[step]]\r\nd = 3\r\n";
  EXPECT_EQ(value_at(text, "a"), "1");
  const std::string more = with_value(with_value(text, "b.e", "4"), "f.g", "'ü'");
  EXPECT_EQ(more,
            "\xef\xbb\xbf"
            "a = 1 # ü\r\n[b]\r\nc = 2\r\ne = 4\r\n[f]\r\ng = 'ü'\r\n\r\n[[step]]\r\n"
            "d = 3\r\n");
  EXPECT_EQ(with_step(text, 0, "d = 4\ne = 5\n"), text + "\r\n[[step]]\r\nd = 4\r\ne = 5\r\n");
  EXPECT_EQ(with_value(with_value(text, "b.e", "4"), "b.e", ""), text);
}

TEST(Edit, InsertsAStepBehindAnother) {
  const std::string first = "[[step]]\ndo = 'a'\n[[step.note]]\ntext = '''\n[[step]]'''  # n\n";
  const std::string second = "\n# Then.\n[[step]]\ndo = 'b'\n[step.expect]\nc = 1\n";
  const std::string added = "\n[[step]]\ndo = 'move'\nby = [1, 2]\n";
  EXPECT_EQ(with_step(first + second, 0, "do = 'move'\nby = [1, 2]"), first + added + second);
  EXPECT_EQ(with_step(first + second, 1, "[[step]]\ndo = 'move'\nby = [1, 2]\n"),
            first + second + added);
  EXPECT_EQ(with_step("[[step]]\nlit = [\n  1,\n]\n", 0, "do = 'move'\nby = [1, 2]"),
            "[[step]]\nlit = [\n  1,\n]\n" + added);
  EXPECT_EQ(with_step("step = [{ do = 'a' }, { do = 'b' }]", 0, "do = 'c'  # c\nby = [1,\n2]\n"),
            "step = [{ do = 'a' }, { do = 'c', by = [1,\n2] }, { do = 'b' }]");
  EXPECT_EQ(with_step("step = [\n  { do = 'a' },\n]\n", 0, "do = 'c'\n"),
            "step = [\n  { do = 'a' },\n  { do = 'c' },\n]\n");
  EXPECT_THROW(with_step(first, 1, "do = 'c'"), Refused);
  EXPECT_THROW(with_step(first, 0, "do = 'c'\n[world]\n"), Refused);
  EXPECT_THROW(with_step(first, 0, "do = 'c'\n[[step]]\n"), Refused);
  EXPECT_THROW(with_step("step = [{}]", 0, "do = 'c'\n[step.expect]\na = 1"), Refused);
}

TEST(Edit, InsertsABodyBehindTheOthers) {
  const std::string step = "# First.\n[[step]]\ndo = 'a'\n";
  EXPECT_EQ(with_body("a = 1\n" + step, "x = 1\n"), "a = 1\n[[body]]\nx = 1\n\n" + step);
  EXPECT_EQ(with_body("[[body]]\ny.z = 1 # [\n[body.w]\n\n" + step + "[[ 'body' ]]\n", "x = 1"),
            "[[body]]\ny.z = 1 # [\n[body.w]\n\n" + step + "[[ 'body' ]]\n\n[[body]]\nx = 1\n");
  EXPECT_EQ(with_body("step = [{ do = 'a' }]", "x = 1"),
            "step = [{ do = 'a' }]\n\n[[body]]\nx = 1\n");
  EXPECT_EQ(with_body("body = []\n" + step, "x = 1\ny = 2"), "body = [{ x = 1, y = 2 }]\n" + step);
  EXPECT_EQ(with_body("body = [{}, { z = 1 }]", "x = 1"), "body = [{}, { z = 1 }, { x = 1 }]");
  EXPECT_EQ(with_body("", "x = 1"), "[[body]]\nx = 1\n");
  EXPECT_THROW(with_body(step, "x = 1\n[step]"), Refused);
  // What a step stands behind is no ending.
  EXPECT_EQ(with_step("[[step]]\n'ending' = true\ndo = 'a'\n", 0, "do = 'b'"),
            "[[step]]\ndo = 'a'\n\n[[step]]\ndo = 'b'\n");
}

TEST(Edit, FindsATableByItsName) {
  const std::string text = "[[body]]\nname = 'red'\n[[body]]\n[[body]]\nname = \"bl\\u0075e\"\n";
  EXPECT_EQ(index_of(text, "body", "red"), 0u);
  EXPECT_EQ(index_of(text, "body", "blue"), 2u);
  EXPECT_EQ(index_of(text, "body", "green"), std::nullopt);
  EXPECT_EQ(index_of(text, "texture", "red"), std::nullopt);
  EXPECT_EQ(index_of("body = [{ name = 'a' }, { name = 'b' }]", "body", "b"), 1u);
}

TEST(Edit, RefusesWhatLeadsNowhereAndWhatIsNoValue) {
  const std::string text = "a = [1, 2]\nb.c = 1\n[d]\n[[e]]\n";
  for (const char* path :
       {"a[2]",           "a.x",  "e[1].x", "b",  "d",    "e",  "e[0]", "b.c.x", "x[0]",  "x[0].y",
        "d[0]",           "",     ".a",     "a.", "a..b", "a[", "a[]",  "a[x]",  "a[-1]", "[0]",
        "a[99999999999]", "a[0]x"})
    EXPECT_THROW(with_value(text, path, "1"), Refused) << path;
  std::string deep = "a";
  for (int i = 0; i < 100'000; ++i) deep += ".a";
  EXPECT_THROW(with_value("", deep, "1"), Refused);
  for (const char* value :
       {"1\nb = 2", "1 # c", "1 ", "x", "[1", "\"", "1, 2", "{ a = 1 ", " ", "\n", "\xff", "#"})
    EXPECT_THROW(with_value(text, "a[0]", value), Refused) << value;
  for (const char* bad : {"a = ", "a", "[a", "a = 1\na = 2", "a = \"\xff\""}) {
    EXPECT_THROW(with_value(bad, "a", "1"), Refused) << bad;
    EXPECT_THROW(value_at(bad, "a"), Refused) << bad;
  }
}

// The scenarios, as the tests read them: each value by its path.
struct KnownValue {
  std::string path;
  const TomlValue* value;
};

void add_values(const TomlValue& value, const std::string& path, std::vector<KnownValue>& found) {
  if (const auto* list = std::get_if<TomlArray>(&value.data)) {
    // A point is one value: it is dragged as such.
    const auto is_number = [](const TomlValue& v) {
      return std::holds_alternative<double>(v.data) || std::holds_alternative<std::int64_t>(v.data);
    };
    if (list->size() == 2 && std::ranges::all_of(*list, is_number))
      return found.push_back({path, &value});
    for (std::size_t i = 0; i < list->size(); ++i)
      add_values((*list)[i], fmt::format("{}[{}]", path, i), found);
  } else if (const auto* table = std::get_if<TomlTable>(&value.data)) {
    for (const TomlEntry& entry : *table)
      add_values(entry.value, fmt::format("{}{}\"{}\"", path, path.empty() ? "" : ".", entry.key),
                 found);
  } else {
    found.push_back({path, &value});
  }
}

std::string shown(const TomlValue& value) {
  if (const auto* list = std::get_if<TomlArray>(&value.data))
    return fmt::format("{}, {}", shown(list->front()), shown(list->back()));
  if (const auto* text = std::get_if<std::string>(&value.data)) return "text " + *text;
  if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return fmt::format("{}", *whole);
  if (const auto* number = std::get_if<double>(&value.data))
    return fmt::format("number {}", *number);
  return std::get<bool>(value.data) ? "true" : "false";
}

// What a text says, by path.
std::map<std::string, std::string> said_by(const std::string& text) {
  Problems problems;
  const TomlValue root{{}, read_toml(text, problems)};
  EXPECT_FALSE(problems.any());
  std::vector<KnownValue> values;
  add_values(root, "", values);
  std::map<std::string, std::string> said;
  for (const KnownValue& known : values) said[known.path] = shown(*known.value);
  return said;
}

struct ScenarioText {
  std::string file, text;
  TomlValue root;
  std::vector<KnownValue> values;
};

// Of their values, one of each kind, and some of the others.
const std::vector<ScenarioText>& scenario_texts() {
  static std::vector<ScenarioText> found;
  if (!found.empty()) return found;
  for (const auto& entry : std::filesystem::directory_iterator(LANTERN_ROOT "/scenarios")) {
    if (entry.path().extension() != ".toml") continue;
    const std::string text = read_file(entry.path(), 1'000'000);
    Problems problems;
    found.push_back({entry.path().filename(), text, {{}, read_toml(text, problems)}, {}});
  }
  std::ranges::sort(found, {}, &ScenarioText::file);
  Random random(1);
  for (ScenarioText& scenario : found) {
    add_values(scenario.root, "", scenario.values);
    std::set<std::string> kinds;
    std::erase_if(scenario.values, [&](const KnownValue& known) {
      std::string kind = known.path;
      std::erase_if(kind, [](char c) { return '0' <= c && c <= '9'; });
      return !kinds.insert(kind).second && random.whole(0, 7) != 0;
    });
  }
  EXPECT_GT(found.size(), 40u);
  return found;
}

TEST(Edit, FindsValuesOfEachScenarioAndLeavesItsBytesWhenTheyAreSetToThemselves) {
  for (const ScenarioText& scenario : scenario_texts()) {
    EXPECT_GT(scenario.values.size(), 20u) << scenario.file;
    for (const auto& [path, value] : scenario.values) {
      const std::string written = value_at(scenario.text, path);
      const auto column = static_cast<std::size_t>(value->where.column) - 1;
      const std::string there = line_of(scenario.text, value->where.line).substr(column);
      const std::string first = written.substr(0, std::min(written.find('\n'), written.size()));
      EXPECT_TRUE(!written.empty() && there.find(first) != there.npos)
          << scenario.file << " " << path << ": " << written;
      ASSERT_EQ(with_value(scenario.text, path, written), scenario.text) << scenario.file << path;
    }
  }
}

TEST(Edit, GivesTheSameBytesAfterThereAndBack) {
  Random random(1);
  for (const ScenarioText& scenario : scenario_texts())
    for (const KnownValue& known : scenario.values) {
      if (random.whole(0, 3) != 0) continue;
      const std::string old = value_at(scenario.text, known.path);
      const std::string there = with_value(scenario.text, known.path, "[\"]#\", {}, 1]");
      EXPECT_EQ(there.size() + old.size(), scenario.text.size() + 13) << scenario.file;
      EXPECT_EQ(with_value(there, known.path, old), scenario.text)
          << scenario.file << " " << known.path;
    }
}

TEST(Edit, ChangesNothingElseOfAScenario) {
  Random random(2);
  for (const ScenarioText& scenario : scenario_texts()) {
    std::string text = scenario.text;
    std::map<std::string, std::string> said = said_by(text);
    for (int i = 0; i < 24; ++i) {
      const auto at = static_cast<std::size_t>(
          random.whole(0, static_cast<std::int64_t>(scenario.values.size()) - 1));
      const auto& [old_path, old] = scenario.values[at];
      const auto number = random.whole(-1000, 1000);
      std::string path = old_path, value = fmt::format("{}", number), now = value;
      const auto kind = random.whole(0, 3);
      if (kind < 2)  // a key beside it
        path = fmt::format("{}\"new {}\"", path.substr(0, path.rfind('"', path.rfind('"') - 1)), i);
      else if (std::holds_alternative<TomlArray>(old->data))
        value = fmt::format("[{0}, {0}]", number), now = fmt::format("{0}, {0}", number);
      else if (std::holds_alternative<std::string>(old->data))
        value = fmt::format("'{}'", number), now = fmt::format("text {}", number);
      if (kind == 2 && path.ends_with('"')) value.clear();  // a key is taken out
      text = with_value(text, path, value);
      value.empty() ? void(said.erase(path)) : void(said[path] = now);
      ASSERT_EQ(said_by(text), said) << scenario.file << " " << path;
    }
  }
}

TEST(Edit, InsertsAStepAnywhereInAScenario) {
  using Said = std::map<std::string, std::string>;  // by the paths within a step
  const auto steps_of = [](const std::string& text) {
    std::vector<Said> steps;
    for (const auto& [path, value] : said_by(text))
      if (std::size_t end = 0; path.starts_with("\"step\"[")) {
        const std::size_t step = std::stoul(path.substr(7), &end);
        steps.resize(std::max(steps.size(), step + 1));
        steps[step][path.substr(7 + end)] = value;
      }
    return steps;
  };
  for (const ScenarioText& scenario : scenario_texts()) {
    const std::vector<Said> steps = steps_of(scenario.text);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      std::vector<Said> more = steps;
      more[i].erase("].\"ending\"");  // it is none then
      more.insert(more.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                  Said{{"].\"do\"", "text move"}});
      ASSERT_EQ(steps_of(with_step(scenario.text, i, "do = 'move'")), more) << scenario.file << i;
    }
  }
}

}  // namespace
}  // namespace lantern::live
