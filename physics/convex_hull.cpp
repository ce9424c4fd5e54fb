#include <pantin/physics/convex_hull.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <pantin/physics/expects.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

constexpr double kInside = 1e-12;  // of the extent
constexpr double kFlat = 1e-9;     // of the extent

using Corners = std::array<std::uint32_t, 4>;

struct Start {
  Corners corners{};
  double extent{0};
  bool flat{true};
};

/// The point of greatest measure.
template <class Measure>
std::pair<std::uint32_t, double> farthest(std::span<const Vector3> points, Measure measure) {
  std::pair<std::uint32_t, double> best{0, -1};
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const double m = measure(points[i]);
    if (m > best.second) best = {i, m};
  }
  return best;
}

/// A large tetrahedron of the points: far ends of a diameter, farthest from that line, farthest from that
/// plane.
Start start_of(std::span<const Vector3> points) {
  Start start;
  if (points.size() < 4) return start;
  const auto [a, unused] = farthest(points, [&](const Vector3& p) { return (p - points[0]).norm(); });
  const Vector3 A = points[a];
  const auto [b, length] = farthest(points, [&](const Vector3& p) { return (p - A).norm(); });
  start.extent = length;
  if (!(length > 0)) return start;
  const Vector3 along = (points[b] - A) / length;
  const auto [c, width] = farthest(points, [&](const Vector3& p) { return along.cross(p - A).norm(); });
  if (!(width > kFlat * length)) return start;
  const Vector3 normal = along.cross(points[c] - A).normalized();
  const auto [d, height] = farthest(points, [&](const Vector3& p) { return std::abs(normal.dot(p - A)); });
  if (!(height > kFlat * length)) return start;
  start.flat = false;
  start.corners = {a, b, c, d};
  if (normal.dot(points[d] - A) > 0) std::swap(start.corners[1], start.corners[2]);
  return start;
}

struct Face {
  std::array<std::uint32_t, 3> corner{};
  std::array<std::uint32_t, 3> across{};  ///< the face beyond the edge from corner k to corner k + 1
  Vector3 normal{Vector3::Zero()};
  double offset{0};
  std::vector<std::uint32_t> outside{};  ///< points above it, each with one face only
  bool alive{true}, visible{false};
};

class Quickhull {
 public:
  Quickhull(std::span<const Vector3> points, const Start& start)
      : points_{points}, tolerance_{kInside * start.extent}, new_face_from_(points.size(), 0) {
    const auto [a, b, c, d] = start.corners;  // d is below the plane of a, b, c
    add({a, b, c}), add({a, d, b}), add({b, d, c}), add({c, d, a});
    faces_[0].across = {1, 2, 3};
    faces_[1].across = {3, 2, 0};
    faces_[2].across = {1, 3, 0};
    faces_[3].across = {2, 1, 0};
    std::vector<std::uint32_t> all(points.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    hand_out(all, 0);
  }

  TriangleMesh run() && {
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (faces_[f].alive && !faces_[f].outside.empty()) take_in(static_cast<std::uint32_t>(f));
    }
    return mesh();
  }

 private:
  void add(const std::array<std::uint32_t, 3>& corner) {
    Face face;
    face.corner = corner;
    const Vector3 &p = points_[corner[0]], &q = points_[corner[1]], &r = points_[corner[2]];
    face.normal = (q - p).cross(r - p).normalized();
    face.offset = face.normal.dot(p);
    faces_.push_back(std::move(face));
  }

  [[nodiscard]] double height(const Face& face, std::uint32_t point) const {
    return face.normal.dot(points_[point]) - face.offset;
  }

  /// Gives each point to the first of the new faces that it is above; points above none are inside.
  void hand_out(const std::vector<std::uint32_t>& points, std::size_t first_face) {
    for (const std::uint32_t point : points) {
      for (std::size_t f = first_face; f < faces_.size(); ++f) {
        if (height(faces_[f], point) <= tolerance_) continue;
        faces_[f].outside.push_back(point);
        break;
      }
    }
  }

  /// Replaces what the farthest point above this face sees by a cone to it.
  void take_in(std::uint32_t f) {
    const std::vector<std::uint32_t>& outside = faces_[f].outside;
    const std::uint32_t apex = *std::max_element(outside.begin(), outside.end(), [&](auto i, auto j) {
      return height(faces_[f], i) < height(faces_[f], j);
    });
    find_horizon(f, apex);
    std::vector<std::uint32_t> homeless;
    for (const std::uint32_t seen : visible_) {
      Face& face = faces_[seen];
      face.alive = false;
      for (const std::uint32_t point : face.outside)
        if (point != apex) homeless.push_back(point);
      face.outside = {};
    }
    const std::size_t first_new = faces_.size();
    for (const auto& [from, to, beyond] : horizon_) {
      const auto index = static_cast<std::uint32_t>(faces_.size());
      add({from, to, apex});
      faces_.back().across[0] = beyond;
      Face& other = faces_[beyond];
      for (std::size_t k = 0; k < 3; ++k)
        if (other.corner[k] == to && other.corner[(k + 1) % 3] == from) other.across[k] = index;
      new_face_from_[from] = index;
    }
    for (std::size_t n = first_new; n < faces_.size();
         ++n) {  // the horizon is a loop: next face begins at `to`
      const std::uint32_t next = new_face_from_[faces_[n].corner[1]];
      faces_[n].across[1] = next;
      faces_[next].across[2] = static_cast<std::uint32_t>(n);
    }
    hand_out(homeless, first_new);
  }

  struct Edge {
    std::uint32_t from{0}, to{0}, beyond{0};
  };

  void find_horizon(std::uint32_t start, std::uint32_t apex) {
    visible_.assign(1, start);
    horizon_.clear();
    faces_[start].visible = true;
    for (std::size_t i = 0; i < visible_.size(); ++i) {
      for (const std::uint32_t next : faces_[visible_[i]].across) {
        Face& face = faces_[next];
        if (face.visible || height(face, apex) <= tolerance_) continue;
        face.visible = true;
        visible_.push_back(next);
      }
    }
    for (const std::uint32_t f : visible_) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Face& face = faces_[f];
        if (!faces_[face.across[k]].visible)
          horizon_.push_back({face.corner[k], face.corner[(k + 1) % 3], face.across[k]});
      }
    }
  }

  [[nodiscard]] TriangleMesh mesh() const {
    TriangleMesh out;
    std::vector<std::uint32_t> number(points_.size(), std::numeric_limits<std::uint32_t>::max());
    for (const Face& face : faces_)
      if (face.alive)
        for (const std::uint32_t corner : face.corner) number[corner] = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (number[i] != 0) continue;
      number[i] = static_cast<std::uint32_t>(out.vertices.size());
      out.vertices.push_back(points_[i]);
    }
    for (const Face& face : faces_)
      if (face.alive)
        out.triangles.push_back({number[face.corner[0]], number[face.corner[1]], number[face.corner[2]]});
    return out;
  }

  std::span<const Vector3> points_;
  double tolerance_;
  std::vector<Face> faces_{};
  std::vector<std::uint32_t> visible_{};
  std::vector<Edge> horizon_{};
  std::vector<std::uint32_t> new_face_from_;  ///< by point: the newest face whose base edge begins there
};

}  // namespace

std::optional<SettingsProblem> hull_problem(std::span<const Vector3> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) continue;
    return SettingsProblem{
        ProblemCode::NotFinite,
        "convex hull: point " + std::to_string(i) + " is " + text_of(points[i]) + "; it must be finite",
        "give finite points"};
  }
  if (!start_of(points).flat) return std::nullopt;
  return SettingsProblem{ProblemCode::NotClosed,
                         "convex hull: the " + std::to_string(points.size()) +
                             " point(s) lie in one plane, so that their hull encloses no volume",
                         "give four points or more that do not lie in one plane"};
}

TriangleMesh convex_hull(std::span<const Vector3> points) {
  const std::optional<SettingsProblem> problem = hull_problem(points);
  PANTIN_EXPECTS(!problem, problem->text + "; " + problem->remedy);
  return Quickhull{points, start_of(points)}.run();
}

double bulge_of(const TriangleMesh& mesh) {
  double bulge = 0;
  for (const std::array<std::uint32_t, 3>& corner : mesh.triangles) {
    const Vector3& p = mesh.vertices[corner[0]];
    const Vector3 normal =
        (mesh.vertices[corner[1]] - p).cross(mesh.vertices[corner[2]] - p).stableNormalized();
    for (const Vector3& vertex : mesh.vertices) bulge = std::max(bulge, normal.dot(vertex - p));
  }
  return bulge;
}

}  // namespace pantin
