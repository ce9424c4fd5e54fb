#include <pantin/physics/integrators/step_arrays.hpp>

#include <cmath>
#include <string>

#include <pantin/physics/expects.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {

void expect_step(const Dynamics& dynamics, double t, double h, std::span<const double> q,
                 std::span<const double> v) {
  PANTIN_EXPECTS(std::isfinite(t), "time is " + text_of(t) + " s; give a finite time");
  PANTIN_EXPECTS(std::isfinite(h) && h > 0, "step is " + text_of(h) + " s; give a finite step above zero");
  PANTIN_EXPECTS(q.size() == dynamics.coordinates(), std::to_string(q.size()) + " coordinates given for " +
                                                         std::to_string(dynamics.coordinates()) +
                                                         "; give all of them");
  PANTIN_EXPECTS(v.size() == dynamics.velocities(), std::to_string(v.size()) + " velocities given for " +
                                                        std::to_string(dynamics.velocities()) +
                                                        "; give all of them");
}

double Dynamics::motion_error(std::span<const double>, std::span<const double>,
                              std::span<const double> q_error, std::span<const double> v_error, double h) {
  double greatest = 0;
  const auto count = [&greatest](double error) {  // what is not a number stays the greatest
    if (!(std::abs(error) <= greatest)) greatest = std::abs(error);
  };
  for (const double error : q_error) count(error);
  for (const double error : v_error) count(h * error);
  return greatest;
}

}  // namespace pantin
