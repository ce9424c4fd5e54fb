// What moves: bodies, particles, kinematic bodies.
#include <cmath>

#include "object_reader.hpp"
#include "rigid_ref_parts.hpp"

namespace pantin::reference {
namespace {

/// How far two entries that say the same thing may differ: the digits of a careful file.
constexpr double kAgreement = 1e-9;

bool agree(const Vector3& a, const Vector3& b) {
  return (a - b).norm() <= kAgreement * (1 + a.norm() + b.norm());
}

/// A vector given under one of two keys or both; `to_first` turns the second kind into the first.
template <class Turn>
Vector3 first_of(ObjectReader& reader, const char* first, const char* second, const Turn& to_first) {
  const std::optional<Vector3> direct = reader.vector3_if(first);
  std::optional<Vector3> turned = reader.vector3_if(second);
  if (turned) turned = to_first(*turned);
  if (!reader.has(first) && !reader.has(second)) {
    reader.error(first, "is missing, and so is '" + std::string{second} + "'", "add one of them");
  }
  if (direct && turned && !agree(*direct, *turned)) {
    reader.error(first, "contradicts '" + std::string{second} + "'", "correct one or leave one out");
  }
  return direct ? *direct : turned.value_or(Vector3::Zero());
}

AngleLaw read_law(const JsonValue& value, const PartContext& context, const std::string& subject) {
  ObjectReader reader{value, context.place, "law of " + subject, context.ledger};
  const std::optional<std::string> type = read_type(reader);
  if (type == "sine") {
    SineLaw law;
    law.amplitude = reader.number("amplitude");
    law.omega = reader.number("omega");
    law.phase = reader.number_if("phase").value_or(0);
    law.rate = reader.number_if("rate").value_or(0);
    return law;
  }
  if (type == "uniform_acceleration") {
    UniformAccelerationLaw law;
    law.rate = reader.number_if("rate").value_or(0);
    law.acceleration = reader.number("acceleration");
    return law;
  }
  refuse_type(reader, type, "sine and uniform_acceleration");
  return SineLaw{};
}

}  // namespace

std::string subject_of(const char* what, const JsonValue& value) {
  for (const auto& [key, member] : value.members) {
    if (key == "name" && member.kind == JsonKind::Text) return std::string{what} + " '" + member.text + "'";
  }
  return what;
}

Body read_body(const JsonValue& value, const PartContext& context) {
  ObjectReader reader{value, context.place, subject_of("body", value), context.ledger};
  Body body;
  body.name = reader.text("name");
  body.mass.mass = reader.number("mass");
  body.mass.I_BBcm_B = reader.matrix3("inertia_cog_body");
  body.mass.p_BBcm = reader.vector3_if("cog_in_node").value_or(Vector3::Zero());
  const Quaternion q_WB = reader.quaternion("orientation_wxyz");
  const Vector3 p_BBcm_W = q_WB * body.mass.p_BBcm;
  body.X_WB.q = q_WB;
  body.X_WB.p = first_of(reader, "position_node", "position_cog",
                         [&](const Vector3& p_WBcm) -> Vector3 { return p_WBcm - p_BBcm_W; });
  // References that are exact for the given numbers are so for the rates in body axes.
  const Vector3 w_WB_B = first_of(reader, "angular_velocity_body", "angular_velocity_world",
                                  [&](const Vector3& w_WB) -> Vector3 { return q_WB.conjugate() * w_WB; });
  body.w_WB = q_WB * w_WB_B;
  body.v_WBcm = first_of(reader, "velocity_cog", "velocity_node",
                         [&](const Vector3& v_WB) -> Vector3 { return v_WB + body.w_WB.cross(p_BBcm_W); });
  return body;
}

Particle read_particle(const JsonValue& value, const PartContext& context) {
  ObjectReader reader{value, context.place, subject_of("particle", value), context.ledger};
  Particle particle;
  particle.name = reader.text("name");
  particle.mass = reader.number("mass");
  particle.p_W = reader.vector3("position");
  particle.v_W = reader.vector3("velocity");
  return particle;
}

KinematicBody read_kinematic_body(const JsonValue& value, const PartContext& context) {
  ObjectReader reader{value, context.place, subject_of("kinematic body", value), context.ledger};
  KinematicBody body;
  body.name = reader.text("name");
  body.p_WA = reader.vector3("anchor_world");
  body.axis_W = reader.unit_vector3("axis_world");
  body.q_WB = reader.quaternion_if("orientation_wxyz").value_or(Quaternion::Identity());
  if (const JsonValue* law = reader.object_if("law")) {
    body.law = read_law(*law, {reader.place("law"), context.ledger}, reader.subject());
  } else if (!reader.has("law")) {
    reader.error("law", "is missing: formulas in words are not read",
                 "give the law sine or uniform_acceleration");
  }
  reader.skip({"angle", "angle_rate", "angle_accel", "description"});
  return body;
}

AngleAt evaluate(const AngleLaw& law, double t) {
  if (const auto* sine = std::get_if<SineLaw>(&law)) {
    const double s = std::sin(sine->omega * t + sine->phase), c = std::cos(sine->omega * t + sine->phase);
    return {sine->amplitude * s + sine->rate * t, sine->amplitude * sine->omega * c + sine->rate,
            -sine->amplitude * sine->omega * sine->omega * s};
  }
  const auto& uniform = std::get<UniformAccelerationLaw>(law);
  return {uniform.rate * t + uniform.acceleration * t * t / 2, uniform.rate + uniform.acceleration * t,
          uniform.acceleration};
}

}  // namespace pantin::reference
