#include "measure/boxes/worlds.hpp"

#include "base/stop.hpp"
#include "geometry/random_vec.hpp"
#include "run/director.hpp"

namespace lantern::measure {
namespace {

struct NamedSort {
  BoxSort sort;
  const char *name, *words;
};
constexpr NamedSort kSorts[] = {{BoxSort::uniform, "uniform", "{} evenly spread boxes"},
                                {BoxSort::clustered, "clustered", "{} clustered boxes"},
                                {BoxSort::one_huge, "one_huge", "one huge box among {} small ones"},
                                {BoxSort::in_line, "in_line", "{} boxes in a line"},
                                {BoxSort::moving, "moving", "{} moving boxes"}};

template <int D>
BoxScene seeded(const NamedSort& s, std::size_t bodies, std::uint64_t seed) {
  const std::size_t told = s.sort == BoxSort::one_huge ? bodies - 1 : bodies;
  return {fmt::format("{}_{}d", s.name, D),
          fmt::format(fmt::runtime(s.words), told) + (D == 2 ? "" : " in space"),
          seeded_boxes<D>(s.sort, bodies, seed)};
}

template <int D>
BoxUpdates<D> updates_of(const Scenario& scenario, const Frame& frame) {
  BoxUpdates<D> scene{in_dimension<D>(scenario.world.bounds), {{}}};
  for (std::size_t i = 0; i < frame.bodies.size(); ++i)
    scene.frames[0].push_back({static_cast<BodyId>(i), in_dimension<D>(frame.bodies[i].box),
                               frame.bodies[i].is_static, true});
  return scene;
}

constexpr double kJitter2 = 0.1, kJitter3 = 0.2;  // farthest way an axis and step

const std::vector<std::uint64_t> k3{1000}, k4{10000}, k5{100000}, k34{1000, 10000},
    k345{1000, 10000, 100000}, k3456{1000, 10000, 100000, 1000000};

const BoxWorkload kWorkloads[] = {
    {"uniform_2d", BoxTask::pairs, 2,
     "half sizes 0.25 to 0.75, centres uniform in a square of side 2 sqrt(N); each moves by up to "
     "0.1 an axis and step",
     k345, k3456},
    {"clustered_2d", BoxTask::pairs, 2,
     "the same boxes, at angle 2 pi u and distance W/2 v^3 from the centre", k34, k34},
    {"mixed_2d", BoxTask::pairs, 2,
     "uniform, but 99 of 100 half sizes are up to 0.5, and 1 of 100 up to 50", k4, k345},
    {"thin_2d", BoxTask::pairs, 2, "uniform, half sizes 20 x 0.02 and 0.02 x 20", k4, k34},
    {"coincident_2d", BoxTask::pairs, 2, "all centres at one point, which moves", k3, k3},
    {"uniform_3d", BoxTask::pairs, 3,
     "cubes of half size 0.25 to 0.75 in a cube of side 2.4 cbrt(N); each moves by up to 0.2 an "
     "axis and step",
     k345, k3456},
    {"clustered_3d", BoxTask::pairs, 3,
     "the same cubes, each coordinate W/2 + W 0.05 (sum of six uniform numbers - 3)", k34, k345},
    {"brownian_3d", BoxTask::pairs, 3,
     "uniform cubes that fly on, by up to 0.2 an axis and step; one of a hundred turns each step",
     k4, k345},
    {"free_fall_3d", BoxTask::pairs, 3,
     "uniform cubes that all fall alike, each until it lies; the lower half lies", k4, k345},
    {"gravity_3d", BoxTask::pairs, 3,
     "uniform cubes under a pull that turns once in 370 steps, heaped up where it points", k4,
     k345},
    {"town_3d", BoxTask::pairs, 3, "uniform cubes of which 98 of 100 are static", k4, k345},
    {"rays_2d", BoxTask::rays, 2, "uniform boxes; segments up to W/4 long: all hits", k5, k3456},
    {"first_hits_2d", BoxTask::first_hits, 2, "the same: the first hit", k5, k3456},
    {"boxes_2d", BoxTask::boxes, 2, "uniform boxes; boxes of half size up to 5", k5, k3456},
    {"balls_2d", BoxTask::balls, 2, "uniform boxes; balls of radius up to 5", k5, k3456},
    {"nearest_2d", BoxTask::nearest, 2, "uniform boxes; the one nearest to a point", k5, k3456},
    {"rays_3d", BoxTask::rays, 3, "uniform cubes; segments up to W/4 long: all hits", k5, k3456},
    {"first_hits_3d", BoxTask::first_hits, 3, "the same: the first hit", k5, k3456},
    {"boxes_3d", BoxTask::boxes, 3, "uniform cubes; boxes of half size up to 5", k5, k3456},
    {"balls_3d", BoxTask::balls, 3, "uniform cubes; balls of radius up to 5", k5, k3456},
    {"nearest_3d", BoxTask::nearest, 3, "uniform cubes; the one nearest to a point", k5, k3456},
};

// Makes the boxes of one workload and moves them.
template <int D>
class Crowd {
 public:
  Crowd(std::string_view name, std::size_t bodies, std::uint64_t seed)
      : name_(name),
        random_(seed),
        width_(D == 2 ? 2 * std::sqrt(static_cast<double>(bodies))
                      : 2.4 * std::cbrt(static_cast<double>(bodies))) {
    for (std::size_t i = 0; i < bodies; ++i) {
      halves_.push_back(half(i));
      centers_.push_back(center());
      ways_.push_back(random_point<D>(random_, -kJitter3, kJitter3));
      own_.push_back(random_.unit());
    }
    if (name_ == "free_fall_3d") fall_from_half_way();
  }

  BoxUpdates<D> frames(std::size_t count) {
    BoxUpdates<D> all{{Vec<D>(0.0), Vec<D>(width_)}, {}};
    for (std::size_t frame = 0; frame < count; ++frame) {
      stop_if_asked();
      if (frame > 0) move(frame);
      std::vector<Proxy<D>>& proxies = all.frames.emplace_back();
      proxies.reserve(centers_.size());
      for (std::size_t i = 0; i < centers_.size(); ++i)
        proxies.push_back({static_cast<BodyId>(i), Box<D>::around(centers_[i], halves_[i]),
                           name_ == "town_3d" && own_[i] < 0.98, true});
    }
    return all;
  }

 private:
  Vec<D> half(std::size_t i) {
    if (name_ == "mixed_2d") return random_point<D>(random_, 0, random_.unit() < 0.01 ? 50 : 0.5);
    if (name_ == "thin_2d") {
      Vec<D> thin(0.02);
      thin[static_cast<int>(i % 2)] = 20;
      return thin;
    }
    if constexpr (D == 3)
      return Vec<D>(random_.between(0.25, 0.75));
    else
      return random_point<D>(random_, 0.25, 0.75);
  }

  Vec<D> center() {
    const Vec<D> middle(width_ / 2);
    if (name_ == "coincident_2d") return middle;
    if (name_ == "clustered_2d") {
      const double u = random_.unit();
      return middle + random_direction<D>(random_) * (width_ / 2 * u * u * u);
    }
    if (name_ == "clustered_3d") {
      Vec<D> sum(-3.0);
      for (int k = 0; k < 6; ++k) sum += random_point<D>(random_, 0, 1);
      return middle + sum * (0.05 * width_);
    }
    return random_point<D>(random_, 0, width_);
  }

  void move(std::size_t frame) {
    if (name_ == "coincident_2d") {
      const Vec<D> way = random_point<D>(random_, -kJitter2, kJitter2);
      for (Vec<D>& at : centers_) at += way;
    } else if (name_ == "brownian_3d") {
      fly(frame);
    } else if (name_ == "free_fall_3d") {
      fall();
    } else if (name_ == "gravity_3d") {
      heap(frame);
    } else {
      constexpr double kJitter = D == 2 ? kJitter2 : kJitter3;
      for (std::size_t i = 0; i < centers_.size(); ++i)
        if (name_ != "town_3d" || own_[i] >= 0.98)
          centers_[i] += random_point<D>(random_, -kJitter, kJitter);
    }
  }

  // On its way, from wall to wall.
  void fly(std::size_t frame) {
    for (std::size_t i = 0; i < centers_.size(); ++i) {
      if ((i + frame) % 100 == 0) ways_[i] = random_point<D>(random_, -kJitter3, kJitter3);
      for (int axis = 0; axis < D; ++axis) {
        const double next = centers_[i][axis] + ways_[i][axis];
        if (next < 0 || next > width_) ways_[i][axis] = -ways_[i][axis];
      }
      centers_[i] += ways_[i];
    }
  }

  // Each comes to lie at 0.6 of its height. After half of the way of the highest, those below half
  // of the world's height lie.
  void fall_from_half_way() {
    fallen_ = 0.2 * width_;
    for (std::size_t i = 0; i < centers_.size(); ++i) {
      heights_.push_back(centers_[i].y);
      centers_[i].y = std::max(0.6 * heights_[i], heights_[i] - fallen_);
    }
  }
  void fall() {
    fallen_ += kJitter3;
    for (std::size_t i = 0; i < centers_.size(); ++i)
      centers_[i].y = std::max(0.6 * heights_[i], heights_[i] - fallen_);
  }

  // Pulled by 0.02 a step and step, until it lies on the wall or in the heap before it, which
  // reaches to 0.4 of the world.
  void heap(std::size_t frame) {
    constexpr double kTurn = 2 * 3.14159265358979323846 / 370;
    const double angle = kTurn * static_cast<double>(frame + 40);
    Vec<D> pull(0.0);
    pull.x = 0.02 * std::cos(angle);
    pull.y = 0.02 * std::sin(angle);
    for (std::size_t i = 0; i < centers_.size(); ++i) {
      const double rest = 0.4 * width_ * own_[i];
      ways_[i] += pull;
      for (int axis = 0; axis < D; ++axis) {
        double& at = centers_[i][axis];
        const double next =
            std::clamp(at + ways_[i][axis], std::min(rest, at), std::max(width_ - rest, at));
        ways_[i][axis] = next - at;
        at = next;
      }
    }
  }

  std::string_view name_;
  Random random_;
  double width_;  // of the world
  std::vector<Vec<D>> halves_, centers_;
  std::vector<Vec<D>> ways_;     // of each a step
  std::vector<double> own_;      // a number of its own, 0 to 1
  std::vector<double> heights_;  // before the fall
  double fallen_ = 0;
};

template <int D>
Questions<D> random_questions(const Box<D>& bounds, std::uint64_t seed) {
  Random random(seed + 1);
  const double width = bounds.size().x;
  const auto anywhere = [&] { return bounds.lo + random_point<D>(random, 0, 1) * bounds.size(); };
  Questions<D> all;
  for (std::size_t i = 0; i < kQuestions; ++i) {
    const Vec<D> from = anywhere();
    all.rays.push_back({from, random_direction<D>(random) * random.between(0.01, 0.25) * width, 1});
    all.boxes.push_back(Box<D>::around(anywhere(), random_point<D>(random, 0, 5)));
    all.balls.push_back({anywhere(), random.between(0, 5)});
  }
  return all;
}

template <int D>
BoxUpdates<D> each(const BoxUpdates<D>& all, std::size_t part) {
  BoxUpdates<D> few{all.bounds, {{}}};
  for (std::size_t i = 0; i < all.frames[0].size(); i += part) {
    few.frames[0].push_back(all.frames[0][i]);
    few.frames[0].back().id = static_cast<BodyId>(i / part);
  }
  return few;
}

}  // namespace

// --- seeded scenes and those of scenarios ---

std::vector<BoxScene> seeded_box_scenes(std::size_t bodies, std::uint64_t seed) {
  std::vector<BoxScene> scenes;
  for (const NamedSort& sort : kSorts) scenes.push_back(seeded<2>(sort, bodies, seed));
  for (const NamedSort& sort : kSorts) scenes.push_back(seeded<3>(sort, bodies, seed));
  return scenes;
}

BoxScene box_scene_of(const Scenario& scenario) {
  Frame fullest;
  Work work;
  direct(scenario, Pace::step, work, [&](const Frame& frame) {
    const bool passes = traits_of(scenario.steps[frame.step].verb).passes_time;
    if (frame.bodies.size() > fullest.bodies.size() && (fullest.bodies.empty() || !passes))
      fullest = frame;
    return fullest.bodies.empty() || !passes;
  });
  if (fullest.bodies.size() < 2)
    throw ScenarioError(diagnose(scenario, {scenario.file, 0, 0},
                                 "fewer than two of its bodies enter, so there is no pair"));
  BoxScene scene{
      scenario.name, fmt::format("the {} boxes of {}", fullest.bodies.size(), scenario.name), {}};
  if (scenario.world.dimension == 2)
    scene.boxes = updates_of<2>(scenario, fullest);
  else
    scene.boxes = updates_of<3>(scenario, fullest);
  return scene;
}

// --- workloads ---

std::span<const BoxWorkload> box_workloads() { return kWorkloads; }

std::vector<const BoxWorkload*> box_workloads_named(std::string_view name) {
  std::vector<const BoxWorkload*> found;
  for (const BoxWorkload& one : kWorkloads)
    if (one.name == name || one.name.substr(0, one.name.size() - 3) == name) found.push_back(&one);
  return found;
}

BoxScene boxes_of(const BoxWorkload& workload, std::size_t bodies, std::size_t frames,
                  std::uint64_t seed) {
  BoxScene scene{std::string(workload.name), std::string(workload.words), {}};
  const std::string_view name =
      workload.task == BoxTask::pairs ? workload.name : "uniform";  // what is asked lies still
  if (workload.dimension == 2)
    scene.boxes = Crowd<2>(name, bodies, seed).frames(frames);
  else
    scene.boxes = Crowd<3>(name, bodies, seed).frames(frames);
  return scene;
}

std::size_t frames_for(std::size_t bodies) {
  return std::clamp<std::size_t>(1600000 / std::max<std::size_t>(bodies, 1), 3, 24);
}

// --- stages ---

std::size_t BoxStage::bodies() const {
  return std::visit([](const auto& all) { return all.frames[0].size(); }, scene.boxes);
}
std::size_t BoxStage::frames() const {
  return std::visit([](const auto& all) { return all.frames.size(); }, scene.boxes);
}

BoxStage stage_of(const BoxWorkload& workload, std::size_t bodies, std::uint64_t seed) {
  const std::size_t frames = workload.task == BoxTask::pairs ? frames_for(bodies) : 1;
  BoxStage stage{std::string(workload.name), workload.task,
                 boxes_of(workload, bodies, frames, seed), Questions<2>{}};
  if (workload.task != BoxTask::pairs)
    std::visit([&](const auto& all) { stage.questions = random_questions(all.bounds, seed); },
               stage.scene.boxes);
  return stage;
}

BoxStage thinned(const BoxStage& stage, std::size_t part) {
  BoxStage few{stage.workload, stage.task, {stage.scene.name, stage.scene.words, {}}, {}};
  std::visit([&](const auto& all) { few.scene.boxes = each(all, part); }, stage.scene.boxes);
  return few;
}

}  // namespace lantern::measure
