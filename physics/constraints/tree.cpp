#include <pantin/physics/constraints/tree.hpp>

#include <algorithm>

#include <pantin/physics/constraints/closure.hpp>
#include <pantin/physics/constraints/joint_models.hpp>
#include <pantin/physics/constraints/spanning_tree.hpp>

namespace pantin {

namespace {

/// One joint as seen from one of its bodies.
struct Edge {
  std::int32_t joint{-1};
  std::int32_t other{-1};  ///< body position; -1 = the world
  bool to_b{false};        ///< leads from a to b
};

/// Grows the trees body by body, parents first.
class Builder {
 public:
  Builder(const BodyStore& bodies, std::span<const JointDefinition* const> joints,
          std::span<const JointCoupling> couplings)
      : bodies_{bodies},
        joints_{joints},
        couplings_{couplings},
        spanning_{span_trees(bodies, joints, couplings)} {
    layout_.link_of_body.assign(bodies.size(), -1);
    layout_.link_of_joint.assign(joints.size(), -1);
    layout_.closure_of_joint.assign(joints.size(), -1);
    layout_.closure_of_coupling.assign(couplings.size(), -1);
    is_b_.assign(bodies.size(), false);
    collect_edges();
  }

  TreeLayout build() {
    std::vector<bool> is_built(static_cast<std::size_t>(spanning_.mechanisms), false);
    for (const auto& [body, edge] : grounded_) {
      const std::int32_t mechanism = spanning_.mechanism[static_cast<std::size_t>(body)];
      if (mechanism < 0) {
        begin_tree();
        grow_from_ground(body, edge);
        end_tree();
      } else if (!is_built[static_cast<std::size_t>(mechanism)]) {
        is_built[static_cast<std::size_t>(mechanism)] = true;
        build_mechanism(mechanism);
      }
    }
    // Floating trees: from a body that no joint carries, else (never in a tree) from the first.
    for (const bool wanted : {false, true}) {
      for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (bodies_.kinds[i] != BodyKind::Simulated || layout_.link_of_body[i] >= 0 || is_b_[i] != wanted)
          continue;
        if (degree(i) == 0) {
          layout_.free_bodies.push_back(static_cast<std::uint32_t>(i));
        } else {
          build_floating(static_cast<std::uint32_t>(i));
        }
      }
    }
    std::sort(layout_.free_bodies.begin(), layout_.free_bodies.end());
    if (spanning_.has_loops()) add_closures(layout_, bodies_, joints_, couplings_, spanning_.is_cut);
    return std::move(layout_);
  }

 private:
  [[nodiscard]] std::int32_t position(BodyId id) const {
    return id ? static_cast<std::int32_t>(bodies_.at(id)) : -1;
  }
  [[nodiscard]] bool is_simulated(std::int32_t i) const {
    return i >= 0 && bodies_.kinds[static_cast<std::size_t>(i)] == BodyKind::Simulated;
  }
  [[nodiscard]] std::size_t degree(std::size_t i) const { return first_edge_[i + 1] - first_edge_[i]; }

  void collect_edges() {
    std::vector<std::pair<std::int32_t, Edge>> list;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      if (spanning_.is_cut[j] != 0) continue;
      const std::int32_t a = position(joints_[j]->a), b = position(joints_[j]->b);
      const auto joint = static_cast<std::int32_t>(j);
      const Edge forward{joint, b, true}, backward{joint, a, false};
      if (is_simulated(a) && is_simulated(b)) {
        list.emplace_back(a, forward);
        list.emplace_back(b, backward);
        is_b_[static_cast<std::size_t>(b)] = true;
      } else if (is_simulated(b)) {
        grounded_.emplace_back(b, Edge{joint, a, true});
        list.emplace_back(b, backward);
      } else if (is_simulated(a)) {
        grounded_.emplace_back(a, Edge{joint, b, false});
        list.emplace_back(a, forward);
      }
    }
    std::stable_sort(list.begin(), list.end(),
                     [](const auto& x, const auto& y) { return x.first < y.first; });
    first_edge_.assign(bodies_.size() + 1, 0);
    for (const auto& [body, edge] : list) ++first_edge_[static_cast<std::size_t>(body) + 1];
    for (std::size_t i = 0; i < bodies_.size(); ++i) first_edge_[i + 1] += first_edge_[i];
    edges_.reserve(list.size());
    for (const auto& entry : list) edges_.push_back(entry.second);
  }

  void begin_tree() {
    Tree tree;
    tree.links_begin = static_cast<std::uint32_t>(layout_.links.size());
    tree.q_begin = layout_.coordinates;
    tree.v_begin = layout_.rates;
    layout_.trees.push_back(tree);
  }

  void end_tree() {
    finish_members();
    Tree& tree = layout_.trees.back();
    tree.links_end = static_cast<std::uint32_t>(layout_.links.size());
    tree.q_end = layout_.coordinates;
    tree.v_end = layout_.rates;
  }

  /// Adds a link that starts with one body; X_LB of that body is given.
  void add_link(TreeLink link, std::uint32_t body, const Pose& X_LB) {
    const auto index = static_cast<std::int32_t>(layout_.links.size());
    link.q = layout_.coordinates;
    link.v = layout_.rates;
    with_model(link, [&](auto model) {
      layout_.coordinates += static_cast<std::uint32_t>(decltype(model)::kCoordinates);
      layout_.rates += static_cast<std::uint32_t>(decltype(model)::kRates);
    });
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) link.R_PJ.m[3 * i + j] = link.X_PJ.rotation()(i, j);
    }
    link.p_PJ = {link.X_PJ.p.x(), link.X_PJ.p.y(), link.X_PJ.p.z()};
    if (link.joint >= 0) layout_.link_of_joint[static_cast<std::size_t>(link.joint)] = index;
    if (link.driver != nullptr) layout_.trees.back().follows_driver = true;
    layout_.links.push_back(link);
    waiting_.emplace_back(body, index);
    layout_.link_of_body[body] = index;
    X_LB_.resize(bodies_.size());
    X_LB_[body] = X_LB;
  }

  /// The link that `edge` makes of the body it leads to; the parent frame P is given by the pose of the near
  /// body in it.
  [[nodiscard]] TreeLink tied_by(const Edge& edge, const Pose& X_PNear, Pose& X_LFar) const {
    const JointDefinition& joint = *joints_[static_cast<std::size_t>(edge.joint)];
    TreeLink link;
    link.joint = edge.joint;
    link.kind = joint.kind;
    link.reversed = !edge.to_b;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t from = link.reversed && link.kind == JointKind::Universal && i < 2 ? 1 - i : i;
      link.damping[i] = joint.damping[from], link.armature[i] = joint.axes[from].armature;
    }
    if (link.reversed && link.kind == JointKind::Planar) link.damping = {};  // JointLoads does it
    link.pitch = joint.pitch;
    link.driver = joint.driver.get();
    Pose X_JL;  // from the joint's own frames to the kernel's
    with_model(joint, [&](auto model) {
      if constexpr (requires { model.reversed_frame(); }) {
        if (!edge.to_b) X_JL.q = model.reversed_frame();
      }
    });
    link.X_PJ = X_PNear * (edge.to_b ? joint.X_AJ : joint.X_BJ) * X_JL;
    X_LFar = inverse((edge.to_b ? joint.X_BJ : joint.X_AJ) * X_JL);
    return link;
  }

  void grow_from_ground(std::int32_t body, const Edge& edge) {
    Pose X_LB;
    TreeLink link = tied_by(edge, Pose{}, X_LB);
    link.ground = edge.other;
    const bool animated =
        edge.other >= 0 && bodies_.kinds[static_cast<std::size_t>(edge.other)] == BodyKind::Animated;
    Tree& tree = layout_.trees.back();
    tree.follows_driver = tree.follows_driver || animated;
    add_link(link, static_cast<std::uint32_t>(body), X_LB);
    grow();
  }

  /// All trees that loops and couplings join are one.
  void build_mechanism(std::int32_t mechanism) {
    begin_tree();
    for (const auto& [body, edge] : grounded_) {
      if (spanning_.mechanism[static_cast<std::size_t>(body)] == mechanism) grow_from_ground(body, edge);
    }
    grow_coupled(mechanism);
    end_tree();
  }

  void build_floating(std::uint32_t body) {
    begin_tree();
    grow_floating(body);
    grow_coupled(spanning_.mechanism[body]);
    end_tree();
  }

  /// What floats and is coupled to what the tree begun last has so far.
  void grow_coupled(std::int32_t mechanism) {
    if (couplings_.empty() || mechanism < 0) return;
    for (const bool wanted : {false, true}) {
      for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (spanning_.mechanism[i] == mechanism && bodies_.kinds[i] == BodyKind::Simulated &&
            layout_.link_of_body[i] < 0 && is_b_[i] == wanted) {
          grow_floating(static_cast<std::uint32_t>(i));
        }
      }
    }
  }

  void grow_floating(std::uint32_t body) {
    TreeLink link;
    link.kind = JointKind::Free;
    // The frame of a floating root sits at the body's centre of gravity, so that spin does not enter its
    // position.
    add_link(link, body, Pose{-bodies_.mass[body].p_BBcm, Quaternion::Identity()});
    grow();
  }

  void grow() {
    while (!waiting_.empty()) {
      const auto [body, link] = waiting_.back();
      waiting_.pop_back();
      member_list_.push_back({link, body});
      const std::size_t end = first_edge_[body + 1];
      for (std::size_t e = first_edge_[body]; e < end; ++e) visit(edges_[e], body, link);
    }
  }

  void visit(const Edge& edge, std::uint32_t near, std::int32_t near_link) {
    if (!is_simulated(edge.other)) return;
    const auto far = static_cast<std::uint32_t>(edge.other);
    if (layout_.link_of_body[far] >= 0) return;
    const JointDefinition& joint = *joints_[static_cast<std::size_t>(edge.joint)];
    Pose X_LFar;
    TreeLink link = tied_by(edge, X_LB_[near], X_LFar);
    if (joint.kind == JointKind::Fixed) {  // one with its neighbour
      layout_.link_of_body[far] = near_link;
      X_LB_[far] = link.X_PJ * X_LFar;
      waiting_.emplace_back(far, near_link);
      return;
    }
    link.parent = near_link;
    add_link(link, far, X_LFar);
  }

  /// Writes the members of the tree's links side by side and sums their mass.
  void finish_members() {
    std::stable_sort(member_list_.begin(), member_list_.end(),
                     [](const auto& x, const auto& y) { return x.first < y.first; });
    std::int32_t last = -1;
    for (const auto& [index, body] : member_list_) {
      TreeLink& link = layout_.links[static_cast<std::size_t>(index)];
      const auto here = static_cast<std::uint32_t>(layout_.members.size());
      if (index != last) link.members_begin = here;
      last = index;
      layout_.members.push_back({body, X_LB_[body]});
      link.members_end = here + 1;
      add_mass(link, bodies_.mass[body], X_LB_[body]);
    }
    member_list_.clear();
  }

  static void add_mass(TreeLink& link, const MassProperties& mass, const Pose& X_LB) {
    const MassProperties m = in_frame(X_LB, mass);
    const Vector3& c = m.p_BBcm;
    const Matrix3 I = m.I_BBcm_B + m.mass * (c.squaredNorm() * Matrix3::Identity() - c * c.transpose());
    link.mass += m.mass;
    link.moment += {m.mass * c.x(), m.mass * c.y(), m.mass * c.z()};
    kernel::Sym3<double>& A = link.inertia;
    A.xx += I(0, 0), A.yy += I(1, 1), A.zz += I(2, 2), A.xy += I(0, 1), A.xz += I(0, 2), A.yz += I(1, 2);
  }

  const BodyStore& bodies_;
  std::span<const JointDefinition* const> joints_;
  std::span<const JointCoupling> couplings_;
  SpanningTree spanning_{};
  TreeLayout layout_{};
  std::vector<std::pair<std::int32_t, Edge>> grounded_{};
  std::vector<std::size_t> first_edge_{};
  std::vector<Edge> edges_{};
  std::vector<bool> is_b_{};
  std::vector<Pose> X_LB_{};
  std::vector<std::pair<std::uint32_t, std::int32_t>> waiting_{};
  std::vector<std::pair<std::int32_t, std::uint32_t>> member_list_{};
};

}  // namespace

TreeLayout lay_out(const BodyStore& bodies, std::span<const JointDefinition* const> joints,
                   std::span<const JointCoupling> couplings) {
  return Builder{bodies, joints, couplings}.build();
}

}  // namespace pantin
