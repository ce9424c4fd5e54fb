#pragma once
// Mass, centre of gravity and inertia of a rigid body, and where they come from: solids of uniform density,
// sums, changes of frame.
#include <optional>
#include <span>

#include <pantin/physics/pose.hpp>
#include <pantin/physics/problem.hpp>
#include <pantin/physics/shape.hpp>

namespace pantin {

struct MassProperties {
  double mass{1};                         ///< [kg], > 0 for a free body; 0 only with zero inertia
  Vector3 p_BBcm{Vector3::Zero()};        ///< centre of gravity in B [m]
  Matrix3 I_BBcm_B{Matrix3::Identity()};  ///< inertia about the centre of gravity, axes of B [kg m^2]
};

/// How strictly an inertia is judged.
enum class InertiaCheck {
  Physical,  ///< the inertia of some distribution of mass: principal moments A + B >= C
  Solvable,  ///< positive semi-definite is enough, as in many robot files and textbook problems
};

/// Negative or non-finite mass, an inertia that is not symmetric or not positive semi-definite, principal
/// moments with A + B < C (unless waived; tolerances 1e-9 relative), inertia without mass. Massless is
/// allowed here: it is a body carried by others; whether it can move is judged with what it is joined to.
[[nodiscard]] std::optional<SettingsProblem> problem_with(const MassProperties& mass,
                                                          InertiaCheck check = InertiaCheck::Physical);

/// Of a solid of uniform density [kg/m^3], >= 0, in the frame of its carrier (X_BS applied). The shape must
/// have no problem and a mesh must be closed (closedness_problem), else the contract is broken. Mesh: exact
/// polyhedral integrals (mesh_integrals.hpp).
[[nodiscard]] MassProperties mass_of(const Shape& shape, double density);

/// The volume of the solid [m^3]; the same conditions.
[[nodiscard]] double volume_of(const ShapeGeometry& geometry);

/// Several bodies, rigidly joined and given in one frame, as one. Of massless parts alone: massless, at the
/// first one's centre of gravity.
[[nodiscard]] MassProperties combined(std::span<const MassProperties> parts);

/// The same body given in A instead of B.
[[nodiscard]] MassProperties in_frame(const Pose& X_AB, const MassProperties& in_B);

/// The body after the linear map `M` of its frame (scale, shear, mirror), its mass kept: centre of gravity M
/// c, second moments M S M^T (S = tr(I)/2 1 - I), inertia tr(S') 1 - S'.
[[nodiscard]] MassProperties deformed(const Matrix3& M, const MassProperties& mass);

}  // namespace pantin
