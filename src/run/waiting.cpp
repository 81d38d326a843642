#include "run/waiting.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/suggest.hpp"

namespace lantern::run {
namespace {

using Event = Wait::Event;

// {0} and {1} are the two that are waited for; of a node, {0} and the node.
constexpr const char* kAwaited[] = {
    "no touch of {} and {}",      "no parting of {} and {}",     "",
    "no crush between {} and {}", "no entry of {} into node {}", "no exit of {} from node {}"};

// "'a', 'b' and 3 more"
std::string listed(const std::vector<std::string>& all) {
  constexpr std::size_t kMost = 4;
  const std::span told = std::span(all).first(std::min(all.size(), kMost));
  const std::size_t more = all.size() - told.size();
  return fmt::format("{}{}", fmt::join(told, ", "),
                     more > 0 ? fmt::format(" and {} more", more) : "");
}

}  // namespace

Waiting::Waiting(const Wait& wait, const Scenario& scenario, Engine& engine)
    : wait_(wait), scenario_(scenario), engine_(engine) {
  for (const std::size_t body : wait.bodies) bodies_.insert(*engine.id_of(body));
  for (const std::size_t body : wait.others) others_.insert(*engine.id_of(body));
  if (wait.for_node()) before_ = engine.members_of_nodes();
}

bool Waiting::is_over() {
  if (wait_.event == Event::asleep)
    return std::ranges::all_of(wait_.bodies, [&](std::size_t i) { return engine_.is_asleep(i); });
  return wait_.for_node() ? saw_node() : saw_pair();
}

bool Waiting::saw_pair() {
  for (const auto& [a, b] : engine_.told_of(wait_.event)) {
    if ((bodies_.contains(a) && others_.contains(b)) ||
        (bodies_.contains(b) && others_.contains(a)))
      return true;
    const bool near = std::ranges::any_of(
        std::array{a, b}, [&](BodyId id) { return bodies_.contains(id) || others_.contains(id); });
    note(near, fmt::format("{} and {}", engine_.name_of(a), engine_.name_of(b)));
  }
  return false;
}

bool Waiting::saw_node() {
  const Engine::Members now = engine_.members_of_nodes();
  const bool enters = wait_.event == Event::enter;
  const Engine::Members &without = enters ? before_ : now, &with = enters ? now : before_;
  bool over = false;
  for (const auto& [label, members] : with) {
    if (label.empty()) continue;  // of a level only leaves have one
    const auto other = without.find(label);
    for (const BodyId id : members) {
      if (!bodies_.contains(id) || (other != without.end() && other->second.contains(id))) continue;
      over |= label == wait_.node;
      note(true, fmt::format("{} {} '{}'", engine_.name_of(id), enters ? "into" : "from", label));
    }
  }
  was_there_ |= now.contains(wait_.node) || before_.contains(wait_.node);
  before_ = now;
  return over;
}

void Waiting::note(bool near, std::string what) {
  const double time = static_cast<double>(engine_.world_work().steps) * scenario_.world.time_step;
  if (std::ranges::find(instead_, what, &Happened::what) == instead_.end())
    instead_.push_back({near, std::move(what), time});
}

std::string Waiting::in_vain() const {
  const std::string within = fmt::format(" within {} s", wait_.at_most);
  if (wait_.event == Event::asleep) {
    std::vector<std::string> awake;
    for (const std::size_t body : wait_.bodies)
      if (!engine_.is_asleep(body)) awake.push_back(engine_.name_of(*engine_.id_of(body)));
    return fmt::format("not asleep{}: {}, of {}", within, listed(awake), wait_.bodies.size());
  }
  const auto named = [](const std::string& name) { return fmt::format("'{}'", name); };
  const std::string missed =
      fmt::format(fmt::runtime(kAwaited[static_cast<std::size_t>(wait_.event)]),
                  named(wait_.named.front()),
                  named(wait_.for_node() ? wait_.node : wait_.named.back())) +
      within;
  if (wait_.for_node() && !was_there_) {
    const auto label = [](const auto& entry) -> std::string_view { return entry.first; };
    return with_suggestion(missed + ": there was no such node", wait_.node, mapped(before_, label));
  }
  const auto pushed = [&](std::size_t i) {
    return scenario_.bodies[i].kind == BodyKind::dynamic_body;
  };
  if (!wait_.for_node() && std::ranges::none_of(wait_.bodies, pushed) &&
      std::ranges::none_of(wait_.others, pushed))
    return missed + ": static and kinematic bodies never touch each other";
  const bool any_near = std::ranges::any_of(instead_, &Happened::near);
  std::vector<std::string> told;
  for (const Happened& one : instead_)
    if (one.near == any_near) told.push_back(fmt::format("{} at {:.4g} s", one.what, one.time));
  const auto held = before_.find(wait_.node);
  const auto is_there = [&](BodyId id) { return held->second.contains(id); };
  if (told.empty() && wait_.event == Event::enter && held != before_.end() &&
      std::ranges::any_of(bodies_, is_there))
    return missed + ": it is there from the start";
  if (told.empty()) return missed + ", nor any other";
  return fmt::format("{}, but {}{}", missed, any_near ? "" : "of others: ", listed(told));
}

}  // namespace lantern::run
