// A scene as MuJoCo's file of a model (MJCF).
#pragma once

#include <sstream>
#include <string>

#include "peers/joint_tree.hpp"
#include "peers/peer_run.hpp"

namespace lantern::peers {

// Bodies with contacts: from the first on Newton's dense matrices are too large, from the second on
// so is its model.
inline constexpr std::size_t kManyForNewton = 64, kMany = 400;

inline constexpr std::size_t kPointsABody = 16;

inline std::string text(double number) {
  std::ostringstream out;
  out.precision(17);
  out << number;
  return out.str();
}

inline std::string text(const Vec<3>& v) {
  std::ostringstream out;
  out.precision(17);
  out << v.x << ' ' << v.y << ' ' << v.z;
  return out.str();
}

inline std::string text(const glm::dquat& q) {
  std::ostringstream out;
  out.precision(17);
  out << q.w << ' ' << q.x << ' ' << q.y << ' ' << q.z;
  return out.str();
}

inline std::string geom_of(const PeerBody& body, bool is_flat) {
  const std::string friction =
      " condim=\"3\" friction=\"" + text({body.material.friction, 0, 0}) + "\"/>";
  const std::string of_shape = visit_peer_shape(
      body.shape, [](const Sphere& s) { return "sphere\" size=\"" + text(Vec<3>(s.radius)); },
      [&](const Vec<3>& half) { return "box\" size=\"" + text(with_depth(half, is_flat)); },
      [](const Capsule& c) {  // MuJoCo's lies along z
        return "capsule\" quat=\"1 1 0 0\" size=\"" + text({c.radius, c.half_length, 0});
      },
      [](const HalfSpace<3>& s) { return "plane\" size=\"0 0 1\" zaxis=\"" + text(s.normal); });
  return "<geom type=\"" + of_shape + "\"" + friction;
}

// One way to run it.
struct Variant {
  const char *name, *integrator;
  bool is_hard;  // contacts as stiff as the manual allows, else as by default
};

inline bool is_large(const PeerScene& scene) {
  return scene.collides() && scene.bodies.size() > kManyForNewton;
}

// The scene as an MJCF file. What is jointed hangs on what it is jointed to, by hinges and balls;
// only what closes a loop, and rods in space, are equations to be kept.
class Mjcf {
 public:
  Mjcf(const PeerScene& scene, double h, const Variant& variant)
      : scene_(scene), tree_(scene), equation_(hard(h, "0.9999") + "/>") {
    out_.precision(17);
    out_ << "<mujoco><compiler angle=\"radian\" inertiafromgeom=\"false\"/><option timestep=\"" << h
         << "\" gravity=\"" << text(scene.gravity) << "\" integrator=\"" << variant.integrator
         << "\" cone=\"elliptic\" solver=\"" << (is_large(scene) ? "CG" : "Newton")
         << "\"><flag contact=\"" << (scene.collides() ? "enable" : "disable") << "\"/></option>";
    out_ << size();
    if (variant.is_hard) out_ << "<default><geom" << hard(h, "0.99") << "/></default>";
    out_ << "<worldbody>";
    for (std::size_t i = 0; i < scene.links.size(); ++i)
      if (!scene.links[i].b) site(i, 'b', scene.links[i].at_b);
    for (const Hanging& one : tree_.all())
      if (!one.parent) add(one);
    out_ << "</worldbody><tendon>";
    for (std::size_t i = 0; i < scene.links.size(); ++i) add_tendon(scene.links[i], i);
    out_ << "</tendon><equality>";
    for (std::size_t i = 0; i < scene.links.size(); ++i) add_equation(scene.links[i], i);
    out_ << "</equality><contact>";
    for (const PeerLink& link : scene.links)
      if (link.b && link.kind != LinkSpec::Kind::spring)
        out_ << "<exclude body1=\"b" << link.a << "\" body2=\"b" << *link.b << "\"/>";
    out_ << "</contact></mujoco>";
  }
  std::string text_of_file() const { return out_.str(); }

 private:
  // Left to itself it makes room for some hundred contacts, and drops what is more.
  std::string size() const {
    const std::size_t contacts = scene_.collides() ? kPointsABody * scene_.bodies.size() : 0;
    const std::size_t rows = 3 * contacts + 3 * scene_.links.size() + 16;
    return "<size nconmax=\"" + std::to_string(contacts + 16) + "\" njmax=\"" +
           std::to_string(rows) + "\"/>";
  }

  // MuJoCo's manual: a time constant of at least two steps; an impedance of at most 0.9999.
  // Contacts with friction want it lower.
  static std::string hard(double h, const char* impedance) {
    return " solref=\"" + text(2 * h) + " 1\" solimp=\"" + impedance + " " + impedance + " 0.001\"";
  }

  void site(std::size_t link, char end, const Vec<3>& at) {
    out_ << "<site name=\"s" << link << end << "\" pos=\"" << text(at) << "\"/>";
  }

  void add(const Hanging& one) {
    const std::size_t i = one.body;
    const PeerBody& body = scene_.bodies[i];
    Vec<3> place = body.position;
    glm::dquat turned_by = body.orientation.q;
    if (one.parent) {
      const PeerBody& parent = scene_.bodies[*one.parent];
      place = glm::transpose(matrix(parent.orientation)) * (place - parent.position);
      turned_by = glm::conjugate(parent.orientation.q) * turned_by;
    }
    out_ << "<body name=\"b" << i << "\" pos=\"" << text(place) << "\" quat=\"" << text(turned_by)
         << "\">";
    if (body.is_dynamic()) {
      // What may not turn has an inertia that is not used.
      const Vec<3> inertia = body.may_turn ? body.inertia : Vec<3>(body.mass);
      out_ << "<inertial pos=\"0 0 0\" mass=\"" << body.mass << "\" diaginertia=\"" << text(inertia)
           << "\"/>";
      one.link ? joints(one) : joints(body);
    }
    if (scene_.collides()) out_ << geom_of(body, scene_.is_flat());
    for (std::size_t k = 0; k < scene_.links.size(); ++k) {
      if (scene_.links[k].a == i) site(k, 'a', scene_.links[k].at_a);
      if (scene_.links[k].b == i) site(k, 'b', scene_.links[k].at_b);
    }
    for (const Hanging& child : tree_.all())
      if (child.parent == i) add(child);
    out_ << "</body>";
  }

  // Of what hangs: where it is held; of a rod first where that turns about the other end.
  void joints(const Hanging& one) {
    const PeerBody& body = scene_.bodies[one.body];
    const auto joint = [&](const Vec<3>& at) {
      out_ << "<joint type=\"" << (scene_.is_flat() ? "hinge\" axis=\"0 0 1" : "ball")
           << "\" pos=\"" << text(at) << "\"/>";
    };
    if (one.is_rod) joint(glm::transpose(matrix(body.orientation)) * (one.anchor - body.position));
    joint(one.at);
  }

  // Of what is free. Slides lie along the world's axes, whose place in the body's own is asked for.
  void joints(const PeerBody& body) {
    if (!scene_.is_flat() && body.may_turn) {
      out_ << "<freejoint/>";
      return;
    }
    const Mat<3> to_body = glm::transpose(matrix(body.orientation));
    for (int axis = 0; axis < scene_.dimension; ++axis)
      out_ << "<joint type=\"slide\" axis=\"" << text(to_body[axis]) << "\" damping=\""
           << body.linear_drag << "\"/>";
    if (body.may_turn)
      out_ << "<joint type=\"hinge\" axis=\"0 0 1\" damping=\"" << body.angular_drag << "\"/>";
  }

  void add_tendon(const PeerLink& link, std::size_t i) {
    if (link.kind == LinkSpec::Kind::pin || tree_.hangs_by(i)) return;
    out_ << "<spatial name=\"t" << i << "\"";
    if (link.kind == LinkSpec::Kind::spring)
      out_ << " springlength=\"" << link.length << "\" stiffness=\"" << link.stiffness
           << "\" damping=\"" << link.damping << "\"";
    out_ << "><site site=\"s" << i << "a\"/><site site=\"s" << i << "b\"/></spatial>";
  }

  void add_equation(const PeerLink& link, std::size_t i) {
    if (link.kind == LinkSpec::Kind::spring || tree_.hangs_by(i)) return;
    if (link.kind == LinkSpec::Kind::pin) {
      out_ << "<connect body1=\"b" << link.a << "\" anchor=\"" << text(link.at_a) << "\"";
      if (link.b) out_ << " body2=\"b" << *link.b << "\"";
    } else {
      const double longer = link.length - glm::length(link.to - link.from);
      out_ << "<tendon tendon1=\"t" << i << "\" polycoef=\"" << longer << " 0 0 0 0\"";
    }
    out_ << equation_;
  }

  const PeerScene& scene_;
  const JointTree tree_;
  const std::string equation_;
  std::ostringstream out_;
};

}  // namespace lantern::peers
