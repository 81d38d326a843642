// `playground`: one page in which every sequence can be run and changed.
#include <algorithm>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/folders/kept_files.hpp"
#include "app/output/sinks.hpp"
#include "app/run_scenario.hpp"
#include "base/number.hpp"
#include "base/words.hpp"
#include "language/words.hpp"
#include "publish/lesson.hpp"

namespace lantern::app {
namespace {

// Behind those that are there, to begin from nothing.
constexpr const char* kEmptyWorld = R"(title = "An empty world"

[world]
size = [16, 9]

[structure]
kind = "quadtree"
capacity = 1

[[body]]
name = "ann"
radius = 0.5
position = [3, 6]

[[step]]
do = "show"
caption = "An empty world and its quadtree. Under “change”, bodies are added; the next step has one."

[[step]]
do = "insert"
bodies = ["ann"]
caption = "One body: {nodes:node} and {pairs:candidate pair}."
)";

struct PlaygroundOptions {
  std::vector<std::string> folders;
  std::string output = "play.html", engine, theme = "light";
};

Options playground_options(PlaygroundOptions& o) {
  return {{"DIR", &o.folders, "folders or files; the default is scenarios"},
          {"-o,--output", &o.output, "the page", {.value = "PATH"}},
          engine_option(o.engine),
          {"--theme", &o.theme, "colours", {.words = kThemes}},
          language_option(),
          words_option(),
          memory_option()};
}

int make_playground(const PlaygroundOptions& options) {
  const Destination to(options.output, false);
  if (to.kind() != OutputKind::page || to.is_by("scenario") || to.is_by("step") ||
      to.is_by("frame"))
    throw UsageError("-o {}: a playground is one .html page", options.output);
  publish::LivePart live{{}, packed_engine(options.engine)};
  int code = kGood;
  for (const std::string& file : listed_files(options.folders))
    if (const auto scenario = load_or_complain(file, code))
      live.scenarios.push_back(live_scenario(*scenario));
  std::ranges::stable_sort(live.scenarios, {}, [](const publish::LiveScenario& s) {
    return std::pair(!s.lecture, s.lecture);  // those without a place in the lecture are the last
  });
  const auto words = language::words_in(wording().language);
  const Speaking speaking(words.get());
  const std::string there = counted(live.scenarios.size(), "scenario");
  live.scenarios.push_back(
      {"empty.toml", word("An empty world"), word("To begin from nothing."), {}, kEmptyWorld});
  publish::Lesson page({"playground",
                        word("Playground"),
                        word("Every sequence, run in the page: drag what is drawn, or change its "
                             "text."),
                        std::nullopt,
                        {},
                        0},
                       options.theme);
  page.make_live(std::move(live));
  const fs::path file = to.file({});
  write_file(make_place(file, to.users_folder()), page.html());
  say(fmt::format("{} and an empty world in {}", there, file.string()));
  return code;
}

}  // namespace

std::vector<Command> playground_commands() {
  return {command("playground", "Make a page that carries the engine and all scenarios",
                  make_playground, playground_options)};
}

}  // namespace lantern::app
