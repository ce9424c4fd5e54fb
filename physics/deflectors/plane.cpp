#include <pantin/physics/deflectors/plane.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

class PlaneSolid final : public SolidShape {
 public:
  std::string_view kind() const override { return "plane"; }
  double bounding_radius() const override { return std::numeric_limits<double>::infinity(); }
  double distance(const Vector3& p_D, Vector3& normal_D) const override {
    normal_D = Vector3::UnitZ();
    return p_D.z();
  }

  void cull(const DeflectorMotion& motion, const CullBatch& batch) const override {
    const Vector3 n0 = motion.rotation(0).col(2), n1 = motion.rotation(1).col(2);
    const double d0 = n0.dot(motion.origin(0)), d1 = n1.dot(motion.origin(1));
    const double ax = n0.x(), ay = n0.y(), az = n0.z(), bx = n1.x(), by = n1.y(), bz = n1.z();
    const double *x0 = batch.x0.data(), *y0 = batch.y0.data(), *z0 = batch.z0.data();
    const double *x1 = batch.x1.data(), *y1 = batch.y1.data(), *z1 = batch.z1.data();
    const double* margin = batch.margin.data();
    double* gap = batch.gap.data();
    for (std::size_t i = 0, n = batch.gap.size(); i < n; ++i) {
      const double from = ax * x0[i] + ay * y0[i] + az * z0[i] - d0;
      const double to = bx * x1[i] + by * y1[i] + bz * z1[i] - d1;
      const double here = (from < to ? from : to) - margin[i];
      gap[i] = here < gap[i] ? here : gap[i];
    }
    if (!motion.stands()) bend(motion, batch);
  }

 private:
  /// Between the ends the distance is no straight line: it deviates by an eighth of the greatest second
  /// derivative, |r''| + 2 theta |r'| + theta^2 |r| with r from the centre of rotation.
  static void bend(const DeflectorMotion& motion, const CullBatch& batch) {
    const Vector3 c0 = motion.centre(0), c1 = motion.centre(1), n0 = motion.rotation(0).col(2),
                  n1 = motion.rotation(1).col(2);
    const double angle = motion.angle(), curved = motion.centre_curvature().norm() / 8;
    for (std::size_t i = 0; i < batch.gap.size(); ++i) {
      const Vector3 p0{batch.x0[i], batch.y0[i], batch.z0[i]}, p1{batch.x1[i], batch.y1[i], batch.z1[i]};
      const Vector3 r0 = p0 - c0, r1 = p1 - c1;
      const double bulge = batch.margin[i] + curved;
      const double shift = (r1 - r0).norm() + 8 * bulge, far = std::max(r0.norm(), r1.norm()) + bulge;
      const double deviation = bulge + angle * (2 * shift + angle * far) / 8;
      const double from = n0.dot(p0 - motion.origin(0)), to = n1.dot(p1 - motion.origin(1));
      batch.gap[i] = std::min(batch.gap[i], std::min(from, to) - deviation);
    }
  }
};

}  // namespace

std::optional<SettingsProblem> problem_with(const PlaneDeflector& settings) {
  return first_problem(
      {problem_with(settings.on, "plane deflector"), problem_with(settings.surface, "plane deflector")});
}

std::unique_ptr<DeflectorShape> make_shape(const PlaneDeflector&) { return std::make_unique<PlaneSolid>(); }

}  // namespace pantin
