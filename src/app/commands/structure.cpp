// `structure`: the structures that this program knows, whether they find what brute force finds,
// and how soon, beside each other.
#include <algorithm>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/progress.hpp"
#include "app/report_folder.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"
#include "base/number.hpp"
#include "base/suggest.hpp"
#include "spatial/own_structure.hpp"
#include "spatial/pairs.hpp"
#include "spatial/query.hpp"
#include "spatial/structure_trial.hpp"

namespace lantern::app {
namespace {

struct StructureCheckOptions {
  std::vector<std::string> names;  // empty for all
  int worlds = 500;
  std::uint64_t seed = 1;
  double limit = 2;
  std::string output = "output";  // folder of the scenario that shows a fault; empty for none
  bool json = false;
};

Option limit_option(double& limit) {
  return {"--limit",
          &limit,
          "processor time that one call of your own structure may take; it runs in a process of "
          "its own, with 256 MB in `check` and the budget in `bench` (without a limit of memory "
          "under the address sanitizer)",
          {.value = "SECONDS", .least = 0.01, .most = 3600}};
}

Options structure_check_options(StructureCheckOptions& o) {
  return {
      {"NAME", &o.names, "structures; the default is all of them"},
      {"--worlds", &o.worlds, "how many worlds", {.value = "N", .least = 1, .most = 10'000'000}},
      seed_option("of the random worlds", o.seed),
      limit_option(o.limit),
      {"-o,--output",
       &o.output,
       "folder for NAME_fails.toml, or NAME_crashes, NAME_hangs",
       {.value = "DIR"}},
      json_option(o.json)};
}

// Those that any flat world may have: not an octree, and no bsp, whose planes belong to one level.
// All of them if no name is given. Throws UsageError for a name that is none of theirs.
std::vector<StructureKind> structures_called(const std::vector<std::string>& names) {
  std::vector<StructureKind> kinds = known_structures();
  std::erase_if(kinds, [](StructureKind kind) {
    return !is_possible(kind, 2) || traits_of(kind).has(Setting::planes);
  });
  if (names.empty()) return kinds;
  const auto known = mapped(kinds, [](const StructureKind kind) { return to_string(kind); });
  std::vector<StructureKind> chosen;
  for (const std::string& name : names) {
    const auto kind = structure_named(name);
    if (!kind || *kind == StructureKind::none)
      throw UsageError(with_suggestion(fmt::format("no structure '{}'", name), name, known));
    if (std::ranges::find(kinds, *kind) == kinds.end())
      throw UsageError("{}: random flat worlds are not for it; take one of {}", name,
                       fmt::join(known, ", "));
    chosen.push_back(*kind);
  }
  return chosen;
}

std::string point(const Vec<2>& p) { return fmt::format("[{}, {}]", p.x, p.y); }

Box<2> box_of(const TrialBody& body) { return Box<2>::around(body.center, body.half); }

// What brute force finds, as an expectation.
std::string pairs_expected(const std::vector<TrialBody>& bodies) {
  const auto names = [](const Pair& p) { return fmt::format("[\"b{}\", \"b{}\"]", p.a, p.b); };
  const auto pairs = mapped(spatial::pairs_by_force<2>(proxies_of(bodies)), names);
  return fmt::format("expect = {{ pairs_are = [{}] }}\n", fmt::join(pairs, ", "));
}

// From each body to the next, as the check looks.
std::string rays_expected(const std::vector<TrialBody>& bodies) {
  std::string text;
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    const Vec<2> from = bodies[i - 1].center, way = bodies[i].center - from;
    if (way == Vec<2>(0.0)) continue;
    const auto hits = std::ranges::count_if(bodies, [&](const TrialBody& body) {
      return overlap(geometry::Ray<2>{from, way, 1}, box_of(body));
    });
    text += fmt::format(
        "\n[[step]]\ndo = \"ray\"\nfrom = {}\nto = {}\nhits = \"all\"\nexpect = {{ hits = {} }}\n",
        point(from), point(bodies[i].center), hits);
  }
  return text;
}

// A scenario that shows what goes wrong; its first lines say it in words.
std::string scenario_of(const Trial& trial) {
  const TrialWorld& w = trial.smallest;
  std::string text = fmt::format(
      "# {}\ntitle = \"Where {} goes wrong\"\n\n[world]\nmin = {}\nmax = {}\n\n[structure]\n"
      "kind = \"{}\"\n",
      trial.fault, to_string(trial.kind), point(w.bounds.lo), point(w.bounds.hi),
      to_string(trial.kind));
  if (traits_of(trial.kind).splits)
    text += fmt::format("capacity = {}\nmax_depth = {}\n", w.capacity, w.max_depth);
  const bool comes_back = !trial.last || !w.moved.empty();
  const std::size_t last = comes_back ? w.bodies.size() : *trial.last - 1;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < w.bodies.size(); ++i) {
    names.push_back(fmt::format("\"b{}\"", i + 1));
    text +=
        fmt::format("\n[[body]]\nname = {}\nhalf_size = {}\nposition = {}\nmass = 1\ncolor = {}\n",
                    names.back(), point(w.bodies[i].half), point(w.bodies[i].center), i % 8 + 1);
  }
  // What does not come back is told, and left out, so that what comes before can be seen.
  const auto insert = [&](const char* line, std::size_t from, std::size_t to) {
    const auto at = [&](std::size_t i) { return names.begin() + static_cast<std::ptrdiff_t>(i); };
    if (from < to && to <= names.size())
      text += fmt::format("\n{0}[[step]]\n{0}do = \"insert\"\n{0}bodies = [{1}]\n", line,
                          fmt::join(at(from), at(to), ", "));
  };
  insert("", 0, last);
  if (comes_back && w.moved.empty()) text += pairs_expected(w.bodies);
  if (!comes_back) {
    text += "\n# This step it does not come back from:";
    insert("# ", last, last + 1);
  }
  for (std::size_t i = 0; i < w.moved.size(); ++i)
    text += fmt::format("\n[[step]]\ndo = \"move\"\nbody = \"b{}\"\nto = {}\n", i + 1,
                        point(w.moved[i].center));
  if (!w.moved.empty()) text += pairs_expected(w.moved);
  if (trial.fault.find(": its ray") != trial.fault.npos ||
      trial.fault.find(": ray threw") != trial.fault.npos)
    text += rays_expected(w.bodies);
  return text;
}

constexpr std::string_view kEnds[] = {"fails", "crashes", "hangs"};

// Empty if there is nothing to write, or nothing that a scenario can show.
std::string write_scenario(const Trial& trial, const std::string& folder) try {
  if (trial.failed == 0 || folder.empty() || trial.smallest.bodies.empty()) return {};
  fs::create_directories(folder);
  const fs::path file = fs::path(folder) / fmt::format("{}_{}.toml", to_string(trial.kind),
                                                       kEnds[static_cast<int>(trial.end)]);
  write_file(file, scenario_of(trial));
  return file.string();
} catch (const std::exception& problem) {  // what it is about is told all the same
  complain(problem.what());
  return {};
}

void tell_fault(const Trial& trial, const std::string& file) {
  const TrialWorld& w = trial.smallest;
  complain(fmt::format("{}: {} of {} worlds go wrong; the smallest, shrunk to {}: {}",
                       to_string(trial.kind), trial.failed, trial.worlds,
                       counted(w.bodies.size(), "body", "bodies"), trial.fault));
  say(fmt::format("  world {} to {}, capacity {}, max_depth {}", point(w.bounds.lo),
                  point(w.bounds.hi), w.capacity, w.max_depth));
  for (std::size_t i = 0; i < w.bodies.size(); ++i) {
    const TrialBody& b = w.bodies[i];
    const Box<2> box = box_of(b), cut = clamped(box, w.bounds);
    std::string then;
    if (cut != box)
      then = fmt::format(", clamped to the world: {} to {}", point(cut.lo), point(cut.hi));
    if (!w.moved.empty()) then += fmt::format(", then around {}", point(w.moved[i].center));
    say(fmt::format("  b{}: {} to {}{}", i + 1, point(box.lo), point(box.hi), then));
  }
  if (file.empty()) return;
  if (trial.end == TrialEnd::fails) return say(fmt::format("  to see it: render {}", file));
  say(fmt::format("  world of {} in {}", counted(w.bodies.size(), "body", "bodies"), file));
  if (trial.last.value_or(0) > 1)
    say(fmt::format("  to see it before b{} comes: render {}", *trial.last, file));
}

void write(JsonWriter& json, const char* name, const std::vector<TrialBody>& bodies) {
  json.key(name).begin_array();
  for (const TrialBody& b : bodies)
    json.object("x", b.center.x, "y", b.center.y, "half_width", b.half.x, "half_height", b.half.y);
  json.end_array();
}

void write(JsonWriter& json, const Trial& trial, const std::string& file) {
  json.line().begin_object().members("name", to_string(trial.kind), "good", trial.failed == 0,
                                     "worlds", trial.worlds, "failed", trial.failed);
  if (trial.failed > 0) {
    const TrialWorld& w = trial.smallest;
    json.members("fault", trial.fault, "sort", w.sort, "capacity", w.capacity, "max_depth",
                 w.max_depth);
    write(json, "bodies", w.bodies);
    write(json, "moved", w.moved);
    json.key("scenario");
    file.empty() ? json.null() : json.value(file);
  }
  json.end_object();
}

int list_structures(const JsonOnly& options) {
  std::vector<std::vector<std::string>> rows;
  JsonWriter json = answer_of("structure.list");
  json.line().key("structures").begin_array();
  for (const StructureKind kind : known_structures()) {
    const StructureTraits traits = traits_of(kind);
    rows.push_back(
        {std::string(to_string(kind)), std::string(traits.words), traits.is_own ? "your own" : ""});
    json.line().object("name", to_string(kind), "words", traits.words, "own", traits.is_own);
  }
  json.line().end_array().end_object();
  options.json ? answer(json.text()) : print(table(rows));
  return kGood;
}

int check_structures(const StructureCheckOptions& options) {
  JsonWriter json = answer_of("structure.check");
  json.line().member("seed", options.seed);
  json.key("structures").begin_array();
  int code = kGood;
  for (const StructureKind kind : structures_called(options.names)) {
    const Trial trial = try_structure(kind, static_cast<std::uint64_t>(options.worlds),
                                      options.seed, AttemptLimits{.seconds = options.limit});
    const std::string file = write_scenario(trial, options.output);
    write(json, trial, file);
    if (trial.failed > 0) {
      tell_fault(trial, file);
      code = kFailed;
    } else if (!options.json) {
      say(fmt::format("{}: good; in {} the pairs are those of brute force", to_string(kind),
                      counted(trial.worlds, "world")));
    }
  }
  json.line().end_array().end_object();
  if (options.json) answer(json.text());
  return code;
}

struct StructureBenchOptions {
  std::vector<std::string> names;  // empty for all
  std::vector<int> bodies;         // empty for the usual numbers
  std::uint64_t seed = 1;
  int rounds = 9;
  double limit = 2;
  std::string output;  // folder; empty for none
  bool json = false;
};

Options structure_bench_options(StructureBenchOptions& o) {
  return {{"NAME", &o.names, "structures; the default is all of them"},
          {"--bodies", &o.bodies, "how many bodies; the default is 100, 400 and 1600",
           OptionTraits{.value = "N", .least = 2, .most = 1'000'000, .one_each = true}},
          seed_option("of the random worlds", o.seed),
          {"--rounds", &o.rounds, "repeats; the median counts", {.least = 1, .most = 1000}},
          limit_option(o.limit),
          {"-o,--output", &o.output, "folder for bench_structure.csv and .json", {.value = "DIR"}},
          memory_option(),
          json_option(o.json)};
}

int bench(const StructureBenchOptions& options) {
  StructureBench trial;
  trial.kinds = structures_called(options.names);
  for (const StructureKind kind : trial.kinds)
    if (const auto* yours = spatial::own_structure(kind); yours && !yours->is_optimized)
      say(
          fmt::format("'{}' is compiled without optimization, unlike the others; with CMake, build "
                      "with -DCMAKE_BUILD_TYPE=Release",
                      yours->name));
  // What all the others are held against.
  if (std::ranges::find(trial.kinds, StructureKind::brute_force) == trial.kinds.end())
    trial.kinds.insert(trial.kinds.begin(), StructureKind::brute_force);
  trial.bodies.assign(options.bodies.begin(), options.bodies.end());
  if (trial.bodies.empty()) trial.bodies = {100, 400, 1600};
  trial.seed = options.seed;
  trial.rounds = options.rounds;
  trial.limit = options.limit;
  ReportFolder folder(options.output, "bench_structure");
  std::vector<StructureTime> rows;
  {
    Progress progress("structure bench", structure_bench_rows(trial), "rows");
    std::uint64_t done = 0;
    rows = bench_structures(trial, [&] { progress.done(++done); });
  }
  const std::string json = to_json(rows, options.seed);
  folder.write("bench_structure.csv", to_csv(rows));
  folder.write("bench_structure.json", json);
  folder.finish();
  options.json ? answer(json) : print(to_table(rows));
  const bool good = std::ranges::all_of(rows, [](const StructureTime& row) {
    return row.fault.empty() && row.missed + row.invented == 0;
  });
  return good ? kGood : kFailed;
}

}  // namespace

std::vector<Command> structure_commands() {
  return {
      {"structure",
       "The spatial structures, and those of your own: list, check, bench",
       nullptr,
       {command("list", "List the structures that this program knows", list_structures, json_only),
        command("check",
                "Hold structures against brute force on random worlds; the smallest world on "
                "which one fails is told and written as a scenario",
                check_structures, structure_check_options),
        command("bench", "Time structures beside each other and brute force, in turns", bench,
                structure_bench_options)}}};
}

}  // namespace lantern::app
