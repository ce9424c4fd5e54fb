#include <pantin/physics/deflectors/sphere.hpp>

#include <cmath>
#include <limits>

#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

class SphereSolid final : public SolidShape {
 public:
  explicit SphereSolid(double radius) : radius_{radius} {}
  std::string_view kind() const override { return "sphere"; }
  double bounding_radius() const override { return radius_; }
  double distance(const Vector3& p_D, Vector3& normal_D) const override {
    const double r = p_D.norm();
    normal_D = r > 0 ? Vector3{p_D / r} : Vector3{Vector3::UnitZ()};
    return r - radius_;
  }

 private:
  double radius_;
};

}  // namespace

std::optional<SettingsProblem> problem_with(const SphereDeflector& settings) {
  return first_problem({problem_with(settings.on, "sphere deflector"),
                        problem_with(settings.surface, "sphere deflector"),
                        must_be_positive({"sphere deflector", "radius", "m"}, settings.radius)});
}

std::unique_ptr<DeflectorShape> make_shape(const SphereDeflector& settings) {
  return std::make_unique<SphereSolid>(settings.radius);
}

}  // namespace pantin
