// Manual pages and completions say what --help says.
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/commands/command.hpp"
#include "app/process.hpp"
#include "base/child.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

// The names that stand first in the lines of a help.
std::set<std::string> options_told(const std::string& help) {
  const std::regex line("^  (-[-a-z,]+)"), name("-[-a-z]+");
  std::set<std::string> names;
  std::istringstream lines(help);
  std::smatch match;
  for (std::string text; std::getline(lines, text);) {
    if (!std::regex_search(text, match, line)) continue;
    const std::string all = match[1];
    for (std::sregex_iterator it(all.begin(), all.end(), name), end; it != end; ++it)
      names.insert(it->str());
  }
  return names;
}

// Of a command's --help.
std::set<std::string> options_told(const CommandPath& path) {
  return options_told(help_text({path.names.begin() + 1, path.names.end()}));
}

// From the first place of `from` to the next one of `to`.
std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) return "";
  return text.substr(at, text.find(to, at) - at);
}

bool has_word(const std::string& text, const std::string& word) {
  return std::regex_search(text, std::regex("(^|[^-a-z])" + word + "($|[^-a-z])"));
}

TEST(Manual, HasEveryCommandAndOptionOfTheHelp) {
  std::size_t options = 0;
  const std::vector<CommandPath> all = all_commands();
  for (const CommandPath& path : all) {
    const std::string page = std::regex_replace(manual_page(path, all), std::regex("\\\\-"), "-");
    EXPECT_NE(page.find(std::string(path.command->help).substr(0, 20)), std::string::npos) << page;
    for (const std::string& name : options_told(path)) {
      EXPECT_TRUE(has_word(page, "\\\\fB" + name + "\\\\fR")) << name << " of\n" << page;
      ++options;
    }
    for (const auto& c : path.command->commands)
      EXPECT_NE(page.find(fmt::format("-{} (1)", c.name)), std::string::npos) << c.name;
  }
  EXPECT_GT(options, 80u) << "the search for options found next to none: is it broken?";
}

TEST(Manual, NamesAreThoseOfTheFiles) {
  const fs::path folder = fresh_folder("man");
  ASSERT_EQ(shell("lantern man --dir " + folder.string()).code, 0);
  for (const CommandPath& path : all_commands())
    EXPECT_TRUE(fs::exists(folder / manual_file(path))) << manual_file(path);
  EXPECT_EQ(shell("lantern man").out, read_text(folder / "lantern.1"));
  EXPECT_EQ(shell("lantern man compare").out, read_text(folder / "lantern-compare.1"));
  EXPECT_EQ(shell("lantern man comparison").code, 2);
  if (!find_program("groff")) GTEST_SKIP() << "groff is not there";
  const Outcome o = shell("groff -k -man -ww -z -Tutf8 " + folder.string() + "/*.1");
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.err, "");
}

TEST(Completions, HaveEveryCommandAndOptionOfTheHelp) {
  const std::vector<CommandPath> all = all_commands();
  const std::string bash = completions("bash", all), zsh = completions("zsh", all),
                    fish = completions("fish", all);
  for (const CommandPath& path : all) {
    const std::string name = path.name(" ");
    const std::string below = name == "lantern" ? "" : name.substr(8);
    const std::string in_bash = between(bash, "\n    '" + below + "')\n", ";;\n    '");
    const std::string in_zsh = between(zsh, "\n_" + path.name("_") + "() {", "\n}");
    std::string in_fish;
    std::istringstream lines(fish);
    for (std::string line; std::getline(lines, line);)
      if (path.names.size() == 1 || line.find("from " + path.names.back()) != std::string::npos)
        in_fish += line + "\n";
    for (const std::string& option : options_told(path)) {
      EXPECT_TRUE(has_word(in_bash, option)) << name << " " << option << "\n" << in_bash;
      EXPECT_TRUE(has_word(in_zsh, option)) << name << " " << option << "\n" << in_zsh;
      const bool is_long = option.starts_with("--");
      EXPECT_TRUE(has_word(in_fish, is_long ? "-l " + option.substr(2) : "-s " + option.substr(1)))
          << name << " " << option << "\n"
          << in_fish;
    }
    for (const auto& c : path.command->commands) {
      EXPECT_TRUE(has_word(in_bash, c.name)) << c.name;
      EXPECT_TRUE(has_word(in_zsh, c.name)) << c.name;
      EXPECT_TRUE(has_word(in_fish, fmt::format("-a {}", c.name))) << c.name;
    }
  }
}

// What bash would offer for words of which the last is being written, sorted.
TEST(Completions, OfBashOfferWhatMayStandThere) {
  const fs::path folder = fresh_folder("bash");
  fs::create_directories(folder / "films");
  for (const char* file : {"a scene.toml", "other.toml", "notes.txt"})
    write_text(folder / file, "");
  write_text(folder / "lantern.bash", shell("lantern completions bash").out);
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"com", "compare,completions"},
      {"bench ''", "atlas,frames,pairs,step"},
      {"bench step --no", "--no-peers"},
      {"render --theme ''", "dark,light,print"},
      {"render --theme = da", "dark"},
      {"--memory 4G render --png ''", "fast,small"},
      {"render ''", "a scene.toml,films,other.toml"},
      {"render other.toml --pace e", "event"},
      {"render -o fi", "films"},
      {"render -o n", "notes.txt"},
      {"render --size ''", ""},
      {"list ''", "films"},
      {"man rend", "render"},
      {"completions f", "fish"},
  };
  std::string script = "cd '" + folder.string() + "'\n. ./lantern.bash\n";
  std::string expected;
  for (const auto& [words, offered] : cases) {
    script += "COMP_WORDS=(lantern " + words +
              "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _lantern\n" +
              "printf '%s\\n' \"${COMPREPLY[@]}\" | sort | paste -sd,\n";
    expected += offered + "\n";
  }
  write_text(folder / "try.bash", script);
  const Outcome o = shell("LC_ALL=C bash " + (folder / "try.bash").string());
  EXPECT_EQ(o.out, expected);
  EXPECT_EQ(o.err, "");
}

TEST(Completions, OfBashOfferTheNamesOfScenarios) {
  const fs::path folder = fresh_folder("bash-names");
  write_text(folder / "lantern.bash", shell("lantern completions bash").out);
  write_text(folder / "try.bash",
             ". ./lantern.bash\nCOMP_WORDS=(" LANTERN_BINARY
             " render ghost_q); COMP_CWORD=2; _lantern; echo ${COMPREPLY[*]}\n");
  EXPECT_EQ(shell("cd " + folder.string() + "; bash try.bash").out, "ghost_quadtree\n");
}

TEST(Completions, AreRightForTheirShells) {
  const fs::path folder = fresh_folder("shells");
  for (const std::string name : {"bash", "zsh", "fish"}) {
    const fs::path file = folder / name;
    write_text(file, shell("lantern completions " + name).out);
    if (!find_program(name)) continue;
    const Outcome o = shell(name + (name == "fish" ? " --no-execute " : " -n ") + file.string());
    EXPECT_EQ(o.code, 0) << name;
    EXPECT_EQ(o.err, "") << name;
  }
  EXPECT_EQ(shell("lantern completions tcsh").code, 2);
  if (!find_program("fish")) GTEST_SKIP() << "fish is not there";
  const Outcome o =
      shell("fish -c 'source " + (folder / "fish").string() +
            "; complete -C \"lantern render --theme \"; complete -C \"lantern bench s\"'");
  EXPECT_EQ(std::regex_replace(o.out, std::regex("\t.*"), ""), "dark\nlight\nprint\nstep\n")
      << o.err;
}

}  // namespace
}  // namespace lantern::app
