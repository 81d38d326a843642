// Twice as many bodies at the same density are twice as much work, whatever the verb and the
// structure. Work is what can be counted again to the last one: bytes that are asked for, bodies
// that structures are built of, and every count of the engine's own. What none of these sees shows
// in instructions: tests/deep/linear.sh.
#include <cmath>
#include <functional>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "counted_memory.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"
#include "spatial/broad_phase.hpp"

namespace lantern::run::linear {
namespace {

// n log n at some hundred bodies, and what chance adds to the pairs of bodies that lie at random.
constexpr double kMostGrowth = 2.3;
// Of each count: that of a few bodies more or less is no growth.
constexpr double kSlack = 100, kSlackBytes = 8192;

struct Setting {
  StructureKind kind;
  int dimension = 2;
  std::string world;      // more keys of it
  std::string ties;       // springs and joints
  std::string insertion;  // more keys of the step
};

// Where bodies lie so that each has as many neighbours, however many there are. Trees that halve
// their cells have those of the same shape in a square; a sweep compares those beside each other on
// its axis, and planes part along one axis, so that their world grows along x only.
Vec<3> size_of(const Setting& setting, int bodies) {
  const bool solid = setting.dimension == 3;
  const bool is_cube = setting.kind == StructureKind::octree;
  const bool is_square =
      setting.kind == StructureKind::quadtree || setting.kind == StructureKind::lecture_quadtree;
  const double space = bodies * (solid ? 9.0 : 2.25), height = solid ? 4 : 6;
  if (is_cube) return Vec<3>(std::cbrt(space));
  if (!is_square) return {space / (solid ? height * height : height), height, height};
  const double side = std::sqrt(solid ? space / height : space);
  return solid ? Vec<3>(side, height, side) : Vec<3>(side, side, 0);
}

std::string point(const Vec<3>& p, int dimension) {
  return dimension == 2 ? fmt::format("[{}, {}]", p.x, p.y)
                        : fmt::format("[{}, {}, {}]", p.x, p.y, p.z);
}

// Planes across x, each dividing what is left in halves, so that a few bodies are between two.
std::string planes(double from, double to, const std::string& at, int dimension) {
  constexpr double kNarrow = 2.3;
  if (to - from < 2 * kNarrow) return {};
  const double middle = (from + to) / 2;
  const std::string below = at == "root" ? "" : at + ".";
  return fmt::format("[[structure.planes]]\nat = \"{}\"\npoint = {}\nnormal = {}\n", at,
                     point({middle, 0, 0}, dimension), point({1, 0, 0}, dimension)) +
         planes(from, middle, below + "back", dimension) +
         planes(middle, to, below + "front", dimension);
}

std::string text_of(const Setting& s, int bodies) {
  const Vec<3> size = size_of(s, bodies), middle = size / 2.0;
  const auto at = [&](const Vec<3>& p) { return point(p, s.dimension); };
  const std::string kind(to_string(s.kind));
  const bool has_contacts = s.world.find("contacts") != s.world.npos;
  std::vector<std::string> script = {
      "do = \"insert\"\nbodies = [\"b\"]\n" + s.insertion,
      "do = \"move\"\nbody = \"b1\"\nto = " + at(middle),
      "do = \"impulse\"\nbody = \"b2\"\nimpulse = " + at({0, 1, 0}),
      "do = \"force\"\nbody = \"b3\"\nforce = " + at({0, 1, 0}),
      "do = \"run\"\nseconds = 0.02\nevery = 2",
      "do = \"phases\"",
      "do = \"sleep\"\nbodies = [\"b\"]\nexpect = { asleep = [\"b1..b" + std::to_string(bodies) +
          "\"] }",
      "do = \"wait\"\nevent = \"asleep\"\nbodies = [\"b\"]\nat_most = 0.01",
      "do = \"wake\"\nbodies = [\"b\"]",
      "do = \"rebuild\"\nkind = \"" + kind + "\"",
      "do = \"ray\"\nhits = \"all\"\nfrom = " + at(middle - Vec<3>(0, 2, 0)) +
          "\nto = " + at(middle + Vec<3>(0, 2, 0)),
      "do = \"ray\"\nfrom = " + at({0, 0, 0}) + "\nto = " + at({4, 4, 4}),
      "do = \"cull\"\neye = " + at(middle) + "\ntarget = " + at(middle + Vec<3>(0, 1, 0)) +
          "\nfar = 3",
      "do = \"query\"\nmin = " + at({0, 0, 0}) + "\nmax = " + at(size),
      "do = \"query\"\nmin = " + at({0, 0, 0}) + "\nmax = " + at(size) +
          "\npace = \"event\"\nevents = [\"skip\"]",
      "do = \"test_shapes\"",
      "do = \"emit\"\nbodies = [\"late\"]\nevery = 0.01",
      "do = \"remove\"\nbodies = [\"b\"]",
      "do = \"show\""};
  const auto before_removal = script.end() - 2;
  if (has_contacts)
    script.insert(before_removal, "do = \"solve_by\"\ncontacts = \"soft\"\nsub_steps = 4");
  else if (s.kind == StructureKind::sort_and_sweep)
    script.insert(before_removal, "do = \"sweep\"");
  // The nature of choosing a BSP's planes is the square.
  else if (counts_its_work(s.kind) && s.kind != StructureKind::grid && s.kind != StructureKind::bsp)
    script.insert(
        before_removal,
        "do = \"compare\"\nbodies = [\"b\"]\nrow = \"all\"\nkinds = [\"grid\", \"" + kind + "\"]");
  if (s.dimension == 2)
    for (const char* verb : {"separate", "gjk"})
      script.insert(script.end() - 2, fmt::format("do = \"{}\"\npair = [\"b1\", \"b2\"]", verb));
  std::string structure = fmt::format("[structure]\nkind = \"{}\"\n", kind);
  if (s.kind == StructureKind::kd_tree)
    structure += "max_depth = 12\n";
  else if (traits_of(s.kind).splits)
    structure += "capacity = 6\nmax_depth = 12\n";
  if (s.kind == StructureKind::bsp) structure += planes(0, size.x, "root", s.dimension);
  return world_text(
      fmt::format("size = {}\ntime_step = 0.01\nmay_sleep = true\n"
                  "quiet = [\"contacts\", \"energy\", \"outside\", \"view\"]\n{}",
                  at(size), s.world),
      structure +
          fmt::format("[[pattern]]\nname = \"b\"\ncount = {}\nradius = 0.4\nspeed = 1\n"
                      "[[pattern]]\nname = \"late\"\ncount = {}\nradius = 0.4\n",
                      bodies, bodies) +
          s.ties + steps(script));
}

using Costs = std::map<std::string, double>;

// What each step of the script cost, a frame.
std::vector<Costs> costs_of(const std::string& text) {
  const Scenario scenario = good(text);
  Work work;
  std::vector<Costs> costs(scenario.steps.size());
  std::vector<double> frames(scenario.steps.size());
  std::uint64_t bytes_before = counted_memory::bytes, builds_before = 0;
  direct(scenario, Pace::step, work, [&](const Frame& frame) {
    const std::uint64_t bytes_now = counted_memory::bytes;
    Costs& cost = costs[frame.step];
    ++frames[frame.step];
    cost["bytes"] += static_cast<double>(bytes_now - bytes_before);
    cost["bodies built of"] += static_cast<double>(work.structure_builds - builds_before) *
                               static_cast<double>(frame.bodies.size());
    builds_before = work.structure_builds;
    for (const auto& [name, count] : frame.counts)
      if (!name.ends_with("all_pairs") && !name.ends_with("able_pairs") && name != "compared_pairs")
        cost[name] += static_cast<double>(count);
    if (frame.since_last_frame)
      for (const WorldCounter& counter : kWorldCounters)
        cost["world's " + std::string(counter.name)] +=
            static_cast<double>((*frame.since_last_frame).*counter.count);
    bytes_before = counted_memory::bytes;
    return true;
  });
  for (std::size_t i = 0; i < costs.size(); ++i)
    for (auto& [name, cost] : costs[i]) cost /= frames[i];
  return costs;
}

void expect_linear(const Setting& setting, int bodies) {
  const std::string text = text_of(setting, bodies);
  const Scenario scenario = good(text);
  const std::vector<Costs> once = costs_of(text), twice = costs_of(text_of(setting, 2 * bodies));
  for (std::size_t step = 0; step < once.size(); ++step)
    for (const auto& [name, cost] : twice[step]) {
      const auto before = once[step].find(name);
      const double most = kMostGrowth * (before == once[step].end() ? 0 : before->second);
      EXPECT_LE(cost, most + (name == "bytes" ? kSlackBytes : kSlack))
          << to_string(setting.kind) << " in " << setting.dimension << "D, " << setting.world
          << setting.ties << setting.insertion << ": '" << traits_of(scenario.steps[step].verb).name
          << "' (step " << step << "), " << name;
    }
}

// But brute force, whose nature is the square.
void expect_all_linear(const std::function<void(StructureKind, int)>& expect) {
  std::vector<StructureKind> kinds(kStructureKinds.begin(), kStructureKinds.end());
  kinds.push_back(StructureKind::automatic);
  std::erase(kinds, StructureKind::brute_force);
  for (const int dimension : {2, 3})
    for (const StructureKind kind : kinds)
      if (is_possible(kind, dimension)) expect(kind, dimension);
}

// So many that n log n is below the bound, and that `auto` takes no brute force.
int bodies_for(StructureKind kind) {
  if (kind == StructureKind::bsp) return 800;
  const bool is_binary = kind == StructureKind::kd_tree || kind == StructureKind::aabb_tree;
  return is_binary || kind == StructureKind::automatic ? 400 : 200;
}

TEST(Linear, EveryVerbInEveryStructure) {
  expect_all_linear([](StructureKind kind, int dimension) {
    expect_linear({kind, dimension, "", "", ""}, bodies_for(kind));
  });
}

// An insertion is watched for what is told of none.
TEST(Linear, WithEvents) {
  expect_all_linear([](StructureKind kind, int dimension) {
    expect_linear({kind, dimension, "", "", "pace = \"event\"\nevents = [\"depth_limit\"]"},
                  bodies_for(kind));
  });
}

// A frame for each event would list all bodies as often as there are events. The cells of a grid
// suit the bodies there are, so that it is made anew for each one that enters watched.
TEST(Linear, WithEventsThatNobodyLooksAt) {
  const auto bytes_of = [](StructureKind kind, int dimension, int bodies) {
    const Scenario scenario = good(text_of({kind, dimension, "", "", "pace = \"event\""}, bodies));
    Work work;
    const std::uint64_t before = counted_memory::bytes;
    const auto nobody = [](const Frame& frame) { return frame.event != "insert"; };  // its end
    direct(scenario, Pace::step, work, nobody, nullptr, Wanted::outcomes);
    return static_cast<double>(counted_memory::bytes - before);
  };
  expect_all_linear([&](StructureKind kind, int dimension) {
    if (kind == StructureKind::grid || kind == StructureKind::automatic) return;
    const int bodies = bodies_for(kind);
    EXPECT_LE(bytes_of(kind, dimension, 2 * bodies),
              kMostGrowth * bytes_of(kind, dimension, bodies) + kSlackBytes)
        << to_string(kind) << " in " << dimension << "D";
  });
}

TEST(Linear, OfBodiesThatAreTiedTogether) {
  for (const char* link : {"[[spring]]\nalong = \"b\"\nstiffness = 5\n",
                           "[[joint]]\nkind = \"distance\"\nalong = \"b\"\n"})
    expect_linear({StructureKind::grid, 2, "", link, ""}, 200);
}

}  // namespace
}  // namespace lantern::run::linear
