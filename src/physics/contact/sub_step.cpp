#include "physics/contact/sub_step.hpp"

#include "physics/joint/constrained_motion.hpp"

namespace lantern::physics {
namespace {

// Impulses of what presses go with time, those of a blow do not. A blow in the shortest of
// sub-steps must not be taken for a force, so a guess is only ever made smaller.
double rescaled(double seconds, double old) { return std::min(seconds / old, 1.0); }

template <int D>
class SubSteps {
 public:
  SubSteps(const IslandMove<D>& move, const std::function<void(SubStep<D>&)>& solve)
      : move_(move), island_(move.island), solve_(solve) {}

  void run(int sub_steps) {
    const double h = move_.h, whole = move_.whole;
    const int count = std::max(1, static_cast<int>(std::ceil(h / whole * sub_steps - 1e-9)));
    const double seconds = h / count;
    look_for_contacts(move_.config.warm_start ? seconds : 0);
    const bool pressed = std::ranges::any_of(island_.pairs, &IslandPair<D>::may_press);
    if (!pressed && !island_.joints.empty() && move_constrained(move_)) return remember(h);
    if (!pressed && island_.joints.empty()) {
      fly_all();
      return remember(h);
    }
    if (!island_.joints.empty()) {
      scale_joint_impulses(seconds, whole / sub_steps);
      return swing(seconds);
    }
    if (sub_steps > 1) move_.work.sub_steps += static_cast<std::uint64_t>(count);
    for (int i = 0; i < count; ++i) make(seconds);
    remember(seconds);
  }

 private:
  void make(double seconds) {
    SubStep<D> part(move_, seconds);
    part.begin();
    solve_(part);
    part.end();
  }

  void fly_all() {
    find_increments_if_any<D>(move_.config, island_.bodies, island_.forces, move_.h,
                              island_.increments, move_.work);
    for (std::size_t i = 0; i < island_.bodies.size(); ++i)
      fly(island_.bodies[i], island_.increments[i], move_.h, move_.config.rotation, move_.work);
  }

  void look_for_contacts(double scale_to) {
    island_.find_axes();
    for (IslandPair<D>& pair : island_.pairs) {
      stop_if_asked();
      pair.rows.count = 0;
      if (!pair.pressed) {
        pair.seen = nullptr;  // it is about to move
        continue;
      }
      const double seconds = pair.touch.seconds;
      const double scale = seconds > 0 ? rescaled(scale_to, seconds) : 0;
      island_.find_points(pair, pair.reach, seconds > 0 ? &pair.touch.memory : nullptr, scale,
                          move_.work);
    }
  }

  // Joints begin with impulses of the step's last sub-step, or else with those remembered from the
  // step before, as if these were from none shorter than this step has.
  void scale_joint_impulses(double sub_step, double longest) {
    const bool first = island_.joint_seconds == 0;
    const double scale =
        move_.config.warm_start ? rescaled(sub_step, first ? 1 : island_.joint_seconds) : 0;
    for (JointRows<D>& rows : island_.joints) {
      if (first && rows.seconds > 0) rows.impulse /= std::max(rows.seconds, longest);
      rows.impulse *= scale;
    }
  }

  // What the next sub-step, perhaps of another step, begins with.
  void remember(double h) {
    for (IslandPair<D>& pair : island_.pairs) {
      stop_if_asked();
      auto& [record, memory, seconds] = pair.touch;
      seconds = pair.rows.count > 0 ? h : 0;
      if (pair.rows.count == 0) continue;
      memory.manifold = record.manifold;
      for (std::size_t i = 0; i < pair.rows.points().size(); ++i) {
        memory.normal_impulses[i] = pair.rows.room[i].pn;
        memory.friction_impulses[i] = pair.rows.room[i].pt;
      }
    }
    island_.joint_seconds = h;
  }

  // How fast the tension of joints, by impulses of `seconds`, swings what they hold.
  double swing_of(double seconds) const {
    double most = 0;
    for (const JointRows<D>& rows : island_.joints)
      most = std::max(most, rows.swing_squared(island_.bodies[rows.a], island_.bodies[rows.b],
                                               glm::length(rows.impulse) / seconds));
    return std::sqrt(most);
  }

  // Into how many sub-steps the seconds that are left are cut: so short as is asked for, and as the
  // joints' swinging needs.
  double parts_of(double left, double asked, double last) const {
    const double needed = kJointSettings.most_swing / std::max(swing_of(last), 1e-300);
    const double seconds =
        std::max(std::min(asked, needed), kJointSettings.shortest_sub_step * move_.whole);
    return std::ceil(left / std::min(asked, seconds) - 1e-9);
  }

  // Where joints hold bodies that others touch.
  void swing(double asked) {
    double last = asked;
    for (double left = move_.h; left > 0;) {
      const double parts = std::max(1.0, parts_of(left, asked, last));
      const double seconds = left / parts;
      for (JointRows<D>& rows : island_.joints) rows.impulse *= rescaled(seconds, last);
      for (IslandPair<D>& pair : island_.pairs)
        for (ContactPoint<D>& p : pair.rows.points()) {
          p.pn *= rescaled(seconds, last);
          p.pt *= rescaled(seconds, last);
        }
      make(seconds);
      if (seconds < move_.h) ++move_.work.sub_steps;
      last = seconds;
      left = parts > 1 ? left - seconds : 0;
    }
    remember(last);
  }

  const IslandMove<D>& move_;
  Island<D>& island_;
  const std::function<void(SubStep<D>&)>& solve_;
};

}  // namespace

template <int D>
void in_sub_steps(const IslandMove<D>& move, int sub_steps,
                  const std::function<void(SubStep<D>&)>& solve) {
  SubSteps<D>(move, solve).run(sub_steps);
}

template void in_sub_steps(const IslandMove<2>&, int, const std::function<void(SubStep<2>&)>&);
template void in_sub_steps(const IslandMove<3>&, int, const std::function<void(SubStep<3>&)>&);

}  // namespace lantern::physics
