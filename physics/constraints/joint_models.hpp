#pragma once
// The joint kinds that the solver knows: the one list to extend when a joint is added (besides JointKind). A
// model says
//   place      X_JaJb from q                                (R and p)
//   columns    the joint's motion per unit rate: angular velocity of Jb and velocity of its origin, relative
//   to Ja, in
//              axes of Ja. What they do as q changes must be a rotation with Jb or nothing (true of every
//              joint whose axes stand still in Ja or in Jb).
//   rate       q' from q and v
//   measure    q nearest to a pose, by the present q where there are several
//   normalise  back to the manifold
//   reverse    q, v of the joint seen from the other side
#include <tuple>
#include <utility>

#include <pantin/physics/constraints/ball.hpp>
#include <pantin/physics/constraints/driven.hpp>
#include <pantin/physics/constraints/fixed.hpp>
#include <pantin/physics/constraints/free_root.hpp>
#include <pantin/physics/constraints/pivot.hpp>
#include <pantin/physics/constraints/slider.hpp>

namespace pantin {

/// In the order of JointKind.
using JointModels = std::tuple<PivotModel, SliderModel, BallModel, FixedModel, DrivenModel, FreeModel>;
constexpr int kMostRates = 6, kMostCoordinates = 7;

/// Calls f(Model{}) for the model of a kind.
template <class F>
inline void with_model(JointKind kind, F&& f) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    static_cast<void>(
        ((static_cast<std::size_t>(kind) == I ? (f(std::tuple_element_t<I, JointModels>{}), true) : false) ||
         ...));
  }
  (std::make_index_sequence<std::tuple_size_v<JointModels>>{});
}

}  // namespace pantin
