#pragma once
// The bent chain of five with stiff springs on joints 2 to 5, at rest where they start, critically damped for
// an inertia of 0.05 kg m^2 or not at all, 1 s from rest, by radau.
namespace pantin::bench {

/// Prints errors (the greatest difference of a coordinate of a centre of gravity [m]) and times, of fixed
/// steps and of tolerances. The reference is gauss16 at 1e-12 up to 1e6 N m/rad, whose explicit stages still
/// follow the springs; beyond, radau in 4,000 steps. What these are good for stands beside them: by how much
/// radau in 4,000 steps differs from itself in 2,000, from gauss16, and from the chain whose joints 2 to 5
/// are fixed, to which the true motion comes as near as torque / stiffness.
void measure_stiff_chains();

}  // namespace pantin::bench
