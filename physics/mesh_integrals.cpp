// The solid is the signed sum of the tetrahedra (o, a, b, c) over all triangles (a, b, c), for any point o.
// With o as origin, d = a . (b x c) and s = a + b + c, one tetrahedron has
//   volume                  d / 6
//   first moment            d / 24 * s
//   integral of x x^T       d / 120 * (a a^T + b b^T + c c^T + s s^T)
// These are polynomial integrals over a simplex, hence exact: B. Mirtich, "Fast and accurate computation of
// polyhedral mass properties", J. Graphics Tools 1(2), 1996; D. Eberly, "Polyhedral mass properties
// (revisited)", 2002; in the form above J. Blow and A. Binstock, "How to find the inertia tensor of a 3D
// solid body", 2004. A point o far from the mesh would make large terms that cancel. So o is the centre of
// the bounding box for volume and first moment, and the centroid found from them for the second moments.
#include <pantin/physics/mesh_integrals.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pantin {
namespace {

Vector3 centre_of_bounds(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return Vector3::Zero();
  Vector3 low = mesh.vertices.front();
  Vector3 high = low;
  for (const Vector3& p : mesh.vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return low + 0.5 * (high - low);
}

/// Calls visit(a, b, c) for each triangle, seen from `origin` and scaled.
template <class Visit>
void for_each_triangle(const TriangleMesh& mesh, const Vector3& origin, const Vector3& scale, Visit visit) {
  for (const std::array<std::uint32_t, 3>& corner : mesh.triangles) {
    const Vector3 a = (mesh.vertices[corner[0]] - origin).cwiseProduct(scale);
    const Vector3 b = (mesh.vertices[corner[1]] - origin).cwiseProduct(scale);
    const Vector3 c = (mesh.vertices[corner[2]] - origin).cwiseProduct(scale);
    visit(a, b, c);
  }
}

/// The products of a . (b x c) added without their signs: what rounding errors are relative to.
double size_of_terms(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 u = a.cwiseAbs(), v = b.cwiseAbs(), w = c.cwiseAbs();
  return u.x() * (v.y() * w.z() + v.z() * w.y()) + u.y() * (v.z() * w.x() + v.x() * w.z()) +
         u.z() * (v.x() * w.y() + v.y() * w.x());
}

}  // namespace

MeshIntegrals integrals_of(const TriangleMesh& mesh, const Vector3& scale) {
  const bool mirrored = std::signbit(scale.x()) ^ std::signbit(scale.y()) ^ std::signbit(scale.z());
  const double sense = mirrored ? -1 : 1;
  const Vector3 centre = centre_of_bounds(mesh);

  double six_volumes = 0;
  double terms = 0;
  Vector3 first_moments = Vector3::Zero();  // times 24
  for_each_triangle(mesh, centre, scale, [&](const Vector3& a, const Vector3& b, const Vector3& c) {
    const double d = a.dot(b.cross(c));
    six_volumes += d;
    terms += size_of_terms(a, b, c);
    first_moments += d * (a + b + c);
  });

  MeshIntegrals result;
  result.volume = sense * six_volumes / 6;
  result.volume_round_off = 8 * std::numeric_limits<double>::epsilon() * terms / 6;
  result.centroid = centre.cwiseProduct(scale);
  if (std::abs(result.volume) <= result.volume_round_off) return result;
  const Vector3 from_centre = first_moments / (4 * six_volumes);
  result.centroid += from_centre;

  Matrix3 moments = Matrix3::Zero();  // times 120
  const Vector3 origin = centre + from_centre.cwiseQuotient(scale);
  for_each_triangle(mesh, origin, scale, [&](const Vector3& a, const Vector3& b, const Vector3& c) {
    const double d = a.dot(b.cross(c));
    const Vector3 s = a + b + c;
    moments += d * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
  });
  result.second_moments = sense / 120 * moments;
  return result;
}

}  // namespace pantin
