// What acts between them: joints, forces, contacts.
#include "object_reader.hpp"
#include "rigid_ref_parts.hpp"

namespace pantin::reference {
namespace {

SpringEnd read_end(ObjectReader& spring, const char* key, const PartContext& context) {
  const JsonValue* value = spring.object_if(key);
  if (value == nullptr) {
    if (!spring.has(key)) spring.error(key, "is missing", "name a body, or the world and a point");
    return {};
  }
  ObjectReader reader{*value, spring.place(key), "end '" + std::string{key} + "' of " + spring.subject(),
                      context.ledger};
  SpringEnd end{.body = reader.text("body")};
  if (end.body == kWorld) {
    end.point = reader.vector3("point_world");
  } else if (reader.has("point_world")) {
    reader.error("point_world", "is given for a body, on which points move", "use point_body_cog");
    reader.skip({"point_world", "point_body_cog"});
  } else {
    end.point = reader.vector3_if("point_body_cog").value_or(Vector3::Zero());
  }
  return end;
}

/// The body or particle that a force acts on.
std::string read_target(ObjectReader& reader) {
  if (reader.has("particle") && reader.has("body")) {
    reader.error("particle", "stands beside 'body'", "leave one out");
    reader.skip({"body"});
  }
  if (std::optional<std::string> particle = reader.text_if("particle")) return *std::move(particle);
  if (reader.has("particle")) return {};
  return reader.text("body");
}

Plane read_plane(ObjectReader& reader) {
  Plane plane;
  plane.point = reader.vector3("plane_point");
  plane.normal = reader.unit_vector3("plane_normal");
  return plane;
}

}  // namespace

Joint read_joint(const JsonValue& value, const PartContext& context) {
  ObjectReader reader{value, context.place, subject_of("joint", value), context.ledger};
  Joint joint;
  const std::optional<std::string> type = read_type(reader);
  joint.name = reader.text("name");
  if (type == "pivot") {
    joint.kind = JointKind::Pivot;
  } else if (type == "slider") {
    joint.kind = JointKind::Slider;
  } else if (type == "ball") {
    joint.kind = JointKind::Ball;
  } else if (type == "fixed") {
    joint.kind = JointKind::Fixed;
  } else {
    refuse_type(reader, type, "pivot, slider, ball and fixed");
    return joint;
  }
  joint.a = reader.text("body_a");
  joint.b = reader.text("body_b");
  // A weld has the same effect wherever it is thought to be.
  joint.p_WJ = joint.kind == JointKind::Fixed && !reader.has("anchor_world") ? Vector3::Zero()
                                                                             : reader.vector3("anchor_world");
  if (joint.kind == JointKind::Pivot || joint.kind == JointKind::Slider) {
    joint.axis_W = reader.unit_vector3("axis_world");
  } else {
    reader.skip({"axis_world"});
  }
  return joint;
}

Force read_force(const JsonValue& value, const PartContext& context) {
  ObjectReader reader{value, context.place, subject_of("force", value), context.ledger};
  const std::optional<std::string> type = read_type(reader);
  reader.skip({"name"});
  if (type && reader.subject() == "force") reader.set_subject("force " + *type);
  if (type == "spring_damper_point_to_point") {
    Spring spring;
    spring.a = read_end(reader, "a", context);
    spring.b = read_end(reader, "b", context);
    spring.stiffness = reader.number("stiffness");
    spring.damping = reader.number_if("damping").value_or(0);
    spring.rest_length = reader.number("rest_length");
    return spring;
  }
  if (type == "torque_constant") {
    ConstantTorque torque;
    torque.body = reader.text("body");
    torque.torque_W = reader.vector3("torque_world");
    return torque;
  }
  if (type == "linear_drag" || type == "quadratic_drag") {
    Drag drag{.quadratic = type == "quadratic_drag", .body = read_target(reader)};
    drag.coefficient = reader.number("coefficient");
    drag.medium_velocity = reader.vector3_if("medium_velocity").value_or(Vector3::Zero());
    return drag;
  }
  if (type == "central_gravity") {
    CentralGravity gravity{.body = read_target(reader)};
    gravity.center = reader.vector3("center");
    gravity.mu = reader.number("mu");
    return gravity;
  }
  refuse_type(
      reader, type,
      "spring_damper_point_to_point, torque_constant, linear_drag, quadratic_drag and central_gravity");
  return Spring{};
}

Contact read_contact(const JsonValue& value, const PartContext& context) {
  ObjectReader reader{value, context.place, subject_of("contact", value), context.ledger};
  const std::optional<std::string> type = read_type(reader);
  reader.skip({"name"});
  Contact contact;
  if (type == "box_plane") {
    BoxOnPlane pair{.body = reader.text("body"), .size = reader.vector3("size")};
    pair.plane = read_plane(reader);
    contact.pair = std::move(pair);
  } else if (type == "sphere_plane") {
    SphereOnPlane pair{.body = reader.text("body"), .radius = reader.number("radius")};
    pair.plane = read_plane(reader);
    contact.pair = std::move(pair);
  } else if (type == "capsule_capsule") {
    CapsulePair pair{.a = reader.text("body_a"), .b = reader.text("body_b")};
    pair.radius = reader.number("radius");
    pair.half_length_a = reader.number("half_length_a");
    pair.half_length_b = reader.number("half_length_b");
    pair.axis = reader.text_if("capsule_axis").value_or("body x");
    contact.pair = std::move(pair);
  } else {
    refuse_type(reader, type, "box_plane, sphere_plane and capsule_capsule");
    return contact;
  }
  contact.restitution = reader.number("restitution");
  contact.friction = reader.number("friction");
  return contact;
}

std::string type_name(const Force& force) {
  if (std::holds_alternative<Spring>(force)) return "spring_damper_point_to_point";
  if (std::holds_alternative<ConstantTorque>(force)) return "torque_constant";
  if (const auto* drag = std::get_if<Drag>(&force)) return drag->quadratic ? "quadratic_drag" : "linear_drag";
  return "central_gravity";
}

std::string type_name(const Contact& contact) {
  if (std::holds_alternative<BoxOnPlane>(contact.pair)) return "box_plane";
  if (std::holds_alternative<SphereOnPlane>(contact.pair)) return "sphere_plane";
  return "capsule_capsule";
}

}  // namespace pantin::reference
