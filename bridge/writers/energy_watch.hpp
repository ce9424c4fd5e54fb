#pragma once
// Follows the energy of a run to say how far it drifted. Handing nodes over adds or takes energy, so each
// stretch between two changes of drive is measured from its own beginning.
#include <optional>

#include <pantin/physics/physics_manager.hpp>

namespace pantin {

/// Whether nothing but potential forces and ideal joints does work on the simulated bodies: no damping or dry
/// friction, no motor (whose work is nobody's potential; springs on joints have one), and no joint to an
/// animated body or driven by one. Stops are ideal until they are hit. For a manager whose only force law is
/// gravity.
[[nodiscard]] bool conserves_energy(const PhysicsManager& physics);

/// drift = sum over the stretches of max |E(t) - E(begin)|, relative to the largest exchange seen anywhere:
/// the greatest kinetic energy or change of potential energy. 0 where nothing moved.
class EnergyWatch {
 public:
  /// Begins a stretch; `conserved` = conserves_energy during it.
  void begin(const Energy& energy, bool conserved);
  void see(const Energy& energy);

  [[nodiscard]] bool conserved() const noexcept { return conserved_; }  ///< in all stretches so far
  [[nodiscard]] std::optional<double> drift() const;                    ///< nothing if not conserved()

 private:
  Energy start_{};
  bool conserved_{true};
  double deviation_{0};   ///< of this stretch [J]
  double deviations_{0};  ///< of the ones before [J]
  double exchange_{0};    ///< [J]
};

}  // namespace pantin
