// Second moments S = integral of x x^T dm and inertia I = tr(S) 1 - S, S = tr(I)/2 1 - I, say the same; S is
// the one that a linear map x -> M x takes to M S M^T.
#include <pantin/physics/mass_properties.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <pantin/physics/expects.hpp>
#include <pantin/physics/mesh_integrals.hpp>
#include <pantin/physics/setting_checks.hpp>

#include <Eigen/Eigenvalues>

namespace pantin {
namespace {

constexpr double kInertiaTolerance = 1e-9;  // relative to the largest entry or moment

Matrix3 inertia_from_second_moments(const Matrix3& S) { return S.trace() * Matrix3::Identity() - S; }

/// Inertia of a point mass at `d` about the origin.
Matrix3 inertia_of_point(double mass, const Vector3& d) {
  return inertia_from_second_moments(mass * d * d.transpose());
}

Matrix3 symmetric_part(const Matrix3& A) { return 0.5 * (A + A.transpose()); }

// Solids at density 1 in their own frame: `mass` is the volume.

MassProperties solid_of(const SphereShape& sphere) {
  const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(sphere.radius, 3);
  return {volume, Vector3::Zero(), 0.4 * volume * sphere.radius * sphere.radius * Matrix3::Identity()};
}

MassProperties solid_of(const BoxShape& box) {
  const double volume = box.size.prod();
  const Vector3 moments = volume / 12 * box.size.cwiseAbs2();
  return {volume, Vector3::Zero(), inertia_from_second_moments(moments.asDiagonal())};
}

MassProperties solid_of(const CylinderShape& cylinder) {
  const double r2 = cylinder.radius * cylinder.radius;
  const double volume = std::numbers::pi * r2 * cylinder.length;
  const double across = volume * (r2 / 4 + cylinder.length * cylinder.length / 12);
  return {volume, Vector3::Zero(), Vector3(across, across, volume * r2 / 2).asDiagonal()};
}

// Cylinder plus two half spheres: a half sphere's centre of gravity is 3/8 r from its flat face, and its
// inertia about a diameter of that face is 2/5 m r^2.
MassProperties solid_of(const CapsuleShape& capsule) {
  const double r = capsule.radius, l = capsule.length;
  const double middle = std::numbers::pi * r * r * l;
  const double caps = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  const double across =
      middle * (r * r / 4 + l * l / 12) + caps * (0.4 * r * r + l * l / 4 + 3.0 / 8.0 * l * r);
  const double along = middle * r * r / 2 + caps * 0.4 * r * r;
  return {middle + caps, Vector3::Zero(), Vector3(across, across, along).asDiagonal()};
}

MassProperties solid_of(const MeshShape& shape) {
  const std::optional<SettingsProblem> problem = closedness_problem(*shape.mesh);
  PANTIN_EXPECTS(!problem, problem->text + "; " + problem->remedy);
  const MeshIntegrals integrals = integrals_of(*shape.mesh, shape.scale);
  return {integrals.volume, integrals.centroid, inertia_from_second_moments(integrals.second_moments)};
}

// A cone's centre of gravity is a quarter of its height above the base: a quarter below the middle of S.
MassProperties solid_of(const ConeShape& cone) {
  const double r2 = cone.radius * cone.radius, l2 = cone.length * cone.length;
  const double volume = std::numbers::pi / 3 * r2 * cone.length;
  const double across = volume * (3.0 / 20 * r2 + 3.0 / 80 * l2);
  return {volume, {0, 0, -cone.length / 4}, Vector3(across, across, volume * 0.3 * r2).asDiagonal()};
}

MassProperties solid_of(const EllipsoidShape& ellipsoid) {
  const double volume = 4.0 / 3.0 * std::numbers::pi * ellipsoid.radii.prod();
  const Vector3 moments = volume / 5 * ellipsoid.radii.cwiseAbs2();
  return {volume, Vector3::Zero(), inertia_from_second_moments(moments.asDiagonal())};
}

MassProperties solid_of(const ConvexShape& convex) { return solid_of(MeshShape{convex.hull, convex.scale}); }

MassProperties solid_of(const CompoundShape& compound) {
  std::vector<MassProperties> parts;
  for (const Shape& part : *compound.parts) parts.push_back(mass_of(part, 1));
  return combined(parts);
}

MassProperties checked_solid_of(const Shape& shape) {
  const std::optional<SettingsProblem> problem = problem_with(shape);
  PANTIN_EXPECTS(!problem, problem->text + "; " + problem->remedy);
  return std::visit([](const auto& geometry) { return solid_of(geometry); }, shape.geometry);
}

SettingsProblem unphysical(const std::string& text, const std::string& remedy) {
  return {ProblemCode::Unphysical, "mass properties: " + text, remedy};
}

std::optional<SettingsProblem> inertia_problem(const Matrix3& I, InertiaCheck check) {
  const double largest = I.cwiseAbs().maxCoeff();
  if (largest == 0) return std::nullopt;
  if (((I - I.transpose()).cwiseAbs().array() > kInertiaTolerance * largest).any()) {
    return unphysical("inertia " + text_of(I) + " kg m^2 is not symmetric",
                      "give Ixy = Iyx, Ixz = Izx and Iyz = Izy");
  }
  // Scaled so that neither very large nor very small inertias leave the solver's range.
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver{symmetric_part(I / largest), Eigen::EigenvaluesOnly};
  const Vector3 moments = largest * solver.eigenvalues();  // ascending
  const std::string text = "principal moments of inertia are " + text_of(moments) + " kg m^2; ";
  if (moments[0] < -kInertiaTolerance * largest) {
    return unphysical(text + "none may be negative",
                      "take the inertia about the centre of gravity, with products "
                      "of inertia as -sum of m x y");
  }
  if (check == InertiaCheck::Physical && moments[0] + moments[1] < moments[2] * (1 - kInertiaTolerance)) {
    return unphysical(text + "no body has one that exceeds the sum of the others",
                      "take the inertia about the centre of gravity from the body's shape");
  }
  return std::nullopt;
}

}  // namespace

std::optional<SettingsProblem> problem_with(const MassProperties& mass, InertiaCheck check) {
  if (std::optional<SettingsProblem> problem =
          first_problem({must_be_finite({"mass properties", "mass", "kg"}, mass.mass),
                         must_be_finite({"mass properties", "centre of gravity", "m"}, mass.p_BBcm)})) {
    return problem;
  }
  if (!mass.I_BBcm_B.allFinite()) {
    return SettingsProblem{
        ProblemCode::NotFinite,
        "mass properties: inertia is " + text_of(mass.I_BBcm_B) + " kg m^2; it must be finite",
        "give an inertia that is finite"};
  }
  if (mass.mass < 0) {
    return unphysical("mass is " + text_of(mass.mass) + " kg; it must be zero or more",
                      "give a mass that is zero or more");
  }
  if (mass.mass == 0 && (mass.I_BBcm_B.array() != 0).any()) {
    return unphysical("inertia is " + text_of(mass.I_BBcm_B) + " kg m^2 but mass is zero",
                      "give a mass above zero, or zero inertia");
  }
  return inertia_problem(mass.I_BBcm_B, check);
}

MassProperties mass_of(const Shape& shape, double density) {
  PANTIN_EXPECTS(std::isfinite(density) && density >= 0,
                 "density is " + text_of(density) + " kg/m^3; give a finite number, zero or more");
  MassProperties solid = checked_solid_of(shape);
  solid.mass *= density;
  solid.I_BBcm_B *= density;
  return in_frame(shape.X_BS, solid);
}

double volume_of(const ShapeGeometry& geometry) { return checked_solid_of({geometry, Pose{}}).mass; }

MassProperties combined(std::span<const MassProperties> parts) {
  MassProperties whole{0, Vector3::Zero(), Matrix3::Zero()};
  if (parts.empty()) return whole;
  // Centres of gravity are averaged as seen from the first that counts: parts far from the origin lose no
  // digits.
  const auto with_mass =
      std::find_if(parts.begin(), parts.end(), [](const MassProperties& part) { return part.mass > 0; });
  const Vector3 reference = (with_mass != parts.end() ? with_mass : parts.begin())->p_BBcm;
  Vector3 first_moment = Vector3::Zero();
  for (const MassProperties& part : parts) {
    whole.mass += part.mass;
    first_moment += part.mass * (part.p_BBcm - reference);
  }
  whole.p_BBcm = reference;
  if (whole.mass > 0) whole.p_BBcm += first_moment / whole.mass;
  for (const MassProperties& part : parts) {
    whole.I_BBcm_B += part.I_BBcm_B + inertia_of_point(part.mass, part.p_BBcm - whole.p_BBcm);
  }
  return whole;
}

MassProperties in_frame(const Pose& X_AB, const MassProperties& in_B) {
  const Matrix3 R_AB = X_AB.rotation();
  return {in_B.mass, X_AB * in_B.p_BBcm, symmetric_part(R_AB * in_B.I_BBcm_B * R_AB.transpose())};
}

MassProperties deformed(const Matrix3& M, const MassProperties& mass) {
  const Matrix3 S = 0.5 * mass.I_BBcm_B.trace() * Matrix3::Identity() - mass.I_BBcm_B;
  return {mass.mass, M * mass.p_BBcm, symmetric_part(inertia_from_second_moments(M * S * M.transpose()))};
}

}  // namespace pantin
