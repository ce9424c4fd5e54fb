#pragma once
// A trajectory as CSV (RFC 4180, lines end in CR LF): one row per body and sample.
//
// | column           | meaning                                                                     |
// |------------------|-----------------------------------------------------------------------------|
// | t                | physics time [s]                                                            |
// | path, drive      | which node, and who writes it: static, animated, simulated                  |
// | px py pz         | body origin in the world [m]                                                |
// | cx cy cz         | centre of gravity in the world [m]                                          |
// | qw qx qy qz      | orientation in the world, unit quaternion                                   |
// | vx vy vz         | velocity of the centre of gravity [m/s]                                     |
// | wx wy wz         | angular velocity in world axes [rad/s]                                      |
// | joint            | name of the joint that carries the body; empty if none has coordinates      |
// | joint_value      | angle [rad], distance [m], or several numbers with spaces between them      |
// | joint_rate       | its rate                                                                    |
// | kinetic potential| energies of the whole scene at that time [J]                                |
//
// Numbers are the shortest decimals that read back to the same double, whatever the locale; "nan", "inf"
// where not finite.
#include <ostream>

#include <pantin/bridge/writers/trajectory.hpp>

namespace pantin {

/// Writes to a stream, header first. Summary and ledger have no place in it.
class TrajectoryCsv final : public TrajectoryWriter {
 public:
  explicit TrajectoryCsv(std::ostream& out);
  void write(const Sample& sample) override;
  void finish(const RunSummary& summary, const std::vector<Diagnostic>& ledger) override;

 private:
  std::ostream& out_;
  std::string row_{};
};

}  // namespace pantin
