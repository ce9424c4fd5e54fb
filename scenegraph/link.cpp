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
  if (link.kind != LinkKind::Pivot && link.kind != LinkKind::Slider)
    return "a " + std::string{to_string(link.kind)} +
           " link cannot follow another; only pivots and sliders can";
  if (link.mimic->source.empty()) return "mimic names no link to follow";
  if (!std::isfinite(link.mimic->multiplier) || !std::isfinite(link.mimic->offset))
    return "multiplier and offset of mimic must be finite";
  return {};
}

}  // namespace

std::string problem_with(const Link& link) {
  if (std::string text = problem_with(link.kind, link.value); !text.empty()) return text;
  if (std::string text = problem_with_frame(link.M_PJ, "M_PJ"); !text.empty()) return text;
  if (std::string text = problem_with_frame(link.M_JN, "M_JN"); !text.empty()) return text;
  if (link.mimic)
    if (std::string text = problem_with_mimic(link); !text.empty()) return text;
  if (link.kind != LinkKind::Pivot && link.kind != LinkKind::Slider) return {};
  const double length = link.axis.stableNorm();
  if (!(std::abs(length - 1) <= kUnitTolerance))
    return "axis has length " + std::to_string(length) + "; it must be 1, so normalise it";
  if (!(link.lower <= link.upper))
    return "lower limit " + std::to_string(link.lower) + " is above the upper limit " +
           std::to_string(link.upper);
  return {};
}

Affine local_matrix(const Link& link, const LinkValue& value) {
  const std::string problem = problem_with(link.kind, value);
  PANTIN_EXPECTS(problem.empty(), problem);
  Affine T = Affine::Identity();
  switch (link.kind) {
    case LinkKind::Fixed:
      break;
    case LinkKind::Pivot:
      T.linear() = Eigen::AngleAxisd{value[0], link.axis}.toRotationMatrix();
      break;
    case LinkKind::Slider:
      T.translation() = value[0] * link.axis;
      break;
    case LinkKind::Ball:
      T.linear() = rotation_matrix(Quaternion{value[0], value[1], value[2], value[3]});
      break;
    case LinkKind::Free:
      T.translation() = Vector3{value[0], value[1], value[2]};
      T.linear() = rotation_matrix(Quaternion{value[3], value[4], value[5], value[6]});
      break;
  }
  return link.M_PJ * T * link.M_JN;
}

}  // namespace pantin
