// What particles cost: 1,000,000 of them under gravity and drag past ten planes and spheres, beside a loop
// written by hand for just that. Interleaved in one run, minimum of several repeats, ratios.
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <vector>

#include <pantin/physics/deflectors/plane.hpp>
#include <pantin/physics/deflectors/sphere.hpp>
#include <pantin/physics/forces/gravity.hpp>
#include <pantin/physics/forces/linear_drag.hpp>
#include <pantin/physics/particles/emitter.hpp>
#include <pantin/physics/physics_manager.hpp>

#include "bench/cpu_time.hpp"

namespace pantin {
namespace {

using bench::seconds_of;

constexpr std::size_t kParticles = 1000000;
constexpr double kStep = 1.0 / 240, kMass = 1e-3, kDrag = 1e-3, kBounce = 0.6, kG = 9.81, kHalf = 5;

struct Plane {
  double nx, ny, nz, d;
};
struct Ball {
  double x, y, z, r;
};
/// A room of six walls with four balls in it.
constexpr std::array<Plane, 6> kWalls{{{1, 0, 0, -kHalf},
                                       {-1, 0, 0, -kHalf},
                                       {0, 1, 0, -kHalf},
                                       {0, -1, 0, -kHalf},
                                       {0, 0, 1, -kHalf},
                                       {0, 0, -1, -kHalf}}};
constexpr std::array<Ball, 4> kBalls{{{-2, -2, -2, 1}, {2, -2, -2, 1}, {-2, 2, -2, 1}, {2, 2, 0, 1}}};

/// The same physics without the engine: arrays, one loop, everything of a particle in registers. Straight
/// ways, first contact, mirrored velocity, then on with the rest of the step; a second contact waits for the
/// next step. Semi- implicit Euler, or velocity Verlet with the velocity predicted for the drag.
struct HandWritten {
  std::vector<double> x, y, z, vx, vy, vz;
  std::uint64_t hits{0};

  template <bool kVerlet>
  void step(double h) {
    for (std::size_t i = 0, n = x.size(); i < n; ++i) {
      const double px = x[i], py = y[i], pz = z[i];
      double ux = vx[i], uy = vy[i], uz = vz[i];
      const double k = kDrag / kMass;
      double qx, qy, qz;
      if constexpr (kVerlet) {
        const double ax = -k * ux, ay = -k * uy, az = -kG - k * uz;
        const double hx = ux + 0.5 * h * ax, hy = uy + 0.5 * h * ay, hz = uz + 0.5 * h * az;
        qx = px + h * hx, qy = py + h * hy, qz = pz + h * hz;
        double bx = -k * (ux + h * ax), by = -k * (uy + h * ay), bz = -kG - k * (uz + h * az);
        bx = -k * (hx + 0.5 * h * bx), by = -k * (hy + 0.5 * h * by), bz = -kG - k * (hz + 0.5 * h * bz);
        ux = hx + 0.5 * h * bx, uy = hy + 0.5 * h * by, uz = hz + 0.5 * h * bz;
      } else {
        ux -= h * k * ux, uy -= h * k * uy, uz -= h * (kG + k * uz);
        qx = px + h * ux, qy = py + h * uy, qz = pz + h * uz;
      }
      double first = 2, nx = 0, ny = 0, nz = 0;
      for (const Plane& w : kWalls) {
        const double from = w.nx * px + w.ny * py + w.nz * pz - w.d,
                     to = w.nx * qx + w.ny * qy + w.nz * qz - w.d;
        if (to >= 0 || from < to) continue;
        const double s = from <= 0 ? 0 : from / (from - to);
        if (s < first) first = s, nx = w.nx, ny = w.ny, nz = w.nz;
      }
      const double dx = qx - px, dy = qy - py, dz = qz - pz, a = dx * dx + dy * dy + dz * dz;
      for (const Ball& ball : kBalls) {
        const double wx = px - ball.x, wy = py - ball.y, wz = pz - ball.z;
        const double b = wx * dx + wy * dy + wz * dz, c = wx * wx + wy * wy + wz * wz - ball.r * ball.r;
        if (b >= 0) continue;
        const double disc = b * b - a * c;
        if (disc < 0) continue;
        const double s = c <= 0 ? 0 : (-b - std::sqrt(disc)) / a;
        if (s > 1 || s >= first) continue;
        first = s;
        nx = (wx + s * dx) / ball.r, ny = (wy + s * dy) / ball.r, nz = (wz + s * dz) / ball.r;
      }
      if (first <= 1) {
        ++hits;
        const double along = ux * nx + uy * ny + uz * nz;
        if (along < 0) {
          const double j = (1 + kBounce) * along;
          ux -= j * nx, uy -= j * ny, uz -= j * nz;
        }
        const double rest = (1 - first) * h;
        qx = px + first * dx + rest * ux, qy = py + first * dy + rest * uy, qz = pz + first * dz + rest * uz;
      }
      x[i] = qx, y[i] = qy, z[i] = qz;
      vx[i] = ux, vy[i] = uy, vz[i] = uz;
    }
  }
};

DeflectorMount facing(const Plane& wall) {
  const Vector3 n{wall.nx, wall.ny, wall.nz};
  return {.X_BD = {wall.d * n, Quaternion::FromTwoVectors(Vector3::UnitZ(), n)}};
}

template <bool kVerlet>
void compare(const char* integrator) {
  PhysicsManager physics;
  physics.set_integrator(make_integrator(integrator));
  physics.forces().add(Gravity{});
  physics.forces().add(LinearDrag{.coefficient = kDrag});
  for (const Plane& wall : kWalls) {
    physics.deflectors().add(PlaneDeflector{.on = facing(wall), .surface = {.restitution = kBounce}});
  }
  for (const Ball& ball : kBalls) {
    physics.deflectors().add(SphereDeflector{
        .on = {.X_BD = {{ball.x, ball.y, ball.z}}}, .radius = ball.r, .surface = {.restitution = kBounce}});
  }
  const ParticleSystemId system =
      physics.particles().add(ParticleSystemSettings{.name = "snow", .mass = kMass, .capacity = kParticles});
  // Born all over the room, in all directions; those inside of a ball are pushed out in the first step.
  EmitterSettings cloud{.region = EmitterRegion::Box,
                        .size = {9.8, 9.8, 7},
                        .speed = {0, 10},
                        .spread = 3.1,
                        .bursts = {{.time = 0, .count = kParticles}},
                        .seed = 7};
  cloud.X_BE.p = {0, 0, 1.4};
  physics.particles().add_emitter(system, cloud);
  static_cast<void>(physics.step(kStep));
  HandWritten hand;
  const ParticleSystem born = physics.particles().system(system);
  const auto copy = [](std::span<const double> a) { return std::vector<double>(a.begin(), a.end()); };
  hand.x = copy(born.x()), hand.y = copy(born.y()), hand.z = copy(born.z());
  hand.vx = copy(born.vx()), hand.vy = copy(born.vy()), hand.vz = copy(born.vz());

  double ours = std::numeric_limits<double>::infinity(), by_hand = ours, sum_ours = 0, sum_hand = 0;
  std::uint64_t hits = 0;
  constexpr int kRepeats = 60;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    StepReport report;
    const double a = seconds_of([&] { report = physics.step(kStep); });
    const double b = seconds_of([&] { hand.step<kVerlet>(kStep); });
    ours = std::min(ours, a);
    by_hand = std::min(by_hand, b);
    sum_ours += a;
    sum_hand += b;
    hits += report.particles.deflections;
  }
  const double n = kParticles;
  std::printf(
      "%s: %.1f ns a particle and step, by hand %.1f, ratio %.2f (of means %.2f); contacts %llu, by hand "
      "%llu\n",
      integrator, 1e9 * ours / n, 1e9 * by_hand / n, ours / by_hand, sum_ours / sum_hand,
      static_cast<unsigned long long>(hits), static_cast<unsigned long long>(hand.hits));
}

}  // namespace
}  // namespace pantin

int main() {
  pantin::compare<false>("semi-implicit-euler");
  pantin::compare<true>("verlet");
}
