#pragma once
// The list of couplings between joints: ids, and which joints they tie. Order is that of adding; it decides
// the layout, and with it the bits of the result.
#include <span>
#include <vector>

#include <pantin/physics/constraints/gear.hpp>

namespace pantin {

class Couplings {
 public:
  CouplingId add(GearSettings settings);
  void remove(CouplingId id);
  void remove_of(JointId joint);  ///< all that this joint takes part in
  [[nodiscard]] bool contains(CouplingId id) const noexcept;
  [[nodiscard]] std::size_t at(CouplingId id) const;  ///< position of a living coupling
  [[nodiscard]] std::size_t size() const noexcept { return settings_.size(); }
  [[nodiscard]] const GearSettings& operator[](std::size_t k) const { return settings_[k]; }
  [[nodiscard]] const std::vector<CouplingId>& ids() const noexcept { return ids_; }
  [[nodiscard]] bool has(JointId joint) const noexcept;  ///< whether some coupling ties this joint

 private:
  std::vector<GearSettings> settings_{};
  std::vector<CouplingId> ids_{};
  std::vector<std::uint32_t> generation_{};  ///< by CouplingId::index
  std::vector<std::uint32_t> free_{};
};

}  // namespace pantin
