#pragma once
// Integrators around Pinocchio's forward dynamics: RK4 at fixed steps, doubled in number from one setting to
// the next, and two of boost odeint's adaptive methods, Dormand-Prince 5 and Fehlberg 7(8), at tolerances 1
// to 1e-14, relative and absolute, a decade apart. Work space is made once.
#include <memory>

#include "bench/chain.hpp"
#include "contender.hpp"

namespace pantin::bench {

[[nodiscard]] std::unique_ptr<Contender> make_pinocchio_rk4(const Chain& chain);
[[nodiscard]] std::unique_ptr<Contender> make_pinocchio_dormand_prince(const Chain& chain);
[[nodiscard]] std::unique_ptr<Contender> make_pinocchio_fehlberg(const Chain& chain);
[[nodiscard]] std::unique_ptr<Contender> make_pinocchio_fehlberg(const Top& top);

}  // namespace pantin::bench
