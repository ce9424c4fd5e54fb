#include <cmath>

#include <pantin/scenegraph/expects.hpp>
#include <pantin/scenegraph/link.hpp>
#include <pantin/scenegraph/rotation.hpp>

namespace pantin {
namespace {

constexpr double kUnitTolerance =
    1e-9;  // of an axis' length: the error this makes in a matrix stays below it

bool is_invertible(const Affine& M) {
  const Vector3 lengths = M.linear().colwise().stableNorm();
  if (!(lengths.minCoeff() > 0)) return false;
  const Matrix3 directions = M.linear() * lengths.cwiseInverse().asDiagonal();
  return std::abs(directions.determinant()) > 1e-14;
}

std::string problem_with_frame(const Affine& M, const char* name) {
  if (!M.affine().allFinite()) return std::string{name} + " has an entry that is not finite";
  if (!is_invertible(M)) return std::string{name} + " is singular; its scale must not be 0 along any axis";
  return {};
}

std::string problem_with_mimic(const Link& link) {
  if (value_size(link.kind) != 1)
    return "a " + std::string{to_string(link.kind)} +
           " link cannot follow another; only pivots, sliders and screws can";
  if (link.mimic->source.empty()) return "mimic names no link to follow";
  if (!std::isfinite(link.mimic->multiplier) || !std::isfinite(link.mimic->offset))
    return "multiplier and offset of mimic must be finite";
  return {};
}

std::string problem_with_axis(const Vector3& axis, const char* name) {
  const double length = axis.stableNorm();
  if (std::abs(length - 1) <= kUnitTolerance) return {};
  return std::string{name} + " has length " + std::to_string(length) + "; it must be 1, so normalise it";
}

std::string problem_with_axes(const Link& link) {
  if (!has_axis(link.kind)) return {};
  if (std::string text = problem_with_axis(link.axis, "axis"); !text.empty()) return text;
  if (!has_axis2(link.kind)) return {};
  if (std::string text = problem_with_axis(link.axis2, "axis2"); !text.empty()) return text;
  if (std::abs(link.axis.dot(link.axis2)) <= kUnitTolerance) return {};
  return "axis2 is not perpendicular to axis; take its part along axis away and normalise it";
}

std::string problem_with_limits(const Link& link) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(limit_count(link.kind)); ++i) {
    const LinkLimits& limits = link.limits[i];
    if (limits.lower <= limits.upper) continue;
    return "lower limit " + std::to_string(limits.lower) + " is above the upper limit " +
           std::to_string(limits.upper);
  }
  return {};
}

Matrix3 turn(double angle, const Vector3& axis) { return Eigen::AngleAxisd{angle, axis}.toRotationMatrix(); }

Affine displacement(const Link& link, const LinkValue& value) {
  Affine T = Affine::Identity();
  switch (link.kind) {
    case LinkKind::Fixed:
      break;
    case LinkKind::Pivot:
      T.linear() = turn(value[0], link.axis);
      break;
    case LinkKind::Slider:
      T.translation() = value[0] * link.axis;
      break;
    case LinkKind::Ball:
      T.linear() = rotation_matrix(Quaternion{value[0], value[1], value[2], value[3]});
      break;
    case LinkKind::Cylindrical:
      T.linear() = turn(value[0], link.axis);
      T.translation() = value[1] * link.axis;
      break;
    case LinkKind::Universal:
      T.linear() = turn(value[0], link.axis) * turn(value[1], link.axis2);
      break;
    case LinkKind::Planar:
      T.linear() = turn(value[2], link.axis);
      T.translation() = value[0] * link.axis2 + value[1] * link.axis.cross(link.axis2);
      break;
    case LinkKind::Screw:
      T.linear() = turn(value[0], link.axis);
      T.translation() = value[0] * link.pitch * link.axis;
      break;
    case LinkKind::Free:
      T.translation() = Vector3{value[0], value[1], value[2]};
      T.linear() = rotation_matrix(Quaternion{value[3], value[4], value[5], value[6]});
      break;
  }
  return T;
}

}  // namespace

std::string problem_with(const Link& link) {
  if (std::string text = problem_with(link.kind, link.value); !text.empty()) return text;
  if (std::string text = problem_with_frame(link.M_PJ, "M_PJ"); !text.empty()) return text;
  if (std::string text = problem_with_frame(link.M_JN, "M_JN"); !text.empty()) return text;
  if (link.mimic)
    if (std::string text = problem_with_mimic(link); !text.empty()) return text;
  if (link.kind == LinkKind::Screw && !std::isfinite(link.pitch))
    return "pitch is not finite; it is metres per rad";
  if (std::string text = problem_with_axes(link); !text.empty()) return text;
  return problem_with_limits(link);
}

Affine local_matrix(const Link& link, const LinkValue& value) {
  const std::string problem = problem_with(link.kind, value);
  PANTIN_EXPECTS(problem.empty(), problem);
  return link.M_PJ * displacement(link, value) * link.M_JN;
}

Link with_zero_offset(Link link, const LinkValue& offset) {
  const std::string problem = problem_with(link.kind, offset);
  PANTIN_EXPECTS(problem.empty(), "offset: " + problem);
  PANTIN_EXPECTS(limit_count(link.kind) == value_size(link.kind),
                 "a " + std::string{to_string(link.kind)} +
                     " link is counted by a quaternion: change M_PJ or M_JN instead");
  // T(v) = A T(v + offset) B: one turns back by the first angle before, the other by the last after.
  LinkValue back = offset;
  for (int i = 0; i < back.size(); ++i) back[i] = -offset[i];
  LinkValue before = back, after = zero_value(link.kind);
  if (link.kind == LinkKind::Universal) std::swap(before[1], after[1]);
  if (link.kind == LinkKind::Planar) std::swap(before[2], after[2]);
  link.M_PJ = link.M_PJ * displacement(link, before);
  link.M_JN = displacement(link, after) * link.M_JN;
  for (int i = 0; i < offset.size(); ++i) {
    LinkLimits& limits = link.limits[static_cast<std::size_t>(i)];
    limits.lower += offset[i];
    limits.upper += offset[i];
    if (link.value.size() > i) link.value[i] += offset[i];
  }
  if (link.mimic) link.mimic->offset += offset[0];
  return link;
}

}  // namespace pantin
