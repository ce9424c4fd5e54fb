#pragma once
// MuJoCo's RK4 through its C interface, on models from its own XML: hinges without damping, no geometry, so
// no contacts. Settings: 16 steps a second, doubled from one to the next.
#include <memory>
#include <string>

#include "bench/chain.hpp"
#include "contender.hpp"

namespace pantin::bench {

[[nodiscard]] std::unique_ptr<Contender> make_mujoco(const Chain& chain);
[[nodiscard]] std::unique_ptr<Contender> make_mujoco(const Top& top);
[[nodiscard]] std::string mujoco_version();

}  // namespace pantin::bench
