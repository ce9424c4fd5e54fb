#pragma once
// What a kind of deflector is made of: where a moving ball first meets it, and which of many it cannot meet.
// Solids say their distance and inherit the rest. Frame D throughout; a particle is a ball of its system's
// radius, or a point.
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <pantin/physics/deflectors/deflector_motion.hpp>

namespace pantin {

/// Where a path first meets a surface.
struct SurfaceContact {
  double s{0};                         ///< fraction of the update
  Vector3 normal_D{Vector3::UnitZ()};  ///< outward, towards the particle
  double depth{0};                     ///< by which the particle is inside already [m]; 0 on the way in
};

/// Lists of triangles, reused from particle to particle.
using TriangleList = std::vector<std::uint32_t>;

/// Many particles' straight ways from begin to end of an update. `gap` takes the least margin over all
/// deflectors: not above zero = the way may meet one.
struct CullBatch {
  std::span<const double> x0{}, y0{}, z0{}, x1{}, y1{}, z1{};  ///< [m]
  std::span<const double> inverse_length2{};                   ///< 1 / |p1 - p0|^2, or 0
  std::span<const double> margin{};                            ///< radius and sagitta of the way [m]
  std::span<double> gap{};
  std::span<double> scratch{};  ///< as many numbers, with any content
};

class SolidShape;

class DeflectorShape {
 public:
  virtual ~DeflectorShape() = default;

  [[nodiscard]] virtual std::string_view kind() const = 0;
  /// Of a ball about D's origin that holds it [m]; infinite for a plane.
  [[nodiscard]] virtual double bounding_radius() const = 0;
  /// The first contact of a ball that comes nearer, at s in [from, 1].
  [[nodiscard]] virtual std::optional<SurfaceContact> first_contact(const RelativePath& path, double from,
                                                                    double radius,
                                                                    TriangleList& scratch) const = 0;
  /// Itself where it is a convex solid: what slides along it cannot meet it again.
  [[nodiscard]] virtual const SolidShape* as_solid() const { return nullptr; }
  /// Lowers the gaps of a batch; by the bounding ball unless a shape knows better.
  virtual void cull(const DeflectorMotion& motion, const CullBatch& batch) const;
};

/// A convex solid given by its signed distance: swept by conservative advancement (B. Mirtich, Impulse-based
/// Dynamic Simulation, 1996, ch. 2), with the bound that convexity gives.
class SolidShape : public DeflectorShape {
 public:
  /// Signed distance to the surface [m], negative inside, and the outward unit normal.
  [[nodiscard]] virtual double distance(const Vector3& p_D, Vector3& normal_D) const = 0;

  [[nodiscard]] std::optional<SurfaceContact> first_contact(const RelativePath& path, double from,
                                                            double radius, TriangleList& scratch) const final;
  [[nodiscard]] const SolidShape* as_solid() const final { return this; }
};

}  // namespace pantin
