#pragma once
// Reads reference problems of the schema rigid-ref/1 (JSON, SI units) and builds them in physics.
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <pantin/bridge/account.hpp>
#include <pantin/bridge/diagnostic.hpp>
#include <pantin/bridge/problems/reference_problem.hpp>
#include <pantin/physics/physics_manager.hpp>

namespace pantin {

/// Reads a file. Errors stand at `file:line` where it is not JSON, else at `file#/json/pointer`: missing
/// keys, wrong types, numbers that are not finite or out of range, axes and quaternions that are not unit,
/// inertia that no body has, names that are unknown or used twice, data that contradict each other, types
/// that the schema's reader does not know. Velocities that a joint does not allow are a warning, keys that it
/// does not know too; keys for people are a note. `account`, which may be null, gets an entry for every
/// value. Never throws.
[[nodiscard]] Loaded<ReferenceProblem> load_rigid_ref(const std::filesystem::path& file,
                                                      Account* account = nullptr);

/// The same from text; `file` is what the messages call it.
[[nodiscard]] Loaded<ReferenceProblem> parse_rigid_ref(std::string_view text, std::string file,
                                                       Account* account = nullptr);

/// What is wrong with a problem as a value: everything but the JSON of the list above. Places are JSON
/// pointers.
[[nodiscard]] std::vector<Diagnostic> findings_in(const ReferenceProblem& problem);

/// What became of a problem's parts.
struct ReferenceInstance {
  std::map<std::string, BodyId, std::less<>> bodies{};         ///< kinematic ones included
  std::map<std::string, ParticleId, std::less<>> particles{};  ///< each in a system of its own
  std::map<std::string, JointId, std::less<>> joints{};
  std::vector<ForceId> forces{};  ///< gravity first unless it is zero, then as in the problem
};

/// Builds the problem in `physics`, beside what is there; its time should be 0. Joint values are zero in the
/// start pose. What physics does not know yet (contacts, closed loops) is refused by name, and then nothing
/// at all is built.
[[nodiscard]] Loaded<ReferenceInstance> instantiate(const ReferenceProblem& problem, PhysicsManager& physics);

}  // namespace pantin
