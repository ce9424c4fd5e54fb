#pragma once
// The bent chain of five whose bodies stiff springs tie: its tip to the world, or each rod to the next but
// one, without stretch where they start, critically damped for 1 kg, 1 s from rest, by radau.
namespace pantin::bench {

/// Prints errors (the greatest distance of a centre of gravity [m]), CPU times and evaluations of the
/// derivative, of fixed steps and of tolerances. The reference is radau in 4,000 steps, whose difference from
/// itself in 2,000 stands beside.
void measure_tied_chains();

}  // namespace pantin::bench
