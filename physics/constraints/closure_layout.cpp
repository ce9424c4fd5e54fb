// Closures in a layout: which there are, their ends and paths.
#include <algorithm>

#include <pantin/physics/constraints/closure.hpp>
#include <pantin/physics/constraints/coupling_row.hpp>
#include <pantin/physics/constraints/joint_models.hpp>
#include <pantin/physics/constraints/spanning_tree.hpp>

namespace pantin {

namespace {

kernel::Mat3<double> mat(const Quaternion& q) {
  const double c[4] = {q.w(), q.x(), q.y(), q.z()};
  return kernel::rotation_of(c);
}

ClosureEnd end_of(const TreeLayout& layout, const BodyStore& bodies, BodyId id, const Pose& X_BJ) {
  ClosureEnd end;
  Pose X_LJ = X_BJ;
  if (id) {
    const std::size_t i = bodies.at(id);
    end.link = layout.link_of_body[i];
    if (end.link < 0) end.ground = static_cast<std::int32_t>(i);
    else X_LJ = layout.pose_in_link(static_cast<std::uint32_t>(i)) * X_BJ;
  }
  end.R_LJ = mat(X_LJ.q);
  end.p_LJ = {X_LJ.p.x(), X_LJ.p.y(), X_LJ.p.z()};
  return end;
}

}  // namespace

// Links stand behind their parents.
void append_path(TreeLayout& layout, Closure& closure) {
  std::vector<std::int32_t> links;
  std::int32_t x = closure.a.link, y = closure.b.link;
  while (x >= 0 || y >= 0) {
    const std::int32_t last = std::max(x, y);
    links.push_back(last);
    const std::int32_t parent = layout.links[static_cast<std::size_t>(last)].parent;
    if (x == last) x = parent;
    if (y == last) y = parent;
  }
  closure.path_begin = static_cast<std::uint32_t>(layout.paths.size());
  for (const std::int32_t l : links) {
    const TreeLink& link = layout.links[static_cast<std::size_t>(l)];
    const auto up = std::find(links.begin(), links.end(), link.parent);
    layout.paths.push_back({static_cast<std::uint32_t>(l),
                            up == links.end() ? -1 : static_cast<std::int32_t>(up - links.begin()),
                            closure.path_rates});
    with_model(link, [&](auto model) { closure.path_rates += std::uint32_t{decltype(model)::kRates}; });
  }
  closure.path_end = static_cast<std::uint32_t>(layout.paths.size());
}

Closure make_closure(TreeLayout& layout, const BodyStore& bodies, const JointDefinition& joint,
                     std::int32_t position) {
  Closure closure;
  closure.joint = position;
  closure.kind = joint.kind;
  closure.rows = static_cast<std::uint32_t>(row_count(joint.kind));
  closure.a = end_of(layout, bodies, joint.a, joint.X_AJ);
  closure.b = end_of(layout, bodies, joint.b, joint.X_BJ);
  closure.pitch = joint.pitch;
  for (std::size_t i = 0; i < 3; ++i) closure.armature[i] = joint.axes[i].armature;
  for (const double armature : closure.armature) closure.rows += armature > 0 ? 1 : 0;
  closure.driver = joint.driver.get();
  append_path(layout, closure);
  return closure;
}

namespace {

/// A closure to come: of a cut joint or of a coupling, by position.
struct Coming {
  std::size_t tree{0};
  std::int32_t joint{-1}, coupling{-1};
};

std::vector<Coming> closures_to_come(TreeLayout& layout, const BodyStore& bodies,
                                     std::span<const JointDefinition* const> joints,
                                     std::span<const JointCoupling> couplings,
                                     std::span<const std::uint8_t> is_cut) {
  std::vector<Coming> list;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (is_cut[j] == 0) continue;
    std::int32_t link = -1;
    for (const BodyId id : {joints[j]->a, joints[j]->b}) {
      if (id) link = std::max(link, layout.link_of_body[bodies.at(id)]);
    }
    list.push_back({layout.tree_of(link), static_cast<std::int32_t>(j), -1});
  }
  for (std::size_t k = 0; k < couplings.size(); ++k) {
    const std::int32_t a = layout.link_of_joint[couplings[k].a], b = layout.link_of_joint[couplings[k].b];
    const bool is_split = is_cut[couplings[k].a] != 0 || is_cut[couplings[k].b] != 0;
    if (is_split && layout.cut_coupling < 0) layout.cut_coupling = static_cast<std::int32_t>(k);
    if (a >= 0 && b >= 0) list.push_back({layout.tree_of(b), -1, static_cast<std::int32_t>(k)});
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const Coming& x, const Coming& y) { return x.tree < y.tree; });
  return list;
}

}  // namespace

void add_closures(TreeLayout& layout, const BodyStore& bodies, std::span<const JointDefinition* const> joints,
                  std::span<const JointCoupling> couplings, std::span<const std::uint8_t> is_cut) {
  const std::vector<Coming> list = closures_to_come(layout, bodies, joints, couplings, is_cut);
  const auto animated = [&](const ClosureEnd& end) {
    return end.ground >= 0 && bodies.kinds[static_cast<std::size_t>(end.ground)] == BodyKind::Animated;
  };
  auto next = list.begin();
  for (std::size_t t = 0; t < layout.trees.size(); ++t) {
    Tree& tree = layout.trees[t];
    tree.closures_begin = static_cast<std::uint32_t>(layout.closures.size());
    for (; next != list.end() && next->tree == t; ++next) {
      const auto here = static_cast<std::int32_t>(layout.closures.size());
      if (next->coupling >= 0) {
        const auto k = static_cast<std::size_t>(next->coupling);
        layout.closure_of_coupling[k] = here;
        layout.closures.push_back(make_coupling(layout, couplings[k], next->coupling));
        continue;
      }
      const auto j = static_cast<std::size_t>(next->joint);
      layout.closure_of_joint[j] = here;
      const Closure closure = make_closure(layout, bodies, *joints[j], next->joint);
      layout.closures.push_back(closure);
      tree.follows_driver =
          tree.follows_driver || closure.driver != nullptr || animated(closure.a) || animated(closure.b);
    }
    tree.closures_end = static_cast<std::uint32_t>(layout.closures.size());
  }
}

}  // namespace pantin
