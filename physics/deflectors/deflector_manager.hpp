#pragma once
// Owns the deflectors and has one verb: to carry particles past them. What particles give to the bodies that
// deflectors stand on becomes impulses on those bodies at the end of the same step.
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <pantin/physics/body_store.hpp>
#include <pantin/physics/deflector.hpp>
#include <pantin/physics/deflectors/deflector_shape.hpp>

namespace pantin {

/// A body under deflectors, during one update: what it weighs, and what particles have changed of its
/// velocity.
struct StruckBody {
  std::uint32_t body{0};  ///< position
  double inverse_mass{0};
  Matrix3 inverse_inertia_W{Matrix3::Zero()};
  Vector3 dv{Vector3::Zero()}, dw{Vector3::Zero()};
};

struct Deflector {
  DeflectorId id{};
  DeflectorMount on{};
  SurfaceSettings surface{};
  std::unique_ptr<DeflectorShape> shape{};
  DeflectorMotion motion{};  ///< over the update, or a part of it
  DeflectorMotion whole{};   ///< over the update
  std::int32_t struck{-1};   ///< position in the list of struck bodies, where it is on a simulated body
  std::uint64_t hits{0};     ///< of the last step
};

class DeflectorManager {
 public:
  explicit DeflectorManager(BodyStore& bodies) : bodies_{bodies} {}

  /// Adds a deflector from its settings, e.g. add(PlaneDeflector{.surface = {.restitution = 0.3}}). Settings
  /// with a problem, or a body that does not live, break the contract.
  template <class Settings>
  DeflectorId add(const Settings& settings) {
    check(problem_with(settings));
    return add(settings.on, settings.surface, make_shape(settings));
  }
  /// The same with a shape of your own. Not null.
  DeflectorId add(const DeflectorMount& on, const SurfaceSettings& surface,
                  std::unique_ptr<DeflectorShape> shape);
  void remove(DeflectorId id);
  void remove_deflectors_of(BodyId body);
  [[nodiscard]] bool contains(DeflectorId id) const noexcept { return position_of(id) < size(); }
  [[nodiscard]] std::size_t size() const noexcept { return deflectors_.size(); }
  [[nodiscard]] std::vector<DeflectorId> ids() const;
  [[nodiscard]] std::vector<DeflectorId> deflectors_of(BodyId body) const;

  void set_surface(DeflectorId id, const SurfaceSettings& surface);
  [[nodiscard]] const SurfaceSettings& surface(DeflectorId id) const { return at(id).surface; }
  [[nodiscard]] const DeflectorMount& mount(DeflectorId id) const { return at(id).on; }
  [[nodiscard]] std::string_view kind(DeflectorId id) const { return at(id).shape->kind(); }
  /// How often particles were turned back by it in the last step.
  [[nodiscard]] std::uint64_t hits(DeflectorId id) const { return at(id).hits; }

  // The parts of an update, for the manager of particles.
  void forget_hits();
  void begin();        ///< before the bodies move
  void end(double h);  ///< after they have moved for h [s]
  void narrow(double s0,
              double s1);  ///< motions run over this part of the update from now on; (0, 1) = all of it
  [[nodiscard]] std::span<Deflector> all() noexcept { return deflectors_; }
  [[nodiscard]] Deflector* find(DeflectorId id) noexcept;  ///< nullptr where it is gone
  [[nodiscard]] StruckBody* struck(const Deflector& deflector) noexcept;
  /// A particle got linear and angular momentum (about the world's origin) from the deflector: the body loses
  /// them.
  void react(const Deflector& deflector, const Vector3& linear, const Vector3& angular);

 private:
  static void check(const std::optional<SettingsProblem>& problem);
  [[nodiscard]] std::size_t position_of(DeflectorId id) const noexcept;
  [[nodiscard]] const Deflector& at(DeflectorId id) const;

  BodyStore& bodies_;
  std::vector<Deflector> deflectors_{};
  std::vector<BodyKinematics> before_{};
  std::vector<StruckBody> struck_{};
  std::uint32_t next_{1};
};

}  // namespace pantin
