// The ball touches the face where its centre crosses the plane moved by the radius towards it, over the
// triangle; else the first of the edges and corners, thickened by the radius, that its centre enters.
#include <pantin/physics/deflectors/ball_triangle.hpp>

#include <algorithm>
#include <cmath>

namespace pantin {
namespace {

/// How far outside of an edge a point of the plane may lie and still count as on the face, so that nothing
/// slips between two triangles [of the area].
constexpr double kEdgeSlack = 1e-10;

bool is_over(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& area2) {
  const double least = -kEdgeSlack * area2.squaredNorm();
  return (b - a).cross(p - a).dot(area2) >= least && (c - b).cross(p - b).dot(area2) >= least &&
         (a - c).cross(p - c).dot(area2) >= least;
}

void keep_first(std::optional<BallContact>& best, const BallContact& contact) {
  if (!best || contact.t < best->t) best = contact;
}

/// Enters the set of points whose distance from `nearest(t)` is the radius; w from there to the centre, u its
/// rate.
void meet_round(std::optional<BallContact>& best, const BallWayInD& ball, const Vector3& w, const Vector3& u,
                const Vector3& origin, const Vector3& edge) {
  const double a = u.squaredNorm(), b = w.dot(u), c = w.squaredNorm() - ball.radius * ball.radius;
  if (b >= 0 || a == 0) return;
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return;
  const double t = c <= 0 ? 0 : c / (-b + std::sqrt(discriminant));
  if (t > 1) return;
  const double length2 = edge.squaredNorm();
  if (length2 > 0) {
    const double along = (ball.from + t * ball.way - origin).dot(edge) / length2;
    if (along < 0 || along > 1) return;
  }
  const Vector3 out = w + t * u;
  const double distance = out.norm();
  if (distance == 0) return;
  keep_first(best, {t, out / distance, c < 0 ? ball.radius - distance : 0});
}

}  // namespace

std::optional<BallContact> first_touch(const BallWayInD& ball, const Vector3& a, const Vector3& b,
                                       const Vector3& c) {
  const Vector3 area2 = (b - a).cross(c - a);
  const double size = area2.norm();
  if (!(size > 0)) return std::nullopt;
  const Vector3 up = area2 / size;
  const double height = up.dot(ball.from - a);
  const double side = height < 0 ? -1 : 1;
  const double approach = -side * up.dot(ball.way);
  const double above = std::abs(height) - ball.radius;
  std::optional<BallContact> best;
  if (approach > 0 && above <= approach) {
    const double t = std::max(0.0, above / approach);
    if (is_over(ball.from + t * ball.way, a, b, c, area2))
      return BallContact{t, side * up, std::max(0.0, -above)};
  }
  if (ball.radius == 0 || above > std::max(approach, 0.0)) return std::nullopt;
  const Vector3 corners[3]{a, b, c};
  for (int k = 0; k < 3; ++k) {
    const Vector3 &p = corners[k], &q = corners[(k + 1) % 3];
    const Vector3 edge = q - p, axis = edge.normalized(), w = ball.from - p;
    const Vector3 across = w - axis.dot(w) * axis;
    const Vector3 rate = ball.way - axis.dot(ball.way) * axis;
    meet_round(best, ball, across, rate, p, edge);
    meet_round(best, ball, w, ball.way, p, Vector3::Zero());
  }
  return best;
}

}  // namespace pantin
