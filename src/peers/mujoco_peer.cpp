// MuJoCo: generalised coordinates; soft contacts as a convex problem. By its Euler, which takes
// damping implicitly, and by Runge-Kutta of order 4.
#include <array>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include <mujoco/mujoco.h>

#include "peers/peer_run.hpp"

namespace lantern::peers {
namespace {

constexpr std::size_t kMany = 200;  // bodies with contacts: its matrices are dense

std::string text(const Vec<3>& v) {
  std::ostringstream out;
  out.precision(17);
  out << v.x << ' ' << v.y << ' ' << v.z;
  return out.str();
}

std::string text(const glm::dquat& q) {
  std::ostringstream out;
  out.precision(17);
  out << q.w << ' ' << q.x << ' ' << q.y << ' ' << q.z;
  return out.str();
}

std::string geom_of(const PeerBody& body, bool is_flat) {
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

// The scene as an MJCF file.
class Mjcf {
 public:
  Mjcf(const PeerScene& scene, double h, const char* integrator) {
    out_.precision(17);
    out_ << "<mujoco><compiler angle=\"radian\" inertiafromgeom=\"false\"/><option timestep=\"" << h
         << "\" gravity=\"" << text(scene.gravity) << "\" integrator=\"" << integrator
         << "\" cone=\"elliptic\"><flag contact=\"" << (scene.collides() ? "enable" : "disable")
         << "\"/></option><worldbody>";
    for (std::size_t i = 0; i < scene.links.size(); ++i)
      if (!scene.links[i].b) site(i, 'b', scene.links[i].at_b);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) add(scene, i);
    out_ << "</worldbody><tendon>";
    for (std::size_t i = 0; i < scene.links.size(); ++i) add_tendon(scene.links[i], i);
    out_ << "</tendon><equality>";
    for (std::size_t i = 0; i < scene.links.size(); ++i) add_joint(scene.links[i], i);
    out_ << "</equality><contact>";
    for (const PeerLink& link : scene.links)
      if (link.b && link.kind != LinkSpec::Kind::spring)
        out_ << "<exclude body1=\"b" << link.a << "\" body2=\"b" << *link.b << "\"/>";
    out_ << "</contact></mujoco>";
  }
  std::string text_of_file() const { return out_.str(); }

 private:
  void site(std::size_t link, char end, const Vec<3>& at) {
    out_ << "<site name=\"s" << link << end << "\" pos=\"" << text(at) << "\"/>";
  }

  void add(const PeerScene& scene, std::size_t i) {
    const PeerBody& body = scene.bodies[i];
    out_ << "<body name=\"b" << i << "\" pos=\"" << text(body.position) << "\" quat=\""
         << text(body.orientation.q) << "\">";
    if (body.is_dynamic()) {
      // What may not turn has an inertia that is not used.
      const Vec<3> inertia = body.may_turn ? body.inertia : Vec<3>(body.mass);
      out_ << "<inertial pos=\"0 0 0\" mass=\"" << body.mass << "\" diaginertia=\"" << text(inertia)
           << "\"/>";
      joints(scene, body);
    }
    if (scene.collides()) out_ << geom_of(body, scene.is_flat());
    for (std::size_t k = 0; k < scene.links.size(); ++k) {
      if (scene.links[k].a == i) site(k, 'a', scene.links[k].at_a);
      if (scene.links[k].b == i) site(k, 'b', scene.links[k].at_b);
    }
    out_ << "</body>";
  }

  // Slides lie along the world's axes, whose place in the body's own is asked for.
  void joints(const PeerScene& scene, const PeerBody& body) {
    if (!scene.is_flat() && body.may_turn) {
      out_ << "<freejoint/>";
      return;
    }
    const Mat<3> to_body = glm::transpose(matrix(body.orientation));
    for (int axis = 0; axis < scene.dimension; ++axis)
      out_ << "<joint type=\"slide\" axis=\"" << text(to_body[axis]) << "\" damping=\""
           << body.linear_drag << "\"/>";
    if (body.may_turn)
      out_ << "<joint type=\"hinge\" axis=\"0 0 1\" damping=\"" << body.angular_drag << "\"/>";
  }

  void add_tendon(const PeerLink& link, std::size_t i) {
    if (link.kind == LinkSpec::Kind::pin) return;
    out_ << "<spatial name=\"t" << i << "\"";
    if (link.kind == LinkSpec::Kind::spring)
      out_ << " springlength=\"" << link.length << "\" stiffness=\"" << link.stiffness
           << "\" damping=\"" << link.damping << "\"";
    out_ << "><site site=\"s" << i << "a\"/><site site=\"s" << i << "b\"/></spatial>";
  }

  void add_joint(const PeerLink& link, std::size_t i) {
    if (link.kind == LinkSpec::Kind::pin) {
      out_ << "<connect body1=\"b" << link.a << "\" anchor=\"" << text(link.at_a) << "\"";
      if (link.b) out_ << " body2=\"b" << *link.b << "\"";
      out_ << "/>";
    } else if (link.kind == LinkSpec::Kind::distance) {
      const double longer = link.length - glm::length(link.to - link.from);
      out_ << "<tendon tendon1=\"t" << i << "\" polycoef=\"" << longer << " 0 0 0 0\"/>";
    }
  }

  std::ostringstream out_;
};

struct ModelDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using Model = std::unique_ptr<mjModel, ModelDeleter>;
using Data = std::unique_ptr<mjData, DataDeleter>;

// MuJoCo reads a model from a file only; this one is in memory.
Model compiled(const std::string& file) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(file.size()));
  const int index = mj_findFileVFS(files.get(), "scene.xml");
  if (index < 0) throw Refused("the scene is too large a file");
  std::memcpy(files->filedata[index], file.data(), file.size());
  std::array<char, 500> why{};
  Model model(mj_loadXML("scene.xml", files.get(), why.data(), static_cast<int>(why.size())));
  mj_deleteVFS(files.get());
  if (!model) throw Refused(why.data());
  return model;
}

class MujocoRun : public PeerRun {
 public:
  MujocoRun(const PeerScene& scene, double h, const char* integrator)
      : PeerRun(scene, h),
        model_(compiled(Mjcf(scene, h, integrator).text_of_file())),
        data_(mj_makeData(model_.get())) {
    if (!data_) throw Refused("no memory");
    int q = 0, v = 0;
    for (const PeerBody& body : scene.bodies) {
      places_.push_back({q, v});
      if (!body.is_dynamic()) continue;
      set_speed(body, v);
      const bool is_free = !scene.is_flat() && body.may_turn;
      const int slides = scene.dimension + (scene.is_flat() && body.may_turn ? 1 : 0);
      q += is_free ? 7 : slides;
      v += is_free ? 6 : slides;
    }
  }

 protected:
  void step() override { mj_step(model_.get(), data_.get()); }

  // MuJoCo begins anew, with a warning, when a state is beyond 1e10 or not a number.
  bool is_finite() const override {
    for (const int bad : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC})
      if (data_->warning[bad].number > 0) return false;
    return true;
  }

  PeerMotion motion(std::size_t i) const override {
    const PeerBody& body = scene_.bodies[i];
    PeerMotion m = motion_at_start(body);
    if (!body.is_dynamic()) return m;
    const mjtNum *q = data_->qpos + places_[i].q, *v = data_->qvel + places_[i].v;
    if (scene_.is_flat() || !body.may_turn) {
      for (int axis = 0; axis < scene_.dimension; ++axis) {
        m.position[axis] += q[axis];
        m.velocity[axis] = v[axis];
      }
      if (!body.may_turn) return m;
      m.orientation = turned(body.orientation, {0, 0, q[2]});
      m.spin = {0, 0, v[2]};
      return m;
    }
    m.position = {q[0], q[1], q[2]};
    m.velocity = {v[0], v[1], v[2]};
    m.orientation = {glm::dquat(q[3], q[4], q[5], q[6])};
    m.spin = matrix(m.orientation) * Vec<3>(v[3], v[4], v[5]);  // it keeps it in the body's axes
    return m;
  }

  std::optional<double> whole_angle(std::size_t i) const override {
    const PeerBody& body = scene_.bodies[i];
    if (!body.is_dynamic() || !body.may_turn) return body.angle;
    return body.angle + data_->qpos[places_[i].q + 2];
  }

  // Its tendons are springs: none is pulled by force.
  std::pair<Vec<3>, Vec<3>> centre(std::size_t) const override { return {}; }
  void push(std::size_t, const Vec<3>&, const Vec<3>&) override {}

  void set_velocity(std::size_t i, const Vec<3>& velocity) override {
    if (!scene_.bodies[i].is_dynamic()) return;
    for (int axis = 0; axis < scene_.dimension; ++axis)
      data_->qvel[places_[i].v + axis] = velocity[axis];
  }

 private:
  struct Place {
    int q, v;  // first coordinate and speed
  };

  void set_speed(const PeerBody& body, int at) {
    mjtNum* v = data_->qvel + at;
    for (int axis = 0; axis < scene_.dimension; ++axis) v[axis] = body.velocity[axis];
    if (!body.may_turn) return;
    if (scene_.is_flat()) {
      v[2] = body.turning.z;
      return;
    }
    const Vec<3> spin = glm::transpose(matrix(body.orientation)) * body.turning;
    for (int axis = 0; axis < 3; ++axis) {
      v[3 + axis] = spin[axis];
      model_->dof_damping[at + axis] = body.linear_drag;
      model_->dof_damping[at + 3 + axis] = body.angular_drag;
    }
  }

  Model model_;
  Data data_;
  std::vector<Place> places_;
};

std::optional<std::string> cannot(const PeerScene& scene) {
  if (scene.gravitation > 0) return "MuJoCo has no forces between two bodies but tendons";
  for (const PeerBody& body : scene.bodies) {
    if (body.kind == BodyKind::kinematic_body)
      return "body '" + body.name + "': MuJoCo has no bodies that keep their velocity";
    if (!scene.collides()) continue;
    if (body.material.restitution > 0)
      return "body '" + body.name + "': MuJoCo's contacts know no restitution";
    if (body.material.friction != scene.bodies[0].material.friction)
      return "MuJoCo takes the larger friction of a pair";
  }
  if (scene.collides() && scene.bodies.size() > kMany) return "it has too many bodies for MuJoCo";
  return solid_engine_cannot(scene);
}

}  // namespace
}  // namespace lantern::peers

extern "C" void lantern_peers(std::vector<lantern::measure::Peer>& peers) {
  using namespace lantern::peers;
  // Else it writes a file into the current folder, and ends the program.
  mju_user_warning = [](const char*) {};
  mju_user_error = [](const char* why) { throw lantern::Refused(why); };
  for (const auto& [name, integrator] :
       {std::pair("MuJoCo", "Euler"), std::pair("MuJoCo:RK4", "RK4")})
    peers.push_back({name, LANTERN_PEER_VERSION, cannot, [=](const PeerScene& scene, double h) {
                       return std::make_unique<MujocoRun>(scene, h, integrator);
                     }});
}
