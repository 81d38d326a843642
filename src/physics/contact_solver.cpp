#include "physics/contact_solver.hpp"

#include <algorithm>
#include <array>

#include "base/check.hpp"
#include "lecture/physics_system.hpp"

namespace lantern::physics {

template <int D>
void sequential_impulses(Island<D>&, const WorldConfig<D>&, double h, double whole, WorldWork&);
template <int D>
void soft_sub_steps(Island<D>&, const WorldConfig<D>&, double h, double whole, WorldWork&);
template <int D>
void direct_solve(Island<D>&, const WorldConfig<D>&, double h, double whole, WorldWork&);
template <int D>
void lecture_impulses(Island<D>&, const WorldConfig<D>&, double h, double whole, WorldWork&);

namespace {

// In the order of the enumerators.
template <int D>
constexpr std::array<ContactSolver<D>, 5> kSolvers = {{
    {ContactMethod::none, "none", soft_sub_steps<D>},  // of joints alone
    {ContactMethod::impulse, "impulse", sequential_impulses<D>},
    {ContactMethod::soft, "soft", soft_sub_steps<D>},
    {ContactMethod::direct, "direct", direct_solve<D>},
    {ContactMethod::lecture, "lecture", lecture_impulses<D>, true,
     lecture::PhysicsSystem::numCollisionFrames},
}};

}  // namespace

template <int D>
const ContactSolver<D>& contact_solver(ContactMethod method) {
  const auto place = static_cast<std::size_t>(method);
  LANTERN_CHECK(place, <, kSolvers<D>.size());
  return kSolvers<D>[place];
}

std::string_view to_string(ContactMethod method) { return contact_solver<2>(method).name; }

std::optional<ContactMethod> contact_method_named(std::string_view name) {
  const auto solver = std::ranges::find(kSolvers<2>, name, &ContactSolver<2>::name);
  if (solver == kSolvers<2>.end()) return std::nullopt;
  return solver->method;
}

std::vector<std::string_view> contact_method_names() {
  std::vector<std::string_view> names;
  for (const ContactSolver<2>& solver : kSolvers<2>) names.push_back(solver.name);
  return names;
}

template const ContactSolver<2>& contact_solver(ContactMethod);
template const ContactSolver<3>& contact_solver(ContactMethod);

}  // namespace lantern::physics
