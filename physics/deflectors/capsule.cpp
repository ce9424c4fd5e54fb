#include <pantin/physics/deflectors/capsule.hpp>

#include <cmath>
#include <limits>

#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

class CapsuleSolid final : public SolidShape {
 public:
  CapsuleSolid(double radius, double length) : radius_{radius}, half_{0.5 * length} {}
  std::string_view kind() const override { return "capsule"; }
  double bounding_radius() const override { return radius_ + half_; }
  double distance(const Vector3& p_D, Vector3& normal_D) const override {
    const double z = p_D.z() < -half_ ? -half_ : (p_D.z() > half_ ? half_ : p_D.z());
    const Vector3 from_axis = p_D - Vector3{0, 0, z};
    const double r = from_axis.norm();
    normal_D = r > 0 ? Vector3{from_axis / r} : Vector3{Vector3::UnitX()};
    return r - radius_;
  }

 private:
  double radius_, half_;
};

}  // namespace

std::optional<SettingsProblem> problem_with(const CapsuleDeflector& settings) {
  return first_problem({problem_with(settings.on, "capsule deflector"),
                        problem_with(settings.surface, "capsule deflector"),
                        must_be_positive({"capsule deflector", "radius", "m"}, settings.radius),
                        must_not_be_negative({"capsule deflector", "length", "m"}, settings.length)});
}

std::unique_ptr<DeflectorShape> make_shape(const CapsuleDeflector& settings) {
  return std::make_unique<CapsuleSolid>(settings.radius, settings.length);
}

}  // namespace pantin
