#pragma once
// Private to bridge. What a Bridge consists of. Each verb changes drives and bindings, then calls
// `reconcile`, which gives every body below the change the kind, joint, mass and trajectory that follow from
// them.
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include <pantin/bridge/binding.hpp>
#include <pantin/bridge/bridge.hpp>
#include <pantin/bridge/derive_mass.hpp>
#include <pantin/bridge/mimic.hpp>
#include <pantin/bridge/polar.hpp>

namespace pantin {

struct Bridge::Impl {
  Impl(Scene& its_scene, PhysicsManager& its_physics, ClockSettings settings);
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  Scene& scene;
  PhysicsManager& physics;
  Clock clock;
  Player player{};                       ///< of all clips
  std::unordered_set<NodeId> leaving{};  ///< being taken out of the player, which trajectories still ask
  std::vector<PlayedEvent> passed{};     ///< since the last advance
  std::unordered_set<NodeId> fast{};     ///< whose fast motion was told of
  std::unordered_map<NodeId, NodeBody> node_bodies{};
  Followers followers{};                           ///< links that mimic others of their model
  std::unordered_map<NodeId, CouplingId> gears{};  ///< of simulated followers, to simulated leaders
  std::unordered_map<NodeId, std::unique_ptr<Binding>> bindings{};
  std::unordered_map<BodyId, Binding*> by_body{};
  std::vector<Toggle> toggles{};      ///< by time
  bool free_joints{false};            ///< without limits and dry friction
  std::vector<Binding*> automatic{};  ///< bound by the bridge to carry somebody's joint
  std::vector<Binding*> sharing{};    ///< whose mass is carried by another body, or that carry another's
  /// Local matrices that nobody but the user writes and that animated bodies depend on, as last seen.
  std::unordered_map<NodeId, Affine> watched{};

  // Look-up (bridge.cpp)
  void expect_alive(NodeId id, const char* verb) const;
  [[nodiscard]] Binding* find(NodeId id) const;
  /// Whether a clip moves it.
  [[nodiscard]] bool is_played(NodeId id) const { return player.animates(id) && !leaving.contains(id); }
  /// The nearest bound node above; null if there is none.
  [[nodiscard]] Binding* bound_above(NodeId id) const;
  [[nodiscard]] NodeId bound_node_above(NodeId id) const;
  /// All bindings, parents first.
  [[nodiscard]] const std::vector<Binding*>& ordered();
  void order_is_stale() noexcept { order_is_stale_ = true; }
  /// Bindings at or below these nodes, parents first.
  [[nodiscard]] std::vector<Binding*> below(std::span<const NodeId> tops) const;
  [[nodiscard]] Diagnostic note(Severity severity, NodeId id, std::string problem, std::string remedy) const;
  /// Motion of the body origin now, accelerations left out.
  [[nodiscard]] RigidMotion motion_of(const Binding& binding) const;
  [[nodiscard]] bool is_played_between(NodeId from, const Binding* above) const;

  // Binding (bind.cpp)
  /// The body that bind would make.
  [[nodiscard]] RigidBodySettings body_settings(NodeId id, Drive drive, const Polar& at,
                                                const RigidMotion& motion, const MassProperties& mass) const;
  Binding& bind(NodeId id, Drive drive, const Polar& at, const RigidMotion& motion,
                const MassProperties& mass);
  void unbind(Binding& binding);
  void forget_vanished();

  // Trajectories of animated nodes (trajectories.cpp)
  void build_chain(Binding& binding) const;
  /// Parts from the node below `above` (null: from the root) down to `id`.
  [[nodiscard]] std::vector<ChainPart> chain_to(NodeId id, const Binding* above) const;
  /// Motion of any node in the world now, as it was animated up to now.
  [[nodiscard]] SplitMotion world_motion(NodeId id) const;
  void start_blend(Binding& binding, const RigidMotion& X_WB, double blend_time);
  void finish_blends();
  /// A blending node has another parent: the way back begins again, from its present motion.
  void blend_anew(Binding& binding, const RigidMotion& X_WB);
  void rebake_residuals();
  void watch(const Binding& binding);
  void notice_moves();
  void start_moves(double begin, double end);

  // Making physics agree with the drives (reconcile.cpp, ties.cpp)
  std::vector<Diagnostic> reconcile(std::span<const NodeId> tops);
  std::vector<Diagnostic> settle(std::span<const NodeId> tops);
  void link_up(std::span<Binding* const> affected) const;
  std::vector<NodeId> bind_carriers(std::span<Binding* const> affected);
  [[nodiscard]] Binding* idle_carrier() const;
  void drop_idle_carriers();
  [[nodiscard]] JointTie wanted_tie(const Binding& binding) const;
  void untie(Binding& binding);
  void forget_broken(std::span<const JointId> broken, std::vector<Diagnostic>& notes);
  void tie(Binding& binding, std::vector<Diagnostic>& notes);
  void tie_by_link(Binding& binding, std::vector<Diagnostic>& notes);
  void change_kind(Binding& binding);
  [[nodiscard]] Pose trajectory_pose(const Binding& binding) const;
  void jump_to_trajectory(Binding& binding);
  void tell_turns(std::span<Binding* const> affected, std::vector<Diagnostic>& notes);
  /// An error about a value of its joint that its loop cannot take.
  [[nodiscard]] Diagnostic not_allowed(const Binding& binding) const;
  void remember_written(Binding& binding) const;
  void hold_player(const Binding& binding);

  // Simulated links that mimic simulated ones (mimic_gears.cpp)
  /// Makes the couplings agree with who is simulated.
  void couple(std::vector<Diagnostic>& notes);
  [[nodiscard]] bool is_held_by_gear(NodeId follower) const;
  [[nodiscard]] bool has_link_joint(NodeId id) const;
  /// The gear of a simulated follower to the nearest simulated one of those that lead it, over animated links
  /// that follow; a null if there is none.
  [[nodiscard]] GearSettings wanted_gear(const Binding& follower,
                                         const std::unordered_map<NodeId, Follower>& leaders) const;
  void drop_gears(const std::unordered_map<NodeId, GearSettings>& wanted, std::vector<Diagnostic>& notes);
  void note_distance(NodeId follower, const GearSettings& gear, std::vector<Diagnostic>& notes) const;
  /// Takes away those of new gears that cannot be met.
  void leave_out_unmet(std::vector<NodeId> added, std::vector<Diagnostic>& notes);
  [[nodiscard]] Diagnostic note_on_joint(NodeId follower, std::string problem, std::string remedy) const;

  // Masses (weigh.cpp)
  [[nodiscard]] DerivedMass weigh(NodeId id, const Affine& M_BN, double density,
                                  const std::unordered_set<NodeId>* also_bound = nullptr) const;
  /// Derives the mass of a binding afresh: what is bound below it has changed.
  void reweigh(Binding* binding);
  [[nodiscard]] Binding& composite_top(Binding& binding) const;
  void assign_masses(std::span<Binding* const> affected, std::vector<Diagnostic>& notes);
  void assign_composite(Binding& top, std::vector<Diagnostic>& notes);
  void set_mass(Binding& binding, const MassProperties& mass);

  // Verbs (hand_over.cpp, take_back.cpp, teleport.cpp, edit_tree.cpp)
  class HandOver;
  class Teleport;
  /// Which nodes a verb binds: the node, and with Subtree what declares mass or carries a moving link below
  /// it.
  [[nodiscard]] std::vector<NodeId> selected(NodeId id, Scope scope) const;
  [[nodiscard]] std::vector<Binding*> bound_in(NodeId id, Scope scope) const;
  [[nodiscard]] std::vector<NodeId> bindable(NodeId id, Scope scope, Drive drive,
                                             std::vector<Diagnostic>& notes) const;
  void bind_new(NodeId node, Drive drive, const std::unordered_set<NodeId>& all,
                std::vector<Diagnostic>& notes);
  std::vector<Diagnostic> bind_to_scene(NodeId id, Scope scope, Drive drive);
  /// `tops`: all that the verb has changed, `taken` among them.
  std::vector<Diagnostic> stop_simulating(std::span<Binding* const> taken, Drive drive, double blend_time,
                                          std::span<const NodeId> tops);
  /// Lets physics see a trajectory whose pose goes on but whose velocity has changed.
  void announce(Binding& binding);
  void note_link_value(const Binding& binding);
  /// Sets a link, if there is one, without its effect on the matrix.
  void replace_link(NodeId id, const std::optional<Link>& link, const Affine& M_PN);
  void refuse_statics_under(NodeId parent, NodeId id, std::vector<Diagnostic>& notes) const;
  [[nodiscard]] std::optional<Link> rebased_link(NodeId id, NodeId parent,
                                                 std::vector<Diagnostic>& notes) const;
  void let_player_in(std::span<const NodeId> nodes);
  void take_out(std::span<const NodeId> nodes);
  void change_plays(std::span<const PlayId> plays, const std::function<void(Player&)>& change);
  /// A play that leaves nothing of this node to another one with these settings; null if there is none.
  [[nodiscard]] PlayId rival(NodeId node, const PlayerSettings& settings) const;

  // Writing (sync.cpp)
  [[nodiscard]] Affine parent_world(const Binding& binding) const;
  /// Of a node that the bridge does not write.
  [[nodiscard]] Affine world_of(const Binding& binding) const;
  /// Whether some node above is written by the bridge, as far as is known above.
  [[nodiscard]] static bool is_below_written(const Binding& binding);
  void sync_out(std::vector<Diagnostic>* notes);
  void write_scene(std::vector<Diagnostic>* notes);
  void lead_followers();
  void play_on();

  /// Sets what follows a link of this value, but for those that move by themselves and what follows them.
  void set_followers(NodeId leader, double value, const std::unordered_set<NodeId>& except,
                     std::vector<Diagnostic>& notes);
  /// Of one link, whatever follows it.
  std::vector<Diagnostic> set_link_value(NodeId id, const LinkValue& value);

  // Time (advance.cpp)
  void meet_physics_time();
  AdvanceReport run_due();
  [[nodiscard]] std::optional<double> next_update() const;
  [[nodiscard]] bool toggle_is_due() const;
  void tell_of_fast_motion(const StepReport& report, std::vector<Diagnostic>& notes);
  void fire_toggles(std::vector<Diagnostic>& notes);

  Bridge* self{nullptr};  ///< for toggles

 private:
  std::vector<Binding*> ordered_{};
  bool order_is_stale_{true};
};

}  // namespace pantin
