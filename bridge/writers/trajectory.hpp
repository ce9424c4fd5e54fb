#pragma once
// What a run looks like at one time, taken from a bridge, and who receives it. Only bound nodes have a body
// and are listed; a node that is handed over later appears from then on.
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <pantin/bridge/bridge.hpp>
#include <pantin/bridge/diagnostic.hpp>
#include <pantin/bridge/drive.hpp>
#include <pantin/bridge/writers/link_keys.hpp>
#include <pantin/bridge/writers/run_summary.hpp>

namespace pantin {

/// A bound node and its body; all in world axes.
struct BodySample {
  std::string path{};
  Drive drive{Drive::Physics};
  Vector3 p_WB{Vector3::Zero()};    ///< origin [m]
  Vector3 p_WBcm{Vector3::Zero()};  ///< centre of gravity [m]
  Quaternion q_WB{Quaternion::Identity()};
  Vector3 v_WBcm{Vector3::Zero()};  ///< velocity of the centre of gravity [m/s]
  Vector3 w_WB{Vector3::Zero()};    ///< angular velocity [rad/s]
};

/// A joint that has coordinates (not fixed, not driven); units as PhysicsManager::joint_value.
struct JointSample {
  std::string name{};   ///< LinkKeys::key of the node that it carries
  std::size_t body{0};  ///< position of that node in Sample::bodies
  JointNumbers value{};
  JointNumbers rate{};
};

struct Sample {
  double t{0};                        ///< physics time [s]
  std::vector<BodySample> bodies{};   ///< parents before children
  std::vector<JointSample> joints{};  ///< in the order of their bodies
  Energy energy{};                    ///< of all simulated bodies
};

/// Takes samples of a running bridge. The three must outlive it; links and names are taken to stay what they
/// are.
class TrajectoryRecorder {
 public:
  TrajectoryRecorder(const Scene& scene, const PhysicsManager& physics, const Bridge& bridge);

  /// The present state; valid until the next call.
  const Sample& record();

 private:
  struct Names {
    std::string path{};
    std::string link_key{};
  };
  void name_new(std::span<const NodeId> bound);

  const Scene& scene_;
  const PhysicsManager& physics_;
  const Bridge& bridge_;
  LinkKeys keys_;
  std::unordered_map<NodeId, Names> names_{};
  Sample sample_{};
};

/// Receives a run sample by sample.
class TrajectoryWriter {
 public:
  virtual ~TrajectoryWriter() = default;
  virtual void write(const Sample& sample) = 0;
  /// The run is over, well or not: nothing is written afterwards.
  virtual void finish(const RunSummary& summary, const std::vector<Diagnostic>& ledger) = 0;
};

}  // namespace pantin
