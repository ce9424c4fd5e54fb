#include <pantin/physics/deflectors/mesh.hpp>

#include <algorithm>
#include <cmath>

#include <pantin/physics/deflectors/ball_triangle.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

constexpr double kBend = 1e-3;  // of radius and size: what a straight piece of a path may leave out
constexpr int kMostPieces = 256;
constexpr double kSkin = 1e-9;  // of the size: how far off the surface what met it is put

class MeshSurface final : public DeflectorShape {
 public:
  explicit MeshSurface(const MeshDeflector& settings) : triangles_{settings.triangles} {
    for (const Vector3& v : triangles_->mesh().vertices) radius_ = std::max(radius_, v.norm());
  }

  std::string_view kind() const override { return "mesh"; }
  double bounding_radius() const override { return radius_; }

  std::optional<SurfaceContact> first_contact(const RelativePath& path, double from, double radius,
                                              TriangleList& near) const override {
    const double bend = path.greatest_curvature() / 8, allowed = kBend * std::max(radius, kBend * radius_);
    const double wanted = std::sqrt(bend / allowed);
    if (!(from <= 1) || !std::isfinite(wanted)) return std::nullopt;
    const int pieces = std::clamp(static_cast<int>(std::min(wanted, 1.0 * kMostPieces)) + 1, 1, kMostPieces);
    Vector3 a = path.at(from);
    for (int k = 0; k < pieces; ++k) {
      const double s0 = from + (1 - from) * k / pieces, s1 = from + (1 - from) * (k + 1) / pieces;
      const Vector3 b = path.at(s1);
      if (const std::optional<BallContact> touch = first_in({a, b - a, radius}, near)) {
        return SurfaceContact{s0 + touch->t * (s1 - s0), touch->normal, touch->depth + kSkin * radius_};
      }
      a = b;
    }
    return std::nullopt;
  }

 private:
  std::optional<BallContact> first_in(const BallWayInD& ball, TriangleList& near) const {
    const Vector3 to = ball.from + ball.way, room = Vector3::Constant(ball.radius + kSkin * radius_);
    near.clear();
    triangles_->find(ball.from.cwiseMin(to) - room, ball.from.cwiseMax(to) + room, near);
    std::optional<BallContact> best;
    const TriangleMesh& mesh = triangles_->mesh();
    for (const std::uint32_t k : near) {
      const std::array<std::uint32_t, 3>& t = mesh.triangles[k];
      const std::optional<BallContact> touch =
          first_touch(ball, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
      if (touch && (!best || touch->t < best->t)) best = touch;
    }
    return best;
  }

  std::shared_ptr<const TriangleIndex> triangles_;
  double radius_{0};
};

}  // namespace

std::optional<SettingsProblem> problem_with(const MeshDeflector& settings) {
  if (!settings.triangles) {
    return SettingsProblem{ProblemCode::OutOfRange, "mesh deflector: there is no index of its triangles",
                           "link component collision_fcl (PANTIN_COLLISION_FCL) and give "
                           "make_fcl_triangle_index(mesh), or use a plane, sphere, box or capsule"};
  }
  return first_problem(
      {problem_with(settings.on, "mesh deflector"), problem_with(settings.surface, "mesh deflector")});
}

std::unique_ptr<DeflectorShape> make_shape(const MeshDeflector& settings) {
  return std::make_unique<MeshSurface>(settings);
}

}  // namespace pantin
