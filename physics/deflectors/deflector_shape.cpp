#include <pantin/physics/deflectors/deflector_shape.hpp>

#include <algorithm>
#include <cmath>

namespace pantin {

namespace {

/// What lies on a surface is a rounding inside of it: only more than this counts, of the distance from D's
/// origin.
constexpr double kDeep = 1e-9;

/// Ball at the origin, both chords straight: squared distance of closest approach against the sum of radii.
struct BallWay {
  double cx{0}, cy{0}, cz{0};  ///< centre at the begin
  double mx{0}, my{0}, mz{0};  ///< its way
  double reach{0};
};

void cull_standing_ball(const BallWay& ball, const CullBatch& batch) {
  const double *x0 = batch.x0.data(), *y0 = batch.y0.data(), *z0 = batch.z0.data();
  const double *x1 = batch.x1.data(), *y1 = batch.y1.data(), *z1 = batch.z1.data();
  const double *inverse = batch.inverse_length2.data(), *margin = batch.margin.data();
  double *nearest = batch.scratch.data(), *gap = batch.gap.data();
  const std::size_t n = batch.gap.size();
  // Two loops without branches: compilers make vector instructions of each.
  for (std::size_t i = 0; i < n; ++i) {
    const double wx = ball.cx - x0[i], wy = ball.cy - y0[i], wz = ball.cz - z0[i];
    const double dx = x1[i] - x0[i], dy = y1[i] - y0[i], dz = z1[i] - z0[i];
    const double t = (wx * dx + wy * dy + wz * dz) * inverse[i];
    nearest[i] = t > 0 ? t : 0;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double t = nearest[i] < 1 ? nearest[i] : 1;
    const double ex = ball.cx - x0[i] - t * (x1[i] - x0[i]), ey = ball.cy - y0[i] - t * (y1[i] - y0[i]),
                 ez = ball.cz - z0[i] - t * (z1[i] - z0[i]), reach = ball.reach + margin[i];
    const double here = ex * ex + ey * ey + ez * ez - reach * reach;
    gap[i] = here < gap[i] ? here : gap[i];
  }
}

void cull_moving_ball(const BallWay& ball, const CullBatch& batch) {
  for (std::size_t i = 0, n = batch.gap.size(); i < n; ++i) {
    const double wx = ball.cx - batch.x0[i], wy = ball.cy - batch.y0[i], wz = ball.cz - batch.z0[i];
    const double dx = batch.x1[i] - batch.x0[i] - ball.mx, dy = batch.y1[i] - batch.y0[i] - ball.my,
                 dz = batch.z1[i] - batch.z0[i] - ball.mz;
    const double length2 = dx * dx + dy * dy + dz * dz;
    const double t = length2 > 0 ? std::clamp((wx * dx + wy * dy + wz * dz) / length2, 0.0, 1.0) : 0;
    const double ex = wx - t * dx, ey = wy - t * dy, ez = wz - t * dz, reach = ball.reach + batch.margin[i];
    batch.gap[i] = std::min(batch.gap[i], ex * ex + ey * ey + ez * ez - reach * reach);
  }
}

}  // namespace

void DeflectorShape::cull(const DeflectorMotion& motion, const CullBatch& batch) const {
  const Vector3 c = motion.origin(0);
  if (motion.stands()) {
    cull_standing_ball({c.x(), c.y(), c.z(), 0, 0, 0, bounding_radius()}, batch);
    return;
  }
  const Vector3 m = motion.origin(1) - c;
  cull_moving_ball({c.x(), c.y(), c.z(), m.x(), m.y(), m.z(), bounding_radius() + motion.sagitta()}, batch);
}

// The distance d of a convex solid is a convex function of the place, so along a path whose rate of d is d'
// and whose curvature in D is at most K, d(s + u) >= d + d' u - K u^2 / 2. The root of the right side is a
// step that cannot pass the surface, and near it the steps are Newton's, which come from one side and
// converge quadratically.
std::optional<SurfaceContact> SolidShape::first_contact(const RelativePath& path, double from, double radius,
                                                        TriangleList&) const {
  constexpr double kTouch = 1e-13;     // of the way that is left at this speed
  constexpr double kLeastStep = 1e-6;  // of the update, along the surface
  constexpr int kMostSteps = 200;
  const double bend = path.greatest_curvature(), touch = kTouch * (path.greatest_speed() + radius);
  if (!(from <= 1) || !std::isfinite(bend) || !std::isfinite(touch)) return std::nullopt;
  Vector3 normal;
  double s = from;
  for (int k = 0;; ++k) {
    const double d = distance(path.at(s), normal) - radius;
    const double rate = normal.dot(path.rate(s));
    // What is inside is put out, however it moves; what comes in later can only come in through the surface.
    if (d <= touch && (rate < 0 || (s == from && d < -kDeep * (path.at(s).norm() + radius)))) {
      return SurfaceContact{s, normal, std::max(0.0, -d)};
    }
    const double above = std::max(d, 0.0), root = std::sqrt(rate * rate + 2 * bend * above);
    // Two forms of one root, each without cancellation.
    double step = rate < 0 ? 2 * above / (root - rate) : (bend > 0 ? (rate + root) / bend : 2);
    if (d <= touch || k > kMostSteps) step = std::max(step, kLeastStep);
    if (!(s + step <= 1)) return std::nullopt;
    s += step;
  }
}

}  // namespace pantin
