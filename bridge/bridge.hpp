#pragma once
// Hands nodes of a scene to physics and takes them back, turns links into joints, plays clips, and keeps
// time. A bound node has exactly one writer (drive.hpp). At binding M_WN = X_WB * M_BN by polar
// decomposition: X_WB is the body's pose, and the residual M_BN (scale, shear, mirror) stays constant, so
// nothing of the matrix is lost; from then on M_PN = inverse(M_WP) * X_WB * M_BN.
//
// hand-over            | keeps                                   | velocity
// ---------------------|-----------------------------------------|-----------------------------------------
// Scene -> Physics     | pose                                    | the animation's, at that instant
// Physics -> Scene     | pose; link value = measured coordinate  | continuous, then led back to the clip
// reparent             | world pose; joint frames re-based       | kept
// teleport             | nothing                                 | as stated
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pantin/bridge/clock.hpp>
#include <pantin/bridge/diagnostic.hpp>
#include <pantin/bridge/drive.hpp>
#include <pantin/bridge/model.hpp>
#include <pantin/physics/collision/triangle_index.hpp>
#include <pantin/physics/deflector.hpp>
#include <pantin/physics/physics_manager.hpp>
#include <pantin/scenegraph/player.hpp>
#include <pantin/scenegraph/scene.hpp>

namespace pantin {

/// How the top of a model that carries links stands in the world.
enum class Base { Fixed, Floating };

struct InstantiateSettings {
  Base base{Base::Fixed};           ///< gives the top node of a linked model a Fixed link, or a Free one
  std::string prefix{};             ///< not empty: a node of this name above the model's top nodes
  Affine M_PM{Affine::Identity()};  ///< placement (an up-axis rotation, say); needs a prefix unless identity
};

/// The nodes that became of a model.
struct Instance {
  NodeId root{};                ///< the prefix node, else the only top node, else the parent it was put under
  std::vector<NodeId> nodes{};  ///< by position in Model::nodes
};

/// What a node brings along when it is handed over.
struct NodeBody {
  std::optional<MassProperties> mass{};  ///< in the node's axes; nothing = derived from shapes or meshes
  std::vector<Shape> shapes{};           ///< solids for deriving the mass (and, later, collision)
  std::vector<ModelMesh> meshes{};       ///< used where there are no shapes
  double joint_damping{0};               ///< of the node's link [N m s/rad] or [N s/m], >= 0
  double joint_friction{0};              ///< dry friction of each of its numbers [N m] or [N], >= 0
  JointStrength joint_strength{};        ///< what the joint bears before it breaks
};

struct HandOverSettings {
  double density{1000};  ///< for masses derived from geometry [kg/m^3], > 0
};
[[nodiscard]] std::optional<SettingsProblem> problem_with(const HandOverSettings& settings);

struct TakeBackSettings {
  double blend_time{0.25};  ///< time constant of the way back to the clip [s], >= 0; 0 = at once
};
[[nodiscard]] std::optional<SettingsProblem> problem_with(const TakeBackSettings& settings);

enum class TeleportVelocity { Keep, Zero };

/// Makes the index over the triangles of a mesh; make_fcl_triangle_index of component collision_fcl is one.
using IndexTriangles = std::function<std::shared_ptr<const TriangleIndex>(const MeshShape&)>;

struct DeflectSettings {
  SurfaceSettings surface{};
  IndexTriangles index{};  ///< what becomes a mesh needs it; without one it is an error
};

/// What deflect made: on whom, and what there is to say.
struct Deflected {
  std::vector<DeflectorId> ids{};
  std::vector<Diagnostic> notes{};
};

/// A change of drive at a time to come.
struct Toggle {
  double time{0};  ///< [s], physics time; not in the past
  NodeId node{};
  Scope scope{Scope::Subtree};
  Drive drive{Drive::Physics};  ///< Physics = hand_over, Scene = take_back
};

struct AdvanceReport {
  int updates{0};               ///< physics steps taken
  double longest_update{0};     ///< [s]; more than the clock's step where stepping is adaptive
  int inner_steps{0};           ///< that an integrator which chooses its steps took inside
  double shortest_step{0};      ///< of these [s]
  std::int64_t evaluations{0};  ///< of the derivative, in all of them
  int joint_events{0};          ///< at stops and in dry friction, in all of them
  int crowded{0};               ///< StepReport::crowded, of all of them
  double time{0};               ///< physics time reached [s]
  double dropped{0};            ///< elapsed time thrown away by the cap on updates [s]
  StepReport last{};  ///< of the last step; not ok = the advance stopped there, scene untouched by it
  std::vector<PlayedEvent> events{};  ///< of clips, passed since the last advance
  std::vector<Diagnostic> notes{};    ///< of toggles that fell due, and of nodes that could not be written
};

/// Scene and physics must outlive the bridge; the bodies it made leave physics with it. Verbs that return
/// notes did nothing where one of them is an error. While nodes are bound, the hierarchy is changed through
/// the bridge (reparent, remove); nodes that were removed from the scene directly lose their bodies at the
/// next verb or advance.
class Bridge {
 public:
  Bridge(Scene& scene, PhysicsManager& physics, ClockSettings clock = {});
  ~Bridge();
  Bridge(const Bridge&) = delete;
  Bridge& operator=(const Bridge&) = delete;

  // Models and animation
  /// Makes nodes of a model under `parent`; remembers masses, shapes and meshes per node.
  Instance instantiate(const Model& model, NodeId parent, const InstantiateSettings& settings = {});
  /// What a node brings along; a bound node, or the body that carries it, is weighed anew.
  void set_node_body(NodeId id, NodeBody body);
  [[nodiscard]] const NodeBody* node_body(NodeId id) const;  ///< nullptr where nothing is known
  /// Plays a clip from the present physics time on: settings.begin and the times of weight and warp are
  /// relative to it. Its nodes, and animated bodies with what hangs on them, are there at once. Null targets
  /// are left out. A node that another clip has to itself (Override on the same layer, both with the weight
  /// 1) is an error; with other layers or weights clips are blended (player.hpp).
  /// Links that mimic one whose value the clip moves follow.
  std::vector<Diagnostic> play(const Clip& clip, std::vector<NodeId> targets, PlayerSettings settings = {});
  void stop_playing(NodeId id);  ///< removes the node from its clips; it stays where it is
  void stop_playing(PlayId id);  ///< nodes that nothing else plays on stay where they are
  [[nodiscard]] bool is_played(NodeId id) const;
  void set_weight(PlayId id, const Curve& weight);  ///< times are relative to now
  /// `begin` is relative to now.
  void cross_fade(PlayId from, PlayId to, CrossFadeSettings settings = {});
  /// What plays on which nodes, at physics time.
  [[nodiscard]] const Player& player() const noexcept;

  // Verbs
  /// Nodes -> bodies, links -> joints, with the pose and velocity that the nodes have now. A node with a link
  /// is joined to the nearest bound node above; if there is none, to the world, or to its parent if that is
  /// played. Subtree takes the node and all below it that declare mass or have a link that moves; what
  /// follows them rigidly lends them its mass. Limits of links are stops without bounce; where a link starts
  /// beyond one, the stop is where it stands until it has moved back. A link that mimics another is geared to
  /// it exactly while both are simulated, whichever came first: each moves the other. An animated link that
  /// mimics a simulated one follows it, its body one advance later; a simulated one that mimics an animated
  /// one moves on its own, which is said. A gear that cannot be met is left out, which is said too. A joint
  /// that breaks (NodeBody::joint_strength) is gone until its node is taken back and handed over again.
  std::vector<Diagnostic> hand_over(NodeId id, Scope scope = Scope::Node,
                                    const HandOverSettings& settings = {});
  /// Simulated nodes are animated again. One that a clip moves, or moves with, is led back to it from where
  /// it is and as it moves; any other one stays exactly where it is, at rest.
  std::vector<Diagnostic> take_back(NodeId id, Scope scope = Scope::Node,
                                    const TakeBackSettings& settings = {});
  /// Binds with drive Scene: a trajectory in the world, or a driven joint to the nearest simulated node
  /// above. What the user moves between two advances moves evenly during the updates of the second.
  std::vector<Diagnostic> follow(NodeId id, Scope scope = Scope::Node);
  std::vector<Diagnostic> fix(NodeId id, Scope scope = Scope::Node);  ///< binds with drive Static
  void release(NodeId id, Scope scope = Scope::Node);  ///< removes body and joint, keeps the node
  /// Turns particles back at the node's shapes, or its meshes where it has none, and at those of unbound
  /// nodes that follow it. The deflectors are fixed to the body of the node or of the nearest bound node
  /// above, of any drive, and go with it; where none is bound, to the world as the node stands now. Scale,
  /// shear and mirror are baked in: a box that is sheared becomes a mesh. Balls and capsules that are
  /// stretched unevenly, cylinders, cones and ellipsoids have no deflector and are errors.
  Deflected deflect(NodeId id, const DeflectSettings& settings = {});
  /// Moves a bound or unbound node to a world matrix at once; the history is reset, also in a frame with no
  /// update. What hangs on a body by joints goes along, below an unbound node all bodies do. The residual of
  /// a body must fit: an error names the node.
  std::vector<Diagnostic> teleport(NodeId id, const Affine& M_WN,
                                   TeleportVelocity velocity = TeleportVelocity::Zero);
  /// Moves the node under another parent, keeping its world matrix; link and joint frames are re-based.
  std::vector<Diagnostic> reparent(NodeId id, NodeId parent);
  /// Removes the node and all below it: joints first, then bodies, then nodes.
  void remove(NodeId id);
  /// Sets a local matrix of a node that physics does not own; naming one that it owns breaks the contract
  /// (teleport). A static node is teleported.
  void set_local(NodeId id, const Affine& M_PN);
  /// Sets a link's value: by the joint if the node is simulated, else by the local matrix. Links of the same
  /// model that mimic it follow, also over several links; one that is set itself stays so until its leader is
  /// set, unless both are simulated: then its leader follows it. A value that the joint's loop cannot take is
  /// an error that names the joint and changes nothing.
  std::vector<Diagnostic> set_link_value(NodeId id, const LinkValue& value);

  /// Whether joints made from now on leave out limits and dry friction of links. Off unless set.
  void leave_joints_free(bool free);

  // Look-up
  [[nodiscard]] std::optional<Drive> drive_of(NodeId id) const;  ///< nothing for a node without a body
  [[nodiscard]] BodyId body_of(NodeId id) const;                 ///< null if it has none
  [[nodiscard]] JointId joint_of(NodeId id) const;  ///< joint to what carries it; null if it has none
  [[nodiscard]] NodeId node_of(BodyId id) const;    ///< null for a body the bridge did not make
  [[nodiscard]] std::vector<NodeId> bound() const;  ///< all bound nodes, parents first
  /// The residual M_BN of a bound node; constant unless a clip stretches it.
  [[nodiscard]] Affine residual(NodeId id) const;

  // Time
  /// Adds elapsed time [s] >= 0 and takes the updates that fall due; the rest is carried over. Players are
  /// sampled at physics time. User forces act on every update of the call and are then cleared.
  AdvanceReport advance(double elapsed);
  /// As many updates as it takes to land on `time` exactly, the last one shortened; no cap.
  AdvanceReport advance_until(double time);
  /// An update will end exactly at that time, and the verb is called then.
  void schedule(const Toggle& toggle);
  [[nodiscard]] double time() const noexcept;  ///< physics time [s]
  [[nodiscard]] const Clock& clock() const noexcept;
  void set_step(double step);  ///< [s], > 0
  void set_stepping(Stepping stepping);
  /// Writes the matrices of all simulated nodes from their bodies; done by advance. Idempotent.
  void sync_out();
  /// World matrix between the last two body poses, alpha in [0, 1] (clock().rest() / step); never stored.
  [[nodiscard]] Affine presented(NodeId id, double alpha) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pantin
