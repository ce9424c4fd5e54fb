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

}  // namespace pantin
