#include "gltf_motion.hpp"

#include <algorithm>

#include "gltf_inventory.hpp"
#include "gltf_nodes.hpp"

namespace pantin::gltf {
namespace {

constexpr std::string_view kExtension = "KHR_physics_rigid_bodies";
constexpr std::string_view kShapes = "KHR_implicit_shapes";

std::optional<JsonValue> extension_of(Report& report, const JsonValue& object, std::string_view name) {
  const std::optional<JsonValue> extensions = member(report, object, "extensions", JsonKind::Object);
  return extensions ? member(report, *extensions, name, JsonKind::Object) : std::nullopt;
}

void tell_unread(Report& report, std::string_view extension, const JsonValue& value, std::size_t count) {
  if (value.key() == "extras") return note_extras(report, value);
  report.drop(Severity::Warning, std::string{extension} + " '" + shortened(value.key()) + "'", value,
              "not read yet", "set it up through the library or the command line", count);
}

/// Whether the value says what holds without it: false, a gravity factor of 1, no velocity.
bool is_default(const JsonValue& value) {
  constexpr std::array<std::string_view, 4> kKnown{"isKinematic", "gravityFactor", "linearVelocity",
                                                   "angularVelocity"};
  if (std::ranges::find(kKnown, value.key()) == kKnown.end()) return false;
  if (value.kind() == JsonKind::Boolean) return !value.boolean();
  if (value.kind() == JsonKind::Number) return value.key() == "gravityFactor" && value.number() == 1.0;
  if (value.kind() != JsonKind::Array) return false;
  for (std::size_t i = 0; i < value.size(); ++i)
    if (value.at(i).kind() != JsonKind::Number || value.at(i).number() != 0.0) return false;
  return true;
}

/// I = R diag(moments) R^T, R from the principal axes to the node's.
Matrix3 inertia_of(Report& report, const JsonValue& motion, const std::array<double, 3>& moments) {
  const Vector3 diagonal{moments[0], moments[1], moments[2]};
  const auto xyzw = numbers<4>(report, motion, "inertiaOrientation");
  if (!xyzw) return diagonal.asDiagonal();
  const Matrix3 R =
      unit_quaternion(report, *motion.find("inertiaOrientation"), *xyzw, kUnitTolerance).toRotationMatrix();
  const Matrix3 I = R * diagonal.asDiagonal() * R.transpose();
  return 0.5 * (I + I.transpose());  // symmetric to the last bit
}

void check_members(Report& report, const JsonValue& motion) {
  constexpr std::array<std::string_view, 4> kRead{"mass", "centerOfMass", "inertiaDiagonal",
                                                  "inertiaOrientation"};
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const JsonValue value = motion.at(i);
    const bool is_read = std::ranges::find(kRead, value.key()) != kRead.end();
    if (is_read) continue;
    if (is_default(value)) report.marks().drop(value, "says what holds without it");
    else tell_unread(report, kExtension, value, 1);
  }
}

std::optional<MassProperties> mass_in(Report& report, const JsonValue& motion) {
  const std::optional<JsonValue> mass = motion.find("mass");
  const auto centre = numbers<3>(report, motion, "centerOfMass");
  const auto moments = numbers<3>(report, motion, "inertiaDiagonal");
  if (!mass || to_number(report, *mass) == 0) {
    report.marks().drop(motion, "says no mass that is kept");
    if (mass)
      report.tally(Severity::Warning, *mass,
                   "a mass of 0 means infinite, which is not read yet: no mass is kept",
                   "let the node be animated instead");
    else if (centre || moments)
      report.tally(Severity::Warning, motion,
                   "it gives a centre of gravity or inertia but no mass: neither is kept", "give the mass");
    return std::nullopt;
  }
  MassProperties result{.mass = mass->number(), .I_BBcm_B = Matrix3::Zero()};
  if (centre) result.p_BBcm = Vector3{(*centre)[0], (*centre)[1], (*centre)[2]};
  const bool is_finite = moments && std::ranges::find(*moments, 0.0) == moments->end();
  if (is_finite) {
    result.I_BBcm_B = inertia_of(report, motion, *moments);
  } else if (moments) {
    report.convert(
        Severity::Warning, *motion.find("inertiaDiagonal"),
        "a moment of inertia of 0 means infinite, which is not read yet: the inertia is kept as zero",
        "write the true moments");
  } else {
    report.tally(Severity::Note, motion,
                 "it gives a mass without inertia: hand-over derives the inertia from the node's geometry",
                 "write inertiaDiagonal to set it");
  }
  if (const std::optional<SettingsProblem> problem = problem_with(result))
    report.tally(Severity::Warning, motion, problem->text + ": kept as read", problem->remedy);
  return result;
}

}  // namespace

std::optional<MassProperties> read_motion(Report& report, const JsonValue& node) {
  const std::optional<JsonValue> extension = extension_of(report, node, kExtension);
  if (!extension) return std::nullopt;
  for (std::size_t i = 0; i < extension->size(); ++i)
    if (extension->at(i).key() != "motion") tell_unread(report, kExtension, extension->at(i), 1);
  const std::optional<JsonValue> motion = member(report, *extension, "motion", JsonKind::Object);
  if (!motion) return std::nullopt;
  check_members(report, *motion);
  return mass_in(report, *motion);
}

void note_physics_lists(const Document& document) {
  for (const std::string_view name : {kExtension, kShapes}) {
    const std::optional<JsonValue> extension = extension_of(document.report(), document.root(), name);
    for (std::size_t i = 0; extension && i < extension->size(); ++i) {
      const JsonValue list = extension->at(i);
      if (list.kind() != JsonKind::Array || list.size() > 0)
        tell_unread(document.report(), name, list, list.kind() == JsonKind::Array ? list.size() : 1);
    }
  }
}

}  // namespace pantin::gltf
