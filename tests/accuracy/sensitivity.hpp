#pragma once
// How a problem multiplies errors: what any integrator that errs by so much a second must expect.
#include <pantin/bridge/problems/rigid_ref.hpp>

namespace pantin::test {

/// Greatest displacement of a body at any sample [m or rad] for one unit of error [m/s or rad/s] made all
/// along the problem, by finite differences of the solver: from the start and from later samples the motion
/// is run once as it is and several times with positions or velocities changed a little at random (seeded).
/// Errors of a velocity count over one second. At least the duration [s]. For problems without loops and
/// contacts.
[[nodiscard]] double sensitivity(const ReferenceProblem& problem);

}  // namespace pantin::test
