#pragma once
// Forward dynamics of trees at several stages at once, a stage in each lane: the elimination of
// articulated.hpp with registers of doubles in the place of doubles, and nothing that branches on a value.
// The instruction set is chosen when the program runs.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/constraints/tree.hpp>
#include <pantin/physics/integrators/collocation.hpp>
#include <pantin/physics/integrators/integrator.hpp>

namespace pantin::lanes {

/// What the kernel is compiled for.
enum class InstructionSet : std::uint8_t {
  Sse2,    ///< four lanes in two registers; every x86-64 has it, other machines get plain code
  Avx2,    ///< with FMA: four lanes in one register
  Avx512,  ///< eight lanes in one register
};
[[nodiscard]] std::string_view to_string(InstructionSet set) noexcept;
/// Those this machine has, the widest last.
[[nodiscard]] std::vector<InstructionSet> instruction_sets();

/// A link's constants as the kernel reads them: plain numbers.
struct LinkConstants {
  std::int32_t parent{-1};  ///< link nearer to the root, counted from the first of all trees; -1 = ground
  std::int32_t ground{-1};  ///< number of the given motion that a root link hangs on; -1 = the world at rest
  std::int32_t given{-1};   ///< number of the given motion of a driven joint; -1 = none
  JointKind kind{JointKind::Fixed};
  bool first_child{false};  ///< of its parent, seen from the last link
  bool leaf{true};
  bool is_damped{false};  ///< damping is not all 0
  bool is_loaded{false};  ///< armature and Task::efforts count
  std::uint32_t q{0}, v{0};
  double R_PJ[9]{}, p_PJ[3]{};
  double mass{0}, moment[3]{}, inertia[6]{};  ///< as in TreeLink; xx yy zz xy xz yz
  double damping[3]{}, armature[3]{};         ///< by rate
  bool holds{false};                          ///< some rate is locked, or has a constant effort
  bool locked[6]{};                           ///< rates that stay zero, with their derivatives
  double effort[6]{};
  double pitch{0};
};

/// Motion of a ground or of a driven joint's B in A, at every stage: number k of lane l at [k * lanes + l]. R
/// (row-major), p, w, v, alpha, a: 24 numbers.
constexpr std::size_t kMotionNumbers = 24;

/// Writes a motion in one of so many lanes; `out` is where number 0 of that lane stands.
void put_motion(const RigidMotion& motion, std::size_t lanes, double* out);

/// Numbers on a boundary of 64 bytes.
class AlignedRoom {
 public:
  void resize(std::size_t count) { room_.resize(count + kSlack); }
  [[nodiscard]] double* data();

 private:
  static constexpr std::size_t kSlack = 8;
  std::vector<double> room_{};
};

/// What the kernel works on: links `begin` to `end`, one after the other, parents first.
struct Task {
  const LinkConstants* links{nullptr};
  std::uint32_t begin{0}, end{0};
  const double *q{nullptr}, *v{nullptr};  ///< of all trees: number i of stage s at [i * stages + s]
  double* v_dot{nullptr};
  std::size_t stages{0};  ///< between a number and the next
  std::size_t first{0};   ///< stage of the first lane
  double gravity[3]{};    ///< [m/s^2], uniform
  const double* motions{nullptr};
  const double* efforts{nullptr};  ///< on rates, as v
  double* work{nullptr};           ///< as much as work_size says, 64-byte aligned
};

/// A body without joints as the kernel reads it.
struct FreeConstants {
  double inverse_mass{0};
  double inverse_inertia[9]{};  ///< body axes, row-major
};

/// The rates of free bodies: coordinates are position and quaternion, velocities linear and angular momentum,
/// body after body; arrays as in Task.
struct FreeTask {
  const FreeConstants* bodies{nullptr};
  std::size_t count{0};
  const double *q{nullptr}, *v{nullptr};
  double* q_dot{nullptr};
  std::size_t stages{0};
  std::size_t first{0};
};

/// Sums over the stages of many numbers: stage i of number n becomes base[n] + h sum_j a[j][i] slopes_j.
struct StageSums {
  std::size_t stages{0};
  std::size_t count{0};         ///< of numbers
  const double* base{nullptr};  ///< null: the sum alone, without h
  double h{0};
  const double* slopes{nullptr};  ///< number n of stage j at [n * stages + j], as `out`
  const NodeMatrix* a{nullptr};   ///< by column
  double* out{nullptr};
};

struct LoopSizes;
struct LoopTask;  // loop_lanes.hpp

/// The kernel for one instruction set.
struct Kernel {
  InstructionSet set{InstructionSet::Sse2};
  int lanes{4};
  /// Numbers of work space for so many links with so many rates.
  std::size_t (*work_size)(std::size_t links, std::size_t rates){nullptr};
  /// Attitudes, angular velocities, and the bias of the motion.
  void (*outward)(const Task&){nullptr};
  /// Adds a wrench (force, and torque about the link's origin; 6 numbers at all lanes) to a link.
  void (*add_wrench)(const Task&, std::uint32_t link, const double* wrench){nullptr};
  /// Eliminates and substitutes; writes v'.
  void (*solve)(const Task&){nullptr};
  /// Where loops or couplings join links: numbers of work space for them; to be called between outward and
  /// solve; to be called after solve: what they exert, and v' with that. Returns ClosureSolver::margin.
  std::size_t (*loop_size)(const LoopSizes&){nullptr};
  void (*trace)(const Task&, const LoopTask&){nullptr};
  double (*close)(const Task&, const LoopTask&){nullptr};
  void (*free_rates)(const FreeTask&){nullptr};
  void (*sum_stages)(const StageSums&){nullptr};
};

/// The kernel for a set that this machine has.
[[nodiscard]] const Kernel& kernel_for(InstructionSet set);
/// The widest kernel of this machine whose lanes share out so many stages; null if there is none.
[[nodiscard]] const Kernel* kernel_for_stages(std::size_t stages);

/// The constants of all links and free bodies of a layout. Joints and grounds with given motion are numbered
/// from 0 in the order of the links, the ground of a link before its joint. Returns how many these are.
std::int32_t fill_constants(const TreeLayout& layout, const BodyStore& bodies,
                            std::vector<LinkConstants>& links, std::vector<FreeConstants>& free);

}  // namespace pantin::lanes
