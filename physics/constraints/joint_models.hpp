#pragma once
// The joint kinds that the solver knows: the one list to extend when a joint is added (besides JointKind). A
// model says
//   place      X_JaJb from q                                (R and p)
//   columns    the joint's motion per unit rate: angular velocity of Jb and velocity of its origin, relative
//   to Ja, in
//              axes of Ja. Where sum v_j d(column_j)/dt is not 0, the model says it as bias.
//   rate       q' from q and v
//   bias       optional: acceleration of Jb against Ja at v' = 0, angular and linear, in axes of Ja
//   measure    q nearest to a pose, by the present q where there are several
//   normalise  back to the manifold
//   reverse    q, v of the joint seen from the other side
//   reversed_bias    optional, where reverse is not linear: second derivative of the reversed q at v' = 0
//   reversed_frame   optional: rotation from the joint frames to those in which the other side sees the same
//   kind
// A model with a pitch is made with the joint's; others have no parameters.
#include <tuple>
#include <utility>

#include <pantin/physics/constraints/ball.hpp>
#include <pantin/physics/constraints/cylindrical.hpp>
#include <pantin/physics/constraints/driven.hpp>
#include <pantin/physics/constraints/fixed.hpp>
#include <pantin/physics/constraints/free_root.hpp>
#include <pantin/physics/constraints/pivot.hpp>
#include <pantin/physics/constraints/planar.hpp>
#include <pantin/physics/constraints/screw.hpp>
#include <pantin/physics/constraints/slider.hpp>
#include <pantin/physics/constraints/universal.hpp>

namespace pantin {

/// In the order of JointKind.
using JointModels = std::tuple<PivotModel, SliderModel, BallModel, FixedModel, CylindricalModel,
                               UniversalModel, PlanarModel, ScrewModel, DrivenModel, FreeModel>;
constexpr int kMostRates = 6, kMostCoordinates = 7;

template <class Model>
constexpr Model model_with(double pitch) {
  if constexpr (requires { Model::pitch; }) return Model{pitch};
  else return Model{};
}

/// Calls f(model) with the model of a joint or link.
template <class Joint, class F>
inline void with_model(const Joint& joint, F&& f) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    static_cast<void>(((static_cast<std::size_t>(joint.kind) == I
                            ? (f(model_with<std::tuple_element_t<I, JointModels>>(joint.pitch)), true)
                            : false) ||
                       ...));
  }(std::make_index_sequence<std::tuple_size_v<JointModels>>{});
}

}  // namespace pantin
