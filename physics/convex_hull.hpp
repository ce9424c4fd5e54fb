#pragma once
// The convex hull of points as a closed triangle mesh.
#include <optional>
#include <span>

#include <pantin/physics/problem.hpp>
#include <pantin/physics/shape.hpp>

namespace pantin {

/// Why points have no hull with a volume: fewer than four, one that is not finite, all in one plane (thinner
/// than 1e-9 of their extent).
[[nodiscard]] std::optional<SettingsProblem> hull_problem(std::span<const Vector3> points);

/// The triangles around the points, counter-clockwise seen from outside, over the points on the hull only, in
/// the order given. Points within 1e-12 of the extent of the hull found so far count as inside it, so that of
/// points in one face only its corners (and few others) stay. The points must have no problem. Quickhull: C.
/// B. Barber, D. P. Dobkin, H. Huhdanpaa, ACM Trans. Math. Software 22, 469 (1996).
[[nodiscard]] TriangleMesh convex_hull(std::span<const Vector3> points);

/// The greatest distance [m] by which a vertex of the mesh lies outside the plane of one of its triangles: 0
/// or round-off where the mesh is convex.
[[nodiscard]] double bulge_of(const TriangleMesh& mesh);

}  // namespace pantin
