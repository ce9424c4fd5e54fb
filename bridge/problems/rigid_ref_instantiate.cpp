// From a problem to physics: everything is judged before anything is built.
#include <pantin/bridge/problems/rigid_ref.hpp>
#include <pantin/physics/constraints/ball.hpp>
#include <pantin/physics/constraints/fixed.hpp>
#include <pantin/physics/constraints/pivot.hpp>
#include <pantin/physics/constraints/slider.hpp>
#include <pantin/physics/forces/central_attraction.hpp>
#include <pantin/physics/forces/constant_load.hpp>
#include <pantin/physics/forces/damped_spring.hpp>
#include <pantin/physics/forces/gravity.hpp>
#include <pantin/physics/forces/linear_drag.hpp>
#include <pantin/physics/forces/particle_springs.hpp>
#include <pantin/physics/forces/quadratic_drag.hpp>

#include "problem_index.hpp"

namespace pantin {
namespace reference {
namespace {

/// The trajectory of a kinematic body.
class Turning : public Driver {
 public:
  explicit Turning(const KinematicBody& body) : body_{body} {}
  [[nodiscard]] RigidMotion motion(double t, Side) const override {
    const AngleAt now = evaluate(body_.law, t);
    const double turned = now.angle - evaluate(body_.law, 0).angle;
    const Quaternion q_WB = Quaternion{Eigen::AngleAxisd{turned, body_.axis_W}} * body_.q_WB;
    return {.X_AB = {body_.p_WA, q_WB.normalized()},
            .w_AB = now.rate * body_.axis_W,
            .alpha_AB = now.acceleration * body_.axis_W};
  }

 private:
  KinematicBody body_;
};

Diagnostic unsupported(const Problem& problem, const std::string& pointer, std::string subject,
                       std::string what, std::string remedy) {
  return {Severity::Error, problem.file + '#' + pointer, std::move(subject), std::move(what),
          std::move(remedy)};
}

std::vector<Diagnostic> unsupported_parts(const Problem& problem) {
  std::vector<Diagnostic> ledger;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    ledger.push_back(unsupported(problem, "/contacts/" + std::to_string(i),
                                 "contact " + type_name(problem.contacts[i]), "physics has no contacts yet",
                                 "leave it out if the bodies never touch"));
  }
  return ledger;
}

/// Builds in one manager, remembering what was added so that it can be taken out again.
class Builder {
 public:
  Builder(const Problem& problem, PhysicsManager& physics)
      : problem_{problem}, physics_{physics}, index_{problem} {}

  ReferenceInstance build() {
    for (const KinematicBody& body : problem_.kinematic_bodies) add(body);
    for (const Body& body : problem_.bodies) add(body);
    for (const Particle& particle : problem_.particles) add(particle);
    for (const Joint& joint : problem_.joints) add(joint);
    if (!problem_.gravity.isZero(0))
      built_.forces.push_back(physics_.forces().add(Gravity{problem_.gravity}));
    for (const Force& force : problem_.forces) std::visit([this](const auto& law) { add(law); }, force);
    return built_;
  }

 private:
  void add(const KinematicBody& body) {
    RigidBodySettings settings{.name = body.name, .kind = BodyKind::Animated};
    settings.driver = std::make_unique<Turning>(body);
    built_.bodies.emplace(body.name, physics_.add(std::move(settings)));
  }
  void add(const Body& body) {
    built_.bodies.emplace(body.name,
                          physics_.add(RigidBodySettings{.name = body.name,
                                                         .X_WB = body.X_WB,
                                                         .v_WBcm = body.v_WBcm,
                                                         .w_WB = body.w_WB,
                                                         .mass = body.mass,
                                                         .inertia_check = InertiaCheck::Solvable}));
  }

  /// Each particle is a system of its own, so that laws can be meant for it alone.
  void add(const Particle& particle) {
    const ParticleSystemId system = physics_.particles().add(
        ParticleSystemSettings{.name = particle.name, .mass = particle.mass, .capacity = 1});
    built_.particles.emplace(particle.name, physics_.particles().add_particle(
                                                system, {.p_WP = particle.p_W, .v_WP = particle.v_W}));
  }

  [[nodiscard]] ParticleId particle_of(const std::string& name) const {
    const auto found = built_.particles.find(name);
    return found == built_.particles.end() ? ParticleId{} : found->second;
  }
  [[nodiscard]] BodyId id_of(const std::string& name) const {
    const auto found = built_.bodies.find(name);
    return found == built_.bodies.end() ? BodyId{} : found->second;  // the world
  }
  [[nodiscard]] Pose pose_of(const std::string& name) const {
    const ProblemIndex::Entry entry = index_.find(name);
    if (entry.kind == NameKind::Body) return problem_.bodies[entry.position].X_WB;
    if (entry.kind == NameKind::World) return {};
    const KinematicBody& body = problem_.kinematic_bodies[entry.position];
    return {body.p_WA, body.q_WB};
  }

  void add(const Joint& joint) {
    // Physics wants B to be the end that moves; with the ends exchanged and the axis turned round, B against
    // A counts the same way.
    const bool exchange = index_.find(joint.b).kind != NameKind::Body;
    const std::string& a = exchange ? joint.b : joint.a;
    const std::string& b = exchange ? joint.a : joint.b;
    const Vector3 axis_W = exchange ? Vector3{-joint.axis_W} : joint.axis_W;
    const bool has_axis = joint.kind == JointKind::Pivot || joint.kind == JointKind::Slider;
    Pose X_WJ{.p = joint.p_WJ};
    if (has_axis) X_WJ.q = Quaternion::FromTwoVectors(Vector3::UnitZ(), axis_W);
    const Pose X_AJ = inverse(pose_of(a)) * X_WJ, X_BJ = inverse(pose_of(b)) * X_WJ;
    const auto define_as = [&]<class Settings>(Settings settings) {
      settings.name = joint.name;
      settings.a = id_of(a);
      settings.b = id_of(b);
      settings.X_AJ = X_AJ;
      settings.X_BJ = X_BJ;
      built_.joints.emplace(joint.name, physics_.add(std::move(settings)));
    };
    if (joint.kind == JointKind::Pivot) {
      define_as(PivotSettings{});
    } else if (joint.kind == JointKind::Slider) {
      define_as(SliderSettings{});
    } else if (joint.kind == JointKind::Ball) {
      define_as(BallSettings{});
    } else {
      define_as(FixedSettings{});
    }
  }

  [[nodiscard]] Attachment attachment(const SpringEnd& end) const {
    const ProblemIndex::Entry entry = index_.find(end.body);
    if (entry.kind != NameKind::Body) return {id_of(end.body), end.point};  // no mass: from the origin
    return {id_of(end.body), problem_.bodies[entry.position].mass.p_BBcm + end.point};
  }

  template <class Settings>
  void add_law(const Settings& settings) {
    built_.forces.push_back(physics_.forces().add(settings));
  }

  void add(const Spring& spring) {
    const ParticleId a = particle_of(spring.a.body), b = particle_of(spring.b.body);
    if (!a && !b) {
      add_law(DampedSpring{.a = attachment(spring.a),
                           .b = attachment(spring.b),
                           .stiffness = spring.stiffness,
                           .damping = spring.damping,
                           .rest_length = spring.rest_length});
      return;
    }
    ParticleSpring tie{.a = a ? a : b,
                       .stiffness = spring.stiffness,
                       .damping = spring.damping,
                       .rest_length = spring.rest_length};
    if (a && b) {
      tie.b = b;
    } else {
      tie.anchor = attachment(a ? spring.b : spring.a);
    }
    add_law(ParticleSprings{.springs = {tie}});
  }

  template <class Settings>
  void add_to_target(Settings settings, const std::string& name) {
    settings.body = id_of(name);
    settings.particles = particle_of(name).system;
    add_law(settings);
  }

  void add(const Drag& drag) {
    if (drag.quadratic) {
      add_to_target(QuadraticDrag{.coefficient = drag.coefficient, .medium_velocity = drag.medium_velocity},
                    drag.body);
    } else {
      add_to_target(LinearDrag{.coefficient = drag.coefficient, .medium_velocity = drag.medium_velocity},
                    drag.body);
    }
  }
  void add(const ConstantTorque& torque) {
    add_law(ConstantLoad{.body = id_of(torque.body), .torque = torque.torque_W});
  }
  void add(const CentralGravity& gravity) {
    add_to_target(CentralAttraction{.centre = {.p_BQ = gravity.center}, .mu = gravity.mu}, gravity.body);
  }

  const Problem& problem_;
  PhysicsManager& physics_;
  ProblemIndex index_;
  ReferenceInstance built_;
};

/// Joints of the instance that move nothing that resists, and loops that cannot be closed.
std::vector<Diagnostic> singular_parts(const Problem& problem, const ReferenceInstance& built,
                                       const PhysicsManager& physics) {
  std::vector<Diagnostic> ledger;
  for (const auto& [id, finding] : physics.singular_joints()) {
    for (std::size_t i = 0; i < problem.joints.size(); ++i) {
      if (built.joints.find(problem.joints[i].name)->second != id) continue;
      ledger.push_back(unsupported(problem, "/joints/" + std::to_string(i),
                                   "joint '" + problem.joints[i].name + "'", finding.text, finding.remedy));
    }
  }
  return ledger;
}

void take_out(const ReferenceInstance& built, PhysicsManager& physics) {
  for (const ForceId force : built.forces) physics.forces().remove(force);
  for (const auto& [name, joint] : built.joints) physics.remove(joint);
  for (const auto& [name, particle] : built.particles) physics.particles().remove(particle.system);
  for (const auto& [name, body] : built.bodies) physics.remove(body);
}

}  // namespace
}  // namespace reference

Loaded<ReferenceInstance> instantiate(const ReferenceProblem& problem, PhysicsManager& physics) {
  std::vector<Diagnostic> ledger = findings_in(problem);
  if (!has_error(ledger)) {
    for (Diagnostic& part : reference::unsupported_parts(problem)) ledger.push_back(std::move(part));
  }
  if (has_error(ledger)) return {{}, std::move(ledger)};
  ReferenceInstance built = reference::Builder{problem, physics}.build();
  for (Diagnostic& part : reference::singular_parts(problem, built, physics))
    ledger.push_back(std::move(part));
  if (has_error(ledger)) {
    reference::take_out(built, physics);
    return {{}, std::move(ledger)};
  }
  return {std::move(built), std::move(ledger)};
}

}  // namespace pantin
