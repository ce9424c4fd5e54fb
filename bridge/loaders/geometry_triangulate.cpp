// Ear clipping (Meisters 1975, "Polygons have ears", Amer. Math. Monthly 82): a corner is an ear if it is
// convex and no other corner lies in its triangle; a simple polygon has two at least.
#include <cmath>

#include <pantin/bridge/loaders/geometry_file.hpp>

namespace pantin::geometry_loader {
namespace {

using Plane = Eigen::Vector2d;

/// Twice the signed area of a, b, c.
double turn(const Plane& a, const Plane& b, const Plane& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Corners in the coordinate plane that is most nearly parallel to the polygon, counter-clockwise.
std::vector<Plane> flattened(std::span<const std::uint32_t> corners, std::span<const Vector3> vertices) {
  Vector3 normal = Vector3::Zero();  // Newell
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    normal += (vertices[corners[i]] - vertices[corners[0]])
                  .cross(vertices[corners[(i + 1) % n]] - vertices[corners[0]]);
  }
  Eigen::Index drop = 0;
  normal.cwiseAbs().maxCoeff(&drop);
  const bool turned = normal[drop] < 0;
  std::vector<Plane> flat;
  for (const std::uint32_t corner : corners) {
    const Vector3& p = vertices[corner];
    const double x = p[(drop + 1) % 3];
    const double y = p[(drop + 2) % 3];
    flat.emplace_back(turned ? y : x, turned ? x : y);
  }
  return flat;
}

/// Whether the corner at `k` of the corners that are left is an ear.
bool is_ear(const std::vector<std::size_t>& left, std::size_t k, const std::vector<Plane>& flat) {
  const std::size_t n = left.size();
  const Plane& a = flat[left[(k + n - 1) % n]];
  const Plane& b = flat[left[k]];
  const Plane& c = flat[left[(k + 1) % n]];
  if (!(turn(a, b, c) > 0)) return false;
  for (std::size_t i = 0; i < n; ++i) {
    const Plane& p = flat[left[i]];
    if (p == a || p == b || p == c) continue;  // also a corner that stands at the place of one of these
    if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
  }
  return true;
}

}  // namespace

void triangulate(std::span<const std::uint32_t> corners, std::span<const Vector3> vertices,
                 std::vector<std::array<std::uint32_t, 3>>& out) {
  std::vector<std::size_t> left(corners.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  const std::vector<Plane> flat = corners.size() > 3 ? flattened(corners, vertices) : std::vector<Plane>{};
  std::size_t k = 1;  // the first corner stays the common one of a convex polygon, as everybody cuts it
  std::size_t tried = 0;
  while (left.size() > 3) {
    const std::size_t n = left.size();
    k %= n;
    if (tried < n && !is_ear(left, k, flat)) {
      ++k;
      ++tried;
      continue;
    }
    // Where none is an ear the polygon crosses itself or has no area: the corner goes all the same.
    out.push_back({corners[left[(k + n - 1) % n]], corners[left[k]], corners[left[(k + 1) % n]]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
    tried = tried < n ? 0 : tried;
  }
  if (left.size() == 3) out.push_back({corners[left[0]], corners[left[1]], corners[left[2]]});
}

}  // namespace pantin::geometry_loader
