// The solution that comes with a problem, and how far it can be trusted.
#include <charconv>

#include "object_reader.hpp"
#include "rigid_ref_parts.hpp"

namespace pantin::reference {
namespace {

BodySample read_state(const std::string& name, const JsonValue& value, const PartContext& context) {
  ObjectReader reader{value, context.place, "state of '" + name + "'", context.ledger};
  BodySample sample{.name = name};
  const bool particle = reader.has("position");  // particles are told by it
  sample.p_WBcm = reader.vector3_if(particle ? "position" : "position_cog");
  sample.v_WBcm = reader.vector3_if(particle ? "velocity" : "velocity_cog");
  sample.q_WB = reader.quaternion_if("quaternion_wxyz");
  sample.w_WB = reader.vector3_if("angular_velocity_world");
  sample.p_WB = reader.vector3_if("position_node");
  return sample;
}

SampleEnergy read_energy(const JsonValue& value, const PartContext& context) {
  ObjectReader reader{value, context.place, "energy", context.ledger};
  return {.kinetic = reader.number("kinetic"),
          .potential_gravity = reader.number_if("potential_gravity").value_or(0),
          .potential_elastic_or_central = reader.number_if("potential_elastic_or_central").value_or(0),
          .total = reader.number("total")};
}

}  // namespace

Sample read_sample(const JsonValue& value, const PartContext& context) {
  ObjectReader reader{value, context.place, "sample", context.ledger};
  Sample sample;
  sample.t = reader.number("t");
  if (const JsonValue* state = reader.object_if("state")) {
    const std::string place = reader.place("state");
    for (const auto& [name, body] : state->members) {
      sample.bodies.push_back(read_state(name, body, {place + '/' + pointer_token(name), context.ledger}));
    }
  }
  if (const JsonValue* energy = reader.object_if("energy")) {
    sample.energy = read_energy(*energy, {reader.place("energy"), context.ledger});
  }
  reader.skip({"scalars"});
  return sample;
}

Accuracy read_accuracy(const JsonValue& value, const PartContext& context) {
  ObjectReader reader{value, context.place, "accuracy", context.ledger};
  Accuracy accuracy;
  accuracy.absolute = reader.number_if("estimated_abs");
  accuracy.angle = reader.number_if("estimated_abs_angle");
  accuracy.note = reader.text_if("note").value_or("");
  const JsonValue* table = reader.object_if("attitude_sensitivity");
  if (table == nullptr) return accuracy;
  const std::string place = reader.place("attitude_sensitivity");
  ObjectReader rows{*table, place, "attitude_sensitivity", context.ledger};
  for (const auto& [key, entry] : table->members) {
    double t = 0;
    const auto [end, code] = std::from_chars(key.data(), key.data() + key.size(), t);
    if (code != std::errc{} || end != key.data() + key.size()) {
      rows.error(key, "is not a time in seconds", "write a number");
      rows.skip({key});
      continue;
    }
    accuracy.attitude_sensitivity.emplace_back(t, rows.number(key));
  }
  return accuracy;
}

}  // namespace pantin::reference
