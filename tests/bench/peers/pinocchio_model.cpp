#include "pinocchio_model.hpp"

#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/multibody.hpp>
#include <pinocchio/spatial.hpp>

namespace pantin::bench {
namespace {

using Numbers = Eigen::Ref<const Eigen::VectorXd>;

pinocchio::Model model_of(const Chain& chain) {
  pinocchio::Model model;
  pinocchio::JointIndex up = 0;
  for (int i = 0; i < chain.links; ++i) {
    pinocchio::SE3 from_above = pinocchio::SE3::Identity();
    if (i > 0) from_above.translation() << 0, 0, -kRodLength;
    const std::string name = "joint " + std::to_string(i);
    up = turns_about_x(i) ? model.addJoint(up, pinocchio::JointModelRX(), from_above, name)
                          : model.addJoint(up, pinocchio::JointModelRY(), from_above, name);
    const double mass = rod_mass(chain, i), across = inertia_across(mass);
    const Eigen::Matrix3d inertia = Eigen::Vector3d{across, across, inertia_along(mass)}.asDiagonal();
    model.appendBodyToJoint(up, pinocchio::Inertia{mass, Eigen::Vector3d{0, 0, -kRodLength / 2}, inertia},
                            pinocchio::SE3::Identity());
  }
  model.gravity.linear(Eigen::Vector3d{0, 0, -kGravity});
  return model;
}

pinocchio::Model model_of(const Top& top) {
  pinocchio::Model model;
  const pinocchio::JointIndex joint =
      model.addJoint(0, pinocchio::JointModelFreeFlyer(), pinocchio::SE3::Identity(), "free");
  const Eigen::Matrix3d inertia =
      Eigen::Vector3d{top.inertia[0], top.inertia[1], top.inertia[2]}.asDiagonal();
  model.appendBodyToJoint(joint, pinocchio::Inertia{1, Eigen::Vector3d::Zero(), inertia},
                          pinocchio::SE3::Identity());
  model.gravity.setZero();
  return model;
}

}  // namespace

struct PinocchioModel::Impl {
  explicit Impl(pinocchio::Model from) : model{std::move(from)} {}
  pinocchio::Model model{};
  pinocchio::Data data{model};
  Eigen::VectorXd no_torque{Eigen::VectorXd::Zero(model.nv)};
};

PinocchioModel::PinocchioModel(const Chain& chain) : impl_{std::make_unique<Impl>(model_of(chain))} {}
PinocchioModel::PinocchioModel(const Top& top) : impl_{std::make_unique<Impl>(model_of(top))} {}
PinocchioModel::~PinocchioModel() = default;

const double* PinocchioModel::acceleration(const double* q, const double* v) {
  const Numbers q_all = Eigen::Map<const Eigen::VectorXd>{q, impl_->model.nq};
  const Numbers v_all = Eigen::Map<const Eigen::VectorXd>{v, impl_->model.nv};
  // The convention that is its default, and the faster of its two on these chains.
  return pinocchio::aba(impl_->model, impl_->data, q_all, v_all, Numbers{impl_->no_torque},
                        pinocchio::Convention::WORLD)
      .data();
}

std::vector<Point> PinocchioModel::centres(const double* q) {
  pinocchio::forwardKinematics(impl_->model, impl_->data,
                               Numbers{Eigen::Map<const Eigen::VectorXd>{q, impl_->model.nq}});
  std::vector<Point> points;
  for (std::size_t i = 1; i < impl_->data.oMi.size(); ++i) {
    const Eigen::Vector3d p = impl_->data.oMi[i].act(Eigen::Vector3d{0, 0, -kRodLength / 2});
    points.push_back({p.x(), p.y(), p.z()});
  }
  return points;
}

std::string pinocchio_version() { return PINOCCHIO_VERSION; }

}  // namespace pantin::bench
