#pragma once
// Who writes a bound node: exactly one writer each.
//
// | drive     | who writes the node        | scene -> physics                              | physics -> scene
// |
// |-----------|----------------------------|-----------------------------------------------|-----------------------|
// | Static    | the user, by teleport      | pose at binding                               | never | | Scene
// | players and user           | every step: pose, velocity and acceleration   | never                 | |
// Physics   | the solver                 | never, only teleport                          | after the steps, |
// |           |                            |                                               | parents first |
#include <string_view>

namespace pantin {

enum class Drive { Static, Scene, Physics };
/// In text and JSON: "static", "animated", "simulated".
[[nodiscard]] std::string_view to_string(Drive drive) noexcept;

/// What a verb of the bridge acts on.
enum class Scope {
  Node,     ///< one node; what hangs below it without a body of its own follows rigidly
  Subtree,  ///< the node and every node below it that has a mass or a link of its own
};

}  // namespace pantin
