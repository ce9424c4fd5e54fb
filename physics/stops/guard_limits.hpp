#pragma once
// Numbers by which stops and dry friction tell rest from motion and contact from nearness [rad or m, and per
// second].
namespace pantin {

/// Nearer to a stop than this, relative to 1 and where the stop is, is at it.
constexpr double kTouch = 1e-11;
/// A number that a stop or friction may hold is at rest below this rate.
constexpr double kStill = 1e-11;
/// Blows on stops with less than this rate do not bounce. What is left out of a bounce by it is lower than
/// 1e-13 m at any deceleration above 5 m/s^2.
constexpr double kWeakBlow = 1e-6;
/// How far crossings are passed before they count: what polynomials are evaluated to.
constexpr double kPassedStop = 1e-13, kPassedRest = 1e-12;
/// Relative, of what holds a number.
constexpr double kPassedEffort = 1e-12;

}  // namespace pantin
