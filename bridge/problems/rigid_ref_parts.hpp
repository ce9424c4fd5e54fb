#pragma once
// Reading the parts of a rigid-ref/1 file. Private to load_rigid_ref.
#include <string>
#include <vector>

#include <pantin/bridge/diagnostic.hpp>
#include <pantin/bridge/problems/reference_problem.hpp>

#include "json_document.hpp"

namespace pantin::reference {

/// Where a part stands and who keeps what is found about it.
struct PartContext {
  std::string place{};  ///< file#/pointer of the part
  std::vector<Diagnostic>& ledger;
};

[[nodiscard]] Body read_body(const JsonValue& value, const PartContext& context);
[[nodiscard]] Particle read_particle(const JsonValue& value, const PartContext& context);
[[nodiscard]] KinematicBody read_kinematic_body(const JsonValue& value, const PartContext& context);
[[nodiscard]] Joint read_joint(const JsonValue& value, const PartContext& context);
[[nodiscard]] Force read_force(const JsonValue& value, const PartContext& context);
[[nodiscard]] Contact read_contact(const JsonValue& value, const PartContext& context);
[[nodiscard]] Sample read_sample(const JsonValue& value, const PartContext& context);
[[nodiscard]] Accuracy read_accuracy(const JsonValue& value, const PartContext& context);

/// "body 'arm'" where the object has a name, else "body" and its place says which.
[[nodiscard]] std::string subject_of(const char* what, const JsonValue& value);

}  // namespace pantin::reference
