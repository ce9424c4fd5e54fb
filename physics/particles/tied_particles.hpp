#pragma once
// The particles of one system that are tied to each other, and how they move within a substep of h:
//
//   kick     v* = v0 + h/2 a(t, q0, v0)
//   drift    q1 = q0 + h (v* + v**) / 2,   v** = v* - h W J^T l      (the ties only)
//   kick     v1 = v** + h/2 a(t + h, q1, v** + h/2 a)
//
// In the drift each tie's force is taken along the discrete gradient of its length, (d0 + d1) / (|d0| +
// |d1|), so that it does exactly the work that the tie's energy changes by (O. Gonzalez, J. Nonlinear Sci. 6,
// 449, 1996; the same, Comput. Methods Appl. Mech. Eng. 174, 165, 1999, for rigid ties): momentum, angular
// momentum and energy of the drift are kept to the tolerance of the solve. Rigid ties keep the length they
// have; springs pull with the mean of their stretches at both ends, moved towards the end where a spring is
// faster than the substep can show, and by damping. Lengths that something else has changed (a deflector) are
// put right by a shift of positions before the drift.
#include <cstdint>
#include <span>
#include <vector>

#include <pantin/physics/particles/row_system.hpp>
#include <pantin/physics/particles/ties.hpp>

namespace pantin {

struct TieSolve {
  int iterations{0};
  bool converged{true};
};

class TiedParticles {
 public:
  /// Rows of the ties whose particles are all there; `position(serial)` gives places, `count` where there is
  /// none.
  template <class Position>
  void build(std::span<const Tie> ties, std::span<const double> inverse_mass, const Position& position) {
    rows_.clear();
    for (const Tie& tie : ties) {
      std::uint32_t at[4]{};
      bool all = true;
      for (int k = 0; k < tie.particles; ++k) {
        const std::size_t i = position(tie.serial[k]);
        all = all && i < inverse_mass.size();
        at[k] = static_cast<std::uint32_t>(i);
      }
      if (all) add_rows(tie, at);
    }
    finish(inverse_mass);
  }
  [[nodiscard]] std::size_t rows() const noexcept { return rows_.size(); }

  /// Puts lengths of rigid ties right where they are off by more than the tolerance; velocities stay.
  TieSolve correct(std::span<Vector3> q);
  /// The drift: `q1` and `v` hold q0 + h v and v of particles without inverse mass, which move as they are
  /// told; of all others q1 is found and v becomes v**.
  TieSolve drift(double h, std::span<const Vector3> q0, std::span<Vector3> q1, std::span<Vector3> v);
  /// Impulse that ties gave to a particle in the last drift [N s].
  [[nodiscard]] Vector3 impulse_on(std::size_t particle) const { return impulse_[particle]; }
  /// Greatest relative error of the lengths of rigid ties.
  [[nodiscard]] double error(std::span<const Vector3> q) const;
  /// Potential energy of ties with compliance [J].
  [[nodiscard]] double energy(std::span<const Vector3> q) const;

 private:
  void add_rows(const Tie& tie, const std::uint32_t* at);
  void finish(std::span<const double> inverse_mass);
  [[nodiscard]] static Vector3 span_of(const TieRow& row, std::span<const Vector3> q);
  [[nodiscard]] static double value(const TieRow& row, const Vector3& d);
  void shift(double factor, std::span<const double> lambda, std::span<Vector3> q) const;

  std::vector<TieRow> rows_{};
  std::vector<double> inverse_mass_{};
  std::vector<Vector3> d0_{}, impulse_{}, free_{};
  std::vector<double> c0_{}, lambda_{}, delta_{}, residual_{}, softness_{}, past_{};
  RowSystem system_{};
};

}  // namespace pantin
