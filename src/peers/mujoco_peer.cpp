// MuJoCo: generalised coordinates; soft contacts as a convex problem. By its Euler, which takes
// damping implicitly, by one that takes all forces of velocities implicitly, and by Runge-Kutta of
// order 4.
#include <algorithm>
#include <array>
#include <cstring>
#include <initializer_list>
#include <sstream>
#include <string>

#include <mujoco/mujoco.h>

#include "peers/joint_tree.hpp"
#include "peers/peer_run.hpp"

namespace lantern::peers {
namespace {

// Bodies with contacts: from the first on Newton's dense matrices are too large, from the second on
// so is its model.
constexpr std::size_t kManyForNewton = 64, kMany = 400;

constexpr std::size_t kPointsABody = 16;

// Numbers with 17 digits, parted by blanks.
std::string text(std::initializer_list<double> numbers) {
  std::ostringstream out;
  out.precision(17);
  for (const char* between = ""; const double number : numbers) {
    out << between << number;
    between = " ";
  }
  return out.str();
}
std::string text(double number) { return text({number}); }
std::string text(const Vec<3>& v) { return text({v.x, v.y, v.z}); }
std::string text(const glm::dquat& q) { return text({q.w, q.x, q.y, q.z}); }

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

// One way to run it.
struct Variant {
  const char *name, *integrator;
  bool is_hard;  // contacts as stiff as the manual allows, else as by default
};

bool is_large(const PeerScene& scene) {
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

using Model = std::unique_ptr<mjModel, decltype([](mjModel* model) { mj_deleteModel(model); })>;
using Data = std::unique_ptr<mjData, decltype([](mjData* data) { mj_deleteData(data); })>;

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
  MujocoRun(const PeerScene& scene, double h, const Variant& variant)
      : PeerRun(scene, h),
        model_(compiled(Mjcf(scene_, h, variant).text_of_file())),
        data_(mj_makeData(model_.get())) {
    if (!data_) throw Refused("no memory");
    places_.resize(scene.bodies.size());
    const JointTree tree(scene_);
    for (const Hanging& one : tree.all()) {
      find(one);
      if (scene.bodies[one.body].is_dynamic()) one.link ? set_speed(one) : set_speed(one.body);
    }
  }

 protected:
  void step() override {
    mj_step(model_.get(), data_.get());
    for (const int pushed : pushed_) std::fill_n(data_->xfrc_applied + 6 * pushed, 6, 0.0);
    pushed_.clear();
    is_placed_ = false;
  }

  // MuJoCo begins anew, with a warning, when a state is beyond 1e10 or not a number.
  bool is_finite() const override {
    for (const int full : {mjWARN_CONTACTFULL, mjWARN_CNSTRFULL})
      if (data_->warning[full].number > 0) throw Refused("more contacts than MuJoCo has room for");
    for (const int bad : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC})
      if (data_->warning[bad].number > 0) return false;
    return true;
  }

  PeerMotion motion(std::size_t i) const override {
    const PeerBody& body = scene_.bodies[i];
    if (!body.is_dynamic()) return {body.position, body.velocity, body.orientation, body.turning};
    place_bodies();
    const int id = places_[i].id;
    const mjtNum *x = data_->xpos + 3 * id, *q = data_->xquat + 4 * id;
    std::array<mjtNum, 6> v{};  // turning first
    mj_objectVelocity(model_.get(), data_.get(), mjOBJ_BODY, id, v.data(), 0);
    return {{x[0], x[1], x[2]},
            {v[3], v[4], v[5]},
            {glm::dquat(q[0], q[1], q[2], q[3])},
            {v[0], v[1], v[2]}};
  }

  // The sum of all hinges from here to what never moves.
  std::optional<double> whole_angle(std::size_t i) const override {
    double angle = scene_.bodies[i].angle;
    for (int id = places_[i].id; id > 0; id = model_->body_parentid[id])
      for (int k = 0; k < model_->body_jntnum[id]; ++k) {
        const int joint = model_->body_jntadr[id] + k;
        if (model_->jnt_type[joint] == mjJNT_HINGE)
          angle += data_->qpos[model_->jnt_qposadr[joint]];
      }
    return angle;
  }

  void push(std::size_t i, const Vec<3>& force, const Vec<3>& arm) override {
    const Vec<3> torque = cross(arm, force);
    mjtNum* sum = data_->xfrc_applied + 6 * places_[i].id;
    for (int axis = 0; axis < 3; ++axis) {
      sum[axis] += force[axis];
      sum[3 + axis] += torque[axis];
    }
    pushed_.push_back(places_[i].id);
  }

  void set_velocity(std::size_t i, const Vec<3>& velocity) override {
    if (!scene_.bodies[i].is_dynamic()) return;
    if (places_[i].hangs) throw Refused("MuJoCo's joints leave no velocity to be set");
    for (int axis = 0; axis < scene_.dimension; ++axis)
      data_->qvel[places_[i].v + axis] = velocity[axis];
    is_placed_ = false;
  }

 private:
  struct Place {
    int id = 0, v = 0;  // its own number and the first speed
    bool hangs = false;
  };

  void find(const Hanging& one) {
    const std::string name = "b" + std::to_string(one.body);
    const int id = mj_name2id(model_.get(), mjOBJ_BODY, name.c_str());
    if (id < 0) throw Refused("a body is lost");
    places_[one.body] = {id, std::max(0, model_->body_dofadr[id]), one.link.has_value()};
  }

  // What hangs: hinges' and balls' speeds; a ball's in the body's own axes.
  void set_speed(const Hanging& one) {
    mjtNum* v = data_->qvel + places_[one.body].v;
    const HangingSpin spin = spin_of(scene_, one);
    if (scene_.is_flat()) {
      if (one.is_rod) *v++ = spin.of_rod.z;
      *v = spin.of_body.z;
      return;
    }
    const Vec<3> own = glm::transpose(matrix(scene_.bodies[one.body].orientation)) * spin.of_body;
    for (int axis = 0; axis < 3; ++axis) v[axis] = own[axis];
  }

  void set_speed(std::size_t i) {
    const PeerBody& body = scene_.bodies[i];
    const int at = places_[i].v;
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

  // A step ends with new coordinates and speeds, of which it has made no places yet.
  void place_bodies() const {
    if (is_placed_) return;
    mj_kinematics(model_.get(), data_.get());
    mj_comPos(model_.get(), data_.get());
    mj_comVel(model_.get(), data_.get());
    is_placed_ = true;
  }

  Model model_;
  Data data_;
  std::vector<Place> places_;
  std::vector<int> pushed_;
  mutable bool is_placed_ = false;
};

constexpr Variant kVariants[] = {{"MuJoCo:Euler", "Euler", false},
                                 {"MuJoCo:implicit", "implicit", false},
                                 {"MuJoCo:RK4", "RK4", false},
                                 {"MuJoCo:Euler,hard", "Euler", true}};

std::optional<std::string> cannot(const PeerScene& scene, const Variant& variant) {
  if (variant.is_hard && !scene.collides()) return "nothing touches: its contacts do not matter";
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
extern "C" void lantern_peers(std::vector<Peer>& peers) {
  // Else it writes a file into the current folder, and ends the program.
  mju_user_warning = [](const char*) {};
  mju_user_error = [](const char* why) { throw Refused(why); };
  for (const Variant& variant : kVariants)
    peers.push_back(
        {variant.name,
         LANTERN_PEER_VERSION,
         {.precision = "double",
          .integrator = variant.integrator,
          .solver =
              "Newton's method on the convex problem of all contacts and equations; conjugate "
              "gradients beyond 64 bodies that collide",
          .iterations = "100 at most, to a tolerance of 1e-8, as by default",
          .joints =
              "hinge, ball; connect and tendon equations (solref 2 h, solimp 0.9999) only for "
              "what closes a loop and for rods in space; springs as tendons",
          .flags = variant.is_hard ? "contacts: elliptic cone, solref 2 h, solimp 0.99 0.99"
                                   : "contacts: elliptic cone, solref and solimp as by default",
          .source = variant.is_hard
                        ? "MuJoCo's manual, Modeling: Solver parameters; XML reference: option"
                        : "MuJoCo's manual, Computation: Numerical integration"},
         [&variant](const PeerScene& scene) { return cannot(scene, variant); },
         [&variant](const PeerScene& scene, double h) {
           return std::make_unique<MujocoRun>(scene, h, variant);
         }});
}

}  // namespace lantern::peers
