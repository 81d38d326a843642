#include "measure/forms/linkage.hpp"

#include <utility>

#include <glm/geometric.hpp>

namespace lantern::measure {
namespace {

constexpr long double kTolerance = 1e-16L;
constexpr std::size_t kNumbers = 6;  // of a body: place, angle, and their rates

FlatLong turned_by(long double angle, const FlatLong& v) {
  const long double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}
FlatLong across(const FlatLong& v) { return {-v.y, v.x}; }

// Solves a x = b, a dense, by elimination with the largest pivot of each column. Throws Refused if
// it is singular.
std::vector<long double> solved(std::vector<std::vector<long double>> a,
                                std::vector<long double> b) {
  const std::size_t n = b.size();
  long double largest = 0;
  for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::abs(a[i][i]));
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(a[i][k]) > std::abs(a[best][k])) best = i;
    if (!(std::abs(a[best][k]) > 1e-12L * largest))
      throw Refused("its joints depend on each other");
    std::swap(a[k], a[best]);
    std::swap(b[k], b[best]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const long double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

}  // namespace

// Of each row u . (acceleration of a's point - acceleration of b's point) = right: what a unit of
// its multiplier does to every body.
struct Linkage::Rows {
  struct Push {
    std::size_t body = 0;
    FlatLong force{0.0L};
    long double torque = 0;
  };
  std::vector<std::vector<Push>> pushes;
  std::vector<long double> right;
};

Linkage::Linkage(std::vector<Body> bodies, std::vector<Joint> joints, const FlatLong& gravity)
    : bodies_(std::move(bodies)),
      joints_(std::move(joints)),
      gravity_(gravity),
      method_(kTolerance, scale()) {
  for (const Body& b : bodies_)
    for (const long double number :
         {b.position.x, b.position.y, b.angle, b.velocity.x, b.velocity.y, b.spin})
      y_.push_back(number);
  look_at_energy();
  start_ = std::exchange(worst_, 0);
}

const std::vector<Linkage::Body>& Linkage::at(long double time) {
  method_.run([this](long double, const State& y, State& dy) { slope(y, dy); }, time_, time, y_);
  time_ = time;
  unpack(y_);
  look_at_energy();
  return bodies_;
}

// A unit of each: what matters is the number of digits.
std::vector<long double> Linkage::scale() const {
  return std::vector<long double>(kNumbers * bodies_.size(), 1.0L);
}

void Linkage::look_at_energy() {
  long double kinetic = 0, potential = 0;
  for (const Body& b : bodies_) {
    kinetic += (b.mass * glm::dot(b.velocity, b.velocity) + b.inertia * b.spin * b.spin) / 2;
    potential -= b.mass * glm::dot(gravity_, b.position);
  }
  most_kinetic_ = std::max(most_kinetic_, kinetic);
  const long double off = kinetic + potential - start_;
  worst_ = time_ > 0 ? std::max(worst_, std::abs(off)) : off;
}

void Linkage::unpack(const State& y) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const long double* of = &y[kNumbers * i];
    Body& body = bodies_[i];
    body.position = {of[0], of[1]};
    body.angle = of[2];
    body.velocity = {of[3], of[4]};
    body.spin = of[5];
  }
}

void Linkage::add_rows(const Joint& joint, Rows& rows) const {
  struct End {
    std::optional<std::size_t> body;
    FlatLong arm{0.0L}, place{0.0L}, velocity{0.0L};
    FlatLong inwards{0.0L};  // the acceleration that turning gives it
  };
  const auto end = [this](std::optional<std::size_t> body, const FlatLong& at) -> End {
    if (!body) return {body, FlatLong(0.0L), at, FlatLong(0.0L), FlatLong(0.0L)};
    const Body& b = bodies_[*body];
    const FlatLong arm = turned_by(b.angle, at);
    return {body, arm, b.position + arm, b.velocity + b.spin * across(arm), -b.spin * b.spin * arm};
  };
  const End a = end(joint.a, joint.at_a), b = end(joint.b, joint.at_b);
  const auto add = [&](const FlatLong& u, long double right) {
    std::vector<Rows::Push> pushes{{*a.body, u, glm::dot(u, across(a.arm))}};
    if (b.body) pushes.push_back({*b.body, -u, -glm::dot(u, across(b.arm))});
    rows.pushes.push_back(std::move(pushes));
    rows.right.push_back(right - glm::dot(u, a.inwards - b.inwards));
  };
  if (joint.length) {  // d . d'' + d' . d' = 0
    const FlatLong rate = a.velocity - b.velocity;
    add(a.place - b.place, -glm::dot(rate, rate));
  } else {
    add({1, 0}, 0);
    add({0, 1}, 0);
  }
}

// Gravity, and the multipliers that keep the second derivative of each joint's gap at 0.
void Linkage::slope(const State& y, State& dy) {
  unpack(y);
  Rows rows;
  for (const Joint& joint : joints_) add_rows(joint, rows);
  const std::size_t n = rows.right.size();
  std::vector<std::vector<long double>> matrix(n, std::vector<long double>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (const Rows::Push& p : rows.pushes[i]) {
      const Body& body = bodies_[p.body];
      rows.right[i] -= glm::dot(p.force, gravity_);
      for (std::size_t j = 0; j < n; ++j)
        for (const Rows::Push& q : rows.pushes[j])
          if (q.body == p.body)
            matrix[i][j] +=
                glm::dot(p.force, q.force) / body.mass + p.torque * q.torque / body.inertia;
    }
  const std::vector<long double> multipliers = solved(std::move(matrix), std::move(rows.right));
  dy.resize(y.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    const long double rates[] = {body.velocity.x, body.velocity.y, body.spin,
                                 gravity_.x,      gravity_.y,      0};
    std::copy(std::begin(rates), std::end(rates), &dy[kNumbers * i]);
  }
  for (std::size_t i = 0; i < n; ++i)
    for (const Rows::Push& p : rows.pushes[i]) {
      const Body& body = bodies_[p.body];
      long double* rates = &dy[kNumbers * p.body];
      rates[3] += multipliers[i] * p.force.x / body.mass;
      rates[4] += multipliers[i] * p.force.y / body.mass;
      rates[5] += multipliers[i] * p.torque / body.inertia;
    }
}

}  // namespace lantern::measure
