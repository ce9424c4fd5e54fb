#pragma once
// The chains and the top in Pinocchio: forward dynamics by its articulated-body algorithm and nothing else.
// The only header behind which Pinocchio's templates are compiled.
#include <memory>
#include <string>

#include "bench/chain.hpp"
#include "contender.hpp"

namespace pantin::bench {

class PinocchioModel {
 public:
  /// Coordinates and rates: the angles of the pivots.
  explicit PinocchioModel(const Chain& chain);
  /// A free-flyer. Coordinates: position, quaternion (x, y, z, w); rates in axes of the body, linear first.
  explicit PinocchioModel(const Top& top);
  ~PinocchioModel();

  /// v' at (q, v), no forces but gravity; stays until the next call.
  [[nodiscard]] const double* acceleration(const double* q, const double* v);
  /// Centres of gravity of a chain [m].
  [[nodiscard]] std::vector<Point> centres(const double* q);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

[[nodiscard]] std::string pinocchio_version();

}  // namespace pantin::bench
