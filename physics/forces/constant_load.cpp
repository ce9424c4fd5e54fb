#include <pantin/physics/forces/constant_load.hpp>

#include <pantin/physics/forces/wrench_derivatives.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

class ConstantLoadLaw final : public ForceLaw {
 public:
  explicit ConstantLoadLaw(const ConstantLoad& settings) : settings_{settings} {}

  void add_wrenches(const BodiesAt& at, std::span<Wrench> wrenches) const override {
    const std::size_t i = at.index(settings_.body);
    const Vector3 p_WQ = point_at(at, {settings_.body, settings_.p_BQ}).p_WQ;
    if (settings_.axes == LoadAxes::World) {
      add_force_at(at, i, p_WQ, settings_.force, wrenches);
      wrenches[i].torque += settings_.torque;
    } else {
      const Matrix3& R_WB = at.kinematics[i].R_WB;
      add_force_at(at, i, p_WQ, R_WB * settings_.force, wrenches);
      wrenches[i].torque += R_WB * settings_.torque;
    }
  }

  /// A force of constant direction has a potential; one that turns with the body and any torque have none.
  double potential_energy(const BodiesAt& at) const override {
    if (settings_.axes != LoadAxes::World) return 0;
    if (at.kind[at.index(settings_.body)] != BodyKind::Simulated) return 0;
    return -settings_.force.dot(point_at(at, {settings_.body, settings_.p_BQ}).p_WQ);
  }

  /// The arm turns with the body; in its axes the load does.
  bool add_derivatives(const BodiesAt& at, WrenchDerivatives& derivatives) const override {
    const std::size_t i = at.index(settings_.body);
    const Matrix3& R_WB = at.kinematics[i].R_WB;
    const Vector3 arm = R_WB * (settings_.p_BQ - at.mass[i].p_BBcm);
    WrenchDerivative& part = derivatives.add(i, i);
    if (settings_.axes == LoadAxes::World) {
      part.torque.turn = cross_matrix(settings_.force) * cross_matrix(arm);
    } else {
      const Vector3 force = R_WB * settings_.force;
      part.force.turn = -cross_matrix(force);
      part.torque.turn = -cross_matrix(arm.cross(force) + R_WB * settings_.torque);
    }
    return true;
  }

  bool names(BodyId body) const override { return body && body == settings_.body; }
  Coupling coupling() const override { return {.reach = Coupling::Reach::Named, .bodies = {settings_.body}}; }

 private:
  ConstantLoad settings_;
};

}  // namespace

std::optional<SettingsProblem> problem_with(const ConstantLoad& settings) {
  if (!settings.body) {
    return SettingsProblem{ProblemCode::UnknownEntity, "constant load: body is null",
                           "give the body that the load acts on"};
  }
  return first_problem({must_be_finite({"constant load", "force", "N"}, settings.force),
                        must_be_finite({"constant load", "torque", "N m"}, settings.torque),
                        must_be_finite({"constant load", "point", "m"}, settings.p_BQ)});
}

std::unique_ptr<ForceLaw> make_law(const ConstantLoad& settings) {
  return std::make_unique<ConstantLoadLaw>(settings);
}

}  // namespace pantin
