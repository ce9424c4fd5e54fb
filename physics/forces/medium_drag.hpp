#pragma once
// Drag of a medium that moves with velocity u: F = -(c + d |v - u|) (v - u). Private to the force laws.
#include <cmath>
#include <span>

#include <pantin/physics/bodies_at.hpp>
#include <pantin/physics/particles/particles_at.hpp>

namespace pantin {

struct MediumDrag {
  double linear{0};     ///< c [N s/m]
  double quadratic{0};  ///< d [N s^2/m^2]

  [[nodiscard]] Vector3 force(const Vector3& relative) const {
    return -(linear + quadratic * relative.norm()) * relative;
  }

  [[nodiscard]] Matrix3 derivative(const Vector3& relative) const {
    const double speed = relative.norm();
    if (speed == 0) return -linear * Matrix3::Identity();
    return -(linear + quadratic * speed) * Matrix3::Identity() -
           quadratic / speed * relative * relative.transpose();
  }

  void add(const ParticlesAt& at, const Vector3& u, const ParticleForces& forces) const {
    const double c = linear, d = quadratic, ux = u.x(), uy = u.y(), uz = u.z();
    const double *vx = at.vx.data(), *vy = at.vy.data(), *vz = at.vz.data();
    double *fx = forces.x.data(), *fy = forces.y.data(), *fz = forces.z.data();
    for (std::size_t i = 0, n = at.size(); i < n; ++i) {
      const double x = vx[i] - ux, y = vy[i] - uy, z = vz[i] - uz;
      const double k = c + d * std::sqrt(x * x + y * y + z * z);
      fx[i] -= k * x;
      fy[i] -= k * y;
      fz[i] -= k * z;
    }
  }
};

}  // namespace pantin
