#include <pantin/physics/constraints/joint_loads.hpp>

#include <algorithm>
#include <cmath>

namespace pantin {

namespace {

using kernel::cross;
using kernel::dot;
using kernel::Mat3;
using Vec = kernel::Vec3<double>;

/// Efforts along the numbers of B in A as efforts on the rates of a link that a joint ties the other way
/// round; `q` = the numbers of B in A.
void turn_round(JointKind kind, const double* q, std::array<double, 3>& effort) {
  if (kind == JointKind::Universal) std::swap(effort[0], effort[1]);
  if (kind != JointKind::Planar) {
    for (double& e : effort) e = -e;
    return;
  }
  // The transpose of the derivative of PlanarModel::reverse.
  const auto [x, y, turn] = effort;
  const double c = std::cos(q[2]), s = std::sin(q[2]);
  effort = {-c * x - s * y, s * x - c * y, q[1] * x - q[0] * y - turn};
}

/// Whose damping depends on the side from which it is seen, so that the kernel cannot do it by rate.
bool damps_by_side(const TreeLink& link) { return link.kind == JointKind::Planar && link.reversed; }

bool has_springs(const JointDefinition& joint) {
  return std::any_of(joint.axes.begin(), joint.axes.end(),
                     [](const JointAxis& a) { return a.stiffness > 0; });
}
bool has_damping(const JointDefinition& joint) { return joint.damping != std::array<double, 3>{}; }

}  // namespace

std::array<double, 3> joint_efforts(const JointDefinition& joint, const JointMotors* motors, Instant at,
                                    const double* q, const double* v, bool damped) {
  std::array<double, 3> effort{};
  const bool has_numbers = joint.kind != JointKind::Ball;  // a quaternion has none of its own
  for (std::size_t i = 0; i < effort.size(); ++i) {
    const JointAxis& axis = joint.axes[i];
    if (axis.stiffness > 0) effort[i] -= axis.stiffness * (q[i] - axis.rest);
    if (motors != nullptr && (*motors)[i] && has_numbers)
      effort[i] += effort_of(*(*motors)[i], at.t, at.side, q[i], v[i]);
    if (damped) effort[i] -= joint.damping[i] * v[i];
  }
  return effort;
}

void JointLoads::list(TreeLayout& layout, std::span<const std::unique_ptr<JointDefinition>> joints,
                      std::span<const std::unique_ptr<JointMotors>> motors) {
  links_.clear();
  closures_.clear();
  for (std::uint32_t i = 0; i < layout.links.size(); ++i) {
    TreeLink& link = layout.links[i];
    if (link.joint < 0) continue;
    const auto j = static_cast<std::size_t>(link.joint);
    const bool rotors = link.armature != std::array<double, 3>{};
    link.is_loaded = has_springs(*joints[j]) || motors[j] != nullptr || rotors ||
                     (damps_by_side(link) && has_damping(*joints[j]));
    if (link.is_loaded) links_.push_back({i, joints[j].get(), motors[j].get()});
  }
  for (std::uint32_t c = 0; c < layout.closures.size(); ++c) {
    if (layout.closures[c].coupling >= 0) continue;  // its joints tie links
    const auto j = static_cast<std::size_t>(layout.closures[c].joint);
    if (has_springs(*joints[j]) || motors[j] != nullptr || has_damping(*joints[j]))
      closures_.push_back({c, joints[j].get(), motors[j].get()});
  }
}

void JointLoads::write_efforts(const TreeLayout& layout, std::span<const Instant> at, const double* q_all,
                               const double* v_all, double* efforts) const {
  const std::size_t stages = at.size();
  for (const Load& load : links_) {
    const TreeLink& link = layout.links[load.place];
    with_model(link, [&](auto model) {
      constexpr auto kRates = std::size_t{decltype(model)::kRates};
      constexpr auto kNumbers = std::size_t{decltype(model)::kCoordinates};
      if constexpr (kRates > 0 && kRates <= 3) {
        for (std::size_t s = 0; s < stages; ++s) {
          double q[std::max<std::size_t>(kNumbers, 3)] = {}, v[3] = {};
          for (std::size_t k = 0; k < kNumbers; ++k) q[k] = q_all[(link.q + k) * stages + s];
          for (std::size_t k = 0; k < kRates; ++k) v[k] = v_all[(link.v + k) * stages + s];
          if (link.reversed) model.reverse(q, v);
          auto effort = joint_efforts(*load.joint, load.motors, at[s], q, v, damps_by_side(link));
          if (link.reversed) turn_round(link.kind, q, effort);
          for (std::size_t k = 0; k < kRates; ++k) efforts[(link.v + k) * stages + s] = effort[k];
        }
      }
    });
  }
}

void JointLoads::write_rotor_momenta(const TreeLayout& layout, std::span<const double> v,
                                     std::span<double> efforts) const {
  for (const Load& load : links_) {
    const TreeLink& link = layout.links[load.place];
    with_model(link, [&](auto model) {
      constexpr auto kRates = std::uint32_t{decltype(model)::kRates};
      for (std::uint32_t k = 0; k < std::min(kRates, 3u); ++k)
        efforts[link.v + k] = link.armature[k] * v[link.v + k];
    });
  }
}

ClosureWrench JointLoads::on_closure(const TreeLayout& layout, std::uint32_t c, const ClosureMotion& m,
                                     Instant at, const double* near) const {
  ClosureWrench wrench;
  const auto load =
      std::find_if(closures_.begin(), closures_.end(), [c](const Load& one) { return one.place == c; });
  if (load == closures_.end()) return wrench;
  // The columns of a joint are at right angles, so that efforts along its numbers are the components of one
  // wrench. On a screw it is all torque.
  const RelativeMotion B = relative(m);
  with_model(layout.closures[c], [&](auto model) {
    constexpr int kRates = decltype(model)::kRates;
    if constexpr (kRates > 0 && kRates <= 3) {
      Vec angular[kRates], linear[kRates];
      model.columns(B.R, angular, linear);
      double q[kMostCoordinates], v[3] = {};
      std::copy_n(near, kMostCoordinates, q);
      measure(layout.closures[c], B, q);
      for (int j = 0; j < kRates; ++j) {
        v[j] = dot(angular[j], angular[j]) > 0 ? dot(angular[j], B.w) : dot(linear[j], B.v);
      }
      const std::array<double, 3> effort = joint_efforts(*load->joint, load->motors, at, q, v, true);
      for (int j = 0; j < kRates; ++j) {
        const double e = effort[static_cast<std::size_t>(j)];
        if (dot(angular[j], angular[j]) > 0) wrench.torque += e * (m.a.R * angular[j]);
        else wrench.force += e * (m.a.R * linear[j]);
      }
    }
  });
  return wrench;
}

double JointLoads::next_break(double t) const {
  double next = std::numeric_limits<double>::infinity();
  for (const std::vector<Load>* loads : {&links_, &closures_}) {
    for (const Load& load : *loads) {
      if (load.motors == nullptr) continue;
      for (const std::optional<MotorSettings>& motor : *load.motors) {
        if (motor && motor->path != nullptr) next = std::min(next, motor->path->next_break(t));
      }
    }
  }
  return next;
}

}  // namespace pantin
