#include <algorithm>

#include <fmt/format.h>

#include "app/terminal.hpp"
#include "base/json_writer.hpp"
#include "base/stop.hpp"
#include "base/suggest.hpp"
#include "lab/commands.hpp"
#include "measure/stress.hpp"
#include "report/pages.hpp"
#include "report/stress_tables.hpp"

namespace lantern::lab {
namespace {

class Stress : public Experiment {
 public:
  Options options() override {
    return {{"CASE", &names_, "names of cases; the default is all that are not slow"},
            {"--list", &list_, "list the cases and exit"},
            {"--full", &full_, "run the slow cases, too"},
            {"--map", &map_, "draw where methods are stable: stability_map.png and .svg"}};
  }

  Texts listing() const override {
    if (!list_) return {};
    std::vector<std::vector<std::string>> rows;
    JsonWriter json = answer_of("stress.list");
    json.line().key("cases").begin_array();
    for (const StressCase& one : stress_cases()) {
      rows.push_back({std::string(one.group), std::string(one.name),
                      std::string(one.what) + (one.slow ? " (with --full)" : "")});
      json.line().object("name", one.name, "group", one.group, "slow", one.slow, "what", one.what);
    }
    json.line().end_array().line().end_object();
    return {table(rows), "", json.text(), ""};
  }

  // The cases named, in the order of the table; without names all that are not slow, with --full
  // all.
  void prepare() override {
    std::vector<std::string_view> known = mapped(stress_cases(), &StressCase::name);
    for (const std::string& name : names_)
      if (std::ranges::find(known, name) == known.end()) {
        const std::string hint = suggestion(name, known);
        throw Refused("there is no case '{}'; {}", name,
                      hint.empty() ? "see 'lantern stress --list'" : hint);
      }
    for (const StressCase& one : stress_cases())
      if (names_.empty() ? full_ || !one.slow : std::ranges::find(names_, one.name) != names_.end())
        cases_.push_back(one);
  }

  std::string unit() const override { return "cases"; }
  std::size_t stages() const override { return cases_.size(); }
  void run(const std::function<void(const std::string&)>& tell) override {
    for (const StressCase& one : cases_) {
      stop_if_asked();
      tell(fmt::format("{} of {}, {}", report_.outcomes.size() + 1, cases_.size(), one.name));
      report_.outcomes.push_back(run_case(one));
    }
    report_.finished = true;
  }

  Texts texts() const override {
    return {to_table(report_), to_csv(report_), to_json(report_), ""};
  }
  std::vector<Picture> pages() const override {
    if (!map_) return {};
    return {{"stability_map", draw_stability_map(make_stability_map())}};
  }
  bool is_good() const override {
    return std::ranges::all_of(report_.outcomes,
                               [](const StressOutcome& one) { return one.result.good; });
  }
  void set_circumstances(Circumstances circumstances, std::string /*command*/) override {
    report_.version = std::move(circumstances.version);
  }

 private:
  std::vector<std::string> names_;
  bool list_ = false, full_ = false, map_ = false;
  std::vector<StressCase> cases_;
  StressReport report_{"", {}, false};
};

}  // namespace

std::unique_ptr<Experiment> stress_experiment() { return std::make_unique<Stress>(); }

}  // namespace lantern::lab
