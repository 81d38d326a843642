#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/table.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"
#include "scenario/needs.hpp"

namespace lantern {

int explain_command(const ExplainOptions& options) {
  const Scenario scenario = load_scenario(options.file);
  const Needs needs = needs_of(scenario);
  if (!options.json) {
    std::vector<std::vector<std::string>> rows;
    for (const Need& need : needs.listed)
      rows.push_back({need.used ? "uses" : "leaves out", need.stage, need.reason});
    print(fmt::format("{}: {}\n\n{}", scenario.name, scenario.title, table(rows)));
    return kGood;
  }
  JsonWriter json;
  json.begin_object().member("scenario", scenario.name).key("stages").begin_array();
  for (const Need& need : needs.listed)
    json.line()
        .begin_object()
        .member("stage", need.stage)
        .member("used", need.used)
        .member("reason", need.reason)
        .end_object();
  json.line().end_array().end_object();
  write_stdout(json.text() + "\n");
  return kGood;
}

}  // namespace lantern
