#include <pantin/physics/deflectors/box.hpp>

#include <cmath>
#include <limits>

#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

class BoxSolid final : public SolidShape {
 public:
  explicit BoxSolid(const Vector3& size) : half_{0.5 * size} {}
  std::string_view kind() const override { return "box"; }
  double bounding_radius() const override { return half_.norm(); }
  double distance(const Vector3& p_D, Vector3& normal_D) const override {
    const Vector3 over = p_D.cwiseAbs() - half_;
    Eigen::Index axis = 0;
    const double most = over.maxCoeff(&axis);
    if (most <= 0) {  // inside: the nearest face
      normal_D = Vector3::Zero();
      normal_D[axis] = p_D[axis] < 0 ? -1 : 1;
      return most;
    }
    Vector3 out = over.cwiseMax(0);
    const double d = out.norm();
    for (int k = 0; k < 3; ++k) out[k] = p_D[k] < 0 ? -out[k] : out[k];
    normal_D = out / d;
    return d;
  }

 private:
  Vector3 half_;
};

}  // namespace

std::optional<SettingsProblem> problem_with(const BoxDeflector& settings) {
  return first_problem({problem_with(settings.on, "box deflector"),
                        problem_with(settings.surface, "box deflector"),
                        must_be_positive({"box deflector", "size along x", "m"}, settings.size.x()),
                        must_be_positive({"box deflector", "size along y", "m"}, settings.size.y()),
                        must_be_positive({"box deflector", "size along z", "m"}, settings.size.z())});
}

std::unique_ptr<DeflectorShape> make_shape(const BoxDeflector& settings) {
  return std::make_unique<BoxSolid>(settings.size);
}

}  // namespace pantin
