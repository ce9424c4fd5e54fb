// What a problem says, as opposed to how it is written: names, ranges, physics.
#include <cmath>
#include <set>

#include <pantin/bridge/problems/rigid_ref.hpp>

#include "problem_index.hpp"
#include "velocity_check.hpp"

namespace pantin {
namespace reference {
namespace {

/// Collects findings about one problem.
class Checker {
 public:
  explicit Checker(const Problem& problem) : problem_{problem}, index_{problem} {}

  std::vector<Diagnostic> run() {
    check_names();
    for (std::size_t i = 0; i < problem_.bodies.size(); ++i) check(problem_.bodies[i], at("bodies", i));
    for (std::size_t i = 0; i < problem_.particles.size(); ++i) {
      const Particle& p = problem_.particles[i];
      expect(p.mass > 0 && std::isfinite(p.mass), at("particles", i) + "/mass", "particle '" + p.name + "'",
             "has a mass of " + std::to_string(p.mass) + " kg", "a mass is greater than zero");
      expect(p.p_W.allFinite() && p.v_W.allFinite(), at("particles", i), "particle '" + p.name + "'",
             "has a place or velocity that is not finite", "correct it");
    }
    for (std::size_t i = 0; i < problem_.kinematic_bodies.size(); ++i) {
      check(problem_.kinematic_bodies[i], at("kinematic_bodies", i));
    }
    for (std::size_t i = 0; i < problem_.joints.size(); ++i) check(problem_.joints[i], at("joints", i));
    for (std::size_t i = 0; i < problem_.forces.size(); ++i) check(problem_.forces[i], at("forces", i));
    for (std::size_t i = 0; i < problem_.contacts.size(); ++i) check(problem_.contacts[i], at("contacts", i));
    expect(problem_.gravity.allFinite(), "/gravity", "gravity", "is not finite", "correct it");
    expect(problem_.duration > 0 && std::isfinite(problem_.duration), "/duration", "duration",
           "is " + std::to_string(problem_.duration) + " s", "it is greater than zero");
    check_samples();
    if (!has_error(found_)) add_velocity_warnings(problem_, index_, found_);
    return std::move(found_);
  }

 private:
  static std::string at(const char* list, std::size_t i) {
    return '/' + std::string{list} + '/' + std::to_string(i);
  }

  void error(const std::string& pointer, std::string subject, std::string problem, std::string remedy) {
    found_.push_back({Severity::Error, problem_.file + '#' + pointer, std::move(subject), std::move(problem),
                      std::move(remedy)});
  }
  void expect(bool good, const std::string& pointer, std::string subject, std::string problem,
              std::string remedy) {
    if (!good) error(pointer, std::move(subject), std::move(problem), std::move(remedy));
  }

  void check_names() {
    std::set<std::string> bodies{kWorld}, joints;
    const auto check_list = [&](const auto& list, const char* key, const char* what,
                                std::set<std::string>& known) {
      for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string& name = list[i].name;
        const std::string subject = std::string{what} + " '" + name + "'", pointer = at(key, i) + "/name";
        expect(!name.empty(), pointer, what, "has an empty name", "name it");
        if (name == kWorld && &known == &bodies) {
          error(pointer, subject, "bears the name of the world", "name it otherwise");
        } else if (!known.insert(name).second) {
          error(pointer, subject, "bears a name that is used before", "names are unique; rename one");
        }
      }
    };
    check_list(problem_.bodies, "bodies", "body", bodies);
    check_list(problem_.particles, "particles", "particle", bodies);
    check_list(problem_.kinematic_bodies, "kinematic_bodies", "kinematic body", bodies);
    check_list(problem_.joints, "joints", "joint", joints);
  }

  void check(const Body& body, const std::string& pointer) {
    const std::string subject = "body '" + body.name + "'";
    if (!(body.mass.mass > 0 && std::isfinite(body.mass.mass))) {
      error(pointer + "/mass", subject, "has a mass of " + std::to_string(body.mass.mass) + " kg",
            "a mass is greater than zero");
      return;
    }
    const std::string inertia = pointer + "/inertia_cog_body";
    if (const auto problem = problem_with(body.mass, InertiaCheck::Solvable)) {
      error(inertia, subject, problem->text, problem->remedy);
      return;
    }
    // No body has such moments, but the equations of motion do not mind.
    if (const auto problem = problem_with(body.mass)) {
      found_.push_back(
          {Severity::Warning, problem_.file + '#' + inertia, subject, problem->text, problem->remedy});
    }
    const RigidBodySettings settings{.name = body.name,
                                     .X_WB = body.X_WB,
                                     .v_WBcm = body.v_WBcm,
                                     .w_WB = body.w_WB,
                                     .mass = body.mass,
                                     .inertia_check = InertiaCheck::Solvable};
    if (const auto problem = problem_with(settings)) error(pointer, subject, problem->text, problem->remedy);
  }

  void check(const KinematicBody& body, const std::string& pointer) {
    const std::string subject = "kinematic body '" + body.name + "'";
    expect(std::abs(body.axis_W.norm() - 1) < 1e-9, pointer + "/axis_world", subject,
           "has an axis that is not unit", "divide it by its length");
    expect(std::abs(body.q_WB.norm() - 1) < 1e-9, pointer + "/orientation_wxyz", subject,
           "has an orientation that is not unit", "divide it by its length");
    const AngleAt start = evaluate(body.law, 0);
    expect(body.p_WA.allFinite() && std::isfinite(start.angle + start.rate + start.acceleration), pointer,
           subject, "has numbers that are not finite", "correct them");
  }

  /// Whether `name` is one of the problem's; particles count only where they can be meant.
  bool known(const std::string& name, const std::string& pointer, const std::string& subject,
             bool particles) {
    const NameKind kind = index_.find(name).kind;
    if (kind == NameKind::Unknown || (kind == NameKind::Particle && !particles)) {
      error(pointer, subject, "names '" + name + "', which is not a body of this problem",
            "check the spelling");
      return false;
    }
    return true;
  }
  bool moves_freely(const std::string& name) const {
    const NameKind kind = index_.find(name).kind;
    return kind == NameKind::Body || kind == NameKind::Particle;
  }

  void check(const Joint& joint, const std::string& pointer) {
    const std::string subject = "joint '" + joint.name + "'";
    if (!known(joint.a, pointer + "/body_a", subject, false)) return;
    if (!known(joint.b, pointer + "/body_b", subject, false)) return;
    expect(joint.a != joint.b, pointer + "/body_b", subject, "joins '" + joint.a + "' with itself",
           "name two bodies");
    expect(moves_freely(joint.a) || moves_freely(joint.b), pointer, subject,
           "joins '" + joint.a + "' and '" + joint.b + "', neither of which it can move", "leave it out");
    expect(joint.p_WJ.allFinite(), pointer + "/anchor_world", subject, "has an anchor that is not finite",
           "correct it");
    expect(std::abs(joint.axis_W.norm() - 1) < 1e-9, pointer + "/axis_world", subject,
           "has an axis that is not unit", "divide it by its length");
  }

  void check(const Force& force, const std::string& pointer) {
    const std::string subject = "force " + type_name(force);
    const auto not_negative = [&](double number, const char* key) {
      expect(number >= 0 && std::isfinite(number), pointer + '/' + key, subject,
             std::string{key} + " is " + std::to_string(number), "it is zero or greater");
    };
    const auto on = [&](const std::string& name, bool particles) {
      const char* key = index_.find(name).kind == NameKind::Particle ? "/particle" : "/body";
      if (known(name, pointer + key, subject, particles)) {
        expect(moves_freely(name), pointer + key, subject, "acts on '" + name + "', which no force moves",
               "name a body that moves freely");
      }
    };
    if (const auto* spring = std::get_if<Spring>(&force)) {
      const bool good = known(spring->a.body, pointer + "/a/body", subject, true) &&
                        known(spring->b.body, pointer + "/b/body", subject, true);
      if (good && !moves_freely(spring->a.body) && !moves_freely(spring->b.body)) {
        error(pointer, subject, "has no end on a body that moves freely", "fasten one end to one");
      }
      check_particle_ends(*spring, pointer, subject);
      not_negative(spring->stiffness, "stiffness");
      not_negative(spring->damping, "damping");
      not_negative(spring->rest_length, "rest_length");
    } else if (const auto* torque = std::get_if<ConstantTorque>(&force)) {
      on(torque->body, false);
    } else if (const auto* drag = std::get_if<Drag>(&force)) {
      on(drag->body, true);
      not_negative(drag->coefficient, "coefficient");
    } else {
      on(std::get<CentralGravity>(force).body, true);
    }
  }

  void check_particle_ends(const Spring& spring, const std::string& pointer, const std::string& subject) {
    const auto is_particle = [&](const SpringEnd& end) {
      return index_.find(end.body).kind == NameKind::Particle;
    };
    if (is_particle(spring.a) && spring.a.body == spring.b.body) {
      error(pointer, subject, "joins particle '" + spring.a.body + "' with itself", "name two ends");
    }
    for (const SpringEnd* end : {&spring.a, &spring.b}) {
      expect(!is_particle(*end) || end->point.isZero(0), pointer + (end == &spring.a ? "/a" : "/b"), subject,
             "is fastened beside particle '" + end->body + "', which is a point", "leave point_body_cog out");
    }
  }

  void check(const Contact& contact, const std::string& pointer) {
    const std::string subject = "contact " + type_name(contact);
    const auto positive = [&](double number, const char* key) {
      expect(number > 0 && std::isfinite(number), pointer + '/' + key, subject,
             std::string{key} + " is " + std::to_string(number), "it is greater than zero");
    };
    if (const auto* box = std::get_if<BoxOnPlane>(&contact.pair)) {
      known(box->body, pointer + "/body", subject, false);
      positive(box->size.minCoeff(), "size");
    } else if (const auto* sphere = std::get_if<SphereOnPlane>(&contact.pair)) {
      known(sphere->body, pointer + "/body", subject, false);
      positive(sphere->radius, "radius");
    } else {
      const auto& pair = std::get<CapsulePair>(contact.pair);
      known(pair.a, pointer + "/body_a", subject, false);
      known(pair.b, pointer + "/body_b", subject, false);
      positive(pair.radius, "radius");
      positive(pair.half_length_a, "half_length_a");
      positive(pair.half_length_b, "half_length_b");
    }
    expect(contact.restitution >= 0 && contact.restitution <= 1, pointer + "/restitution", subject,
           "has a restitution of " + std::to_string(contact.restitution), "it lies between 0 and 1");
    expect(contact.friction >= 0, pointer + "/friction", subject,
           "has a friction of " + std::to_string(contact.friction), "it is zero or greater");
  }

  void check_samples() {
    double last = 0;
    for (std::size_t i = 0; i < problem_.samples.size(); ++i) {
      const Sample& sample = problem_.samples[i];
      expect(sample.t >= last && std::isfinite(sample.t), at("samples", i) + "/t", "sample",
             "is at t = " + std::to_string(sample.t) + " s, before the one it follows or the start",
             "samples stand in the order of time from 0");
      last = sample.t;
      for (const BodySample& body : sample.bodies) {
        if (moves_freely(body.name) || index_.find(body.name).kind == NameKind::KinematicBody) continue;
        error(at("samples", i) + "/state", "sample",
              "holds '" + body.name + "', which is not a body of this problem", "check the spelling");
      }
    }
  }

  const Problem& problem_;
  ProblemIndex index_;
  std::vector<Diagnostic> found_;
};

}  // namespace
}  // namespace reference

std::vector<Diagnostic> findings_in(const ReferenceProblem& problem) {
  return reference::Checker{problem}.run();
}

}  // namespace pantin
