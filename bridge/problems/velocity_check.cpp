#include "velocity_check.hpp"

#include <cstdio>

namespace pantin::reference {
namespace {

/// Motion of the body point that is now at `p_WJ`, with the size of the terms that made it.
struct PointMotion {
  Vector3 v{Vector3::Zero()}, w{Vector3::Zero()};
  double terms{0};
};

PointMotion motion_at(const Problem& problem, const ProblemIndex::Entry& entry, const Vector3& p_WJ) {
  if (entry.kind == NameKind::Body) {
    const Body& body = problem.bodies[entry.position];
    const Vector3 p_BcmJ_W = p_WJ - (body.X_WB * body.mass.p_BBcm);
    return {body.v_WBcm + body.w_WB.cross(p_BcmJ_W), body.w_WB,
            body.v_WBcm.norm() + body.w_WB.norm() * (1 + p_BcmJ_W.norm())};
  }
  if (entry.kind == NameKind::KinematicBody) {
    const KinematicBody& body = problem.kinematic_bodies[entry.position];
    const Vector3 w = evaluate(body.law, 0).rate * body.axis_W, p_AJ = p_WJ - body.p_WA;
    return {w.cross(p_AJ), w, w.norm() * (1 + p_AJ.norm())};
  }
  return {};
}

}  // namespace

void add_velocity_warnings(const Problem& problem, const ProblemIndex& index,
                           std::vector<Diagnostic>& ledger) {
  for (std::size_t i = 0; i < problem.joints.size(); ++i) {
    const Joint& joint = problem.joints[i];
    const PointMotion a = motion_at(problem, index.find(joint.a), joint.p_WJ);
    const PointMotion b = motion_at(problem, index.find(joint.b), joint.p_WJ);
    // Without the part along what the joint leaves free, seen from A: a slider's anchor on B moves away along
    // the axis, so both are compared at the same place in the world, where A's rotation gives both the same
    // velocity.
    Vector3 v = b.v - a.v, w = b.w - a.w;
    if (joint.kind == JointKind::Slider) v -= joint.axis_W * joint.axis_W.dot(v);
    if (joint.kind == JointKind::Pivot) w -= joint.axis_W * joint.axis_W.dot(w);
    if (joint.kind == JointKind::Ball) w.setZero();
    const double tolerance = 1e-9 * (1 + a.terms + b.terms);
    if (v.norm() <= tolerance && w.norm() <= tolerance) continue;
    char problem_text[160];
    std::snprintf(problem_text, sizeof problem_text,
                  "holds '%.40s' and '%.40s', which start with %.3g m/s and %.3g rad/s across it",
                  joint.a.c_str(), joint.b.c_str(), v.norm(), w.norm());
    ledger.push_back({Severity::Warning, problem.file + "#/joints/" + std::to_string(i),
                      "joint '" + joint.name + "'", problem_text,
                      "correct the velocities; else the first step projects them on the joints"});
  }
}

}  // namespace pantin::reference
