#pragma once
// Trees with random numbers as the lane kernels see them.
#include <algorithm>
#include <random>
#include <vector>

#include <pantin/physics/lanes/loop_lanes.hpp>
#include <pantin/physics/lanes/tree_lanes.hpp>

namespace pantin::test {

/// A tree of `count` links of all kinds, its root floating, with numbers from a seed.
inline std::vector<lanes::LinkConstants> random_tree(int count, std::uint32_t& coordinates,
                                                     std::uint32_t& rates) {
  constexpr JointKind kKinds[] = {JointKind::Free,   JointKind::Pivot, JointKind::Slider,
                                  JointKind::Ball,   JointKind::Fixed, JointKind::Universal,
                                  JointKind::Planar, JointKind::Screw, JointKind::Cylindrical};
  constexpr std::uint32_t kSizes[][2] = {{7, 6}, {1, 1}, {1, 1}, {4, 3}, {0, 0},
                                         {2, 2}, {3, 3}, {1, 1}, {2, 2}};
  std::mt19937 random{11};
  std::uniform_real_distribution<double> any{-1, 1};
  std::vector<lanes::LinkConstants> links(static_cast<std::size_t>(count));
  coordinates = rates = 0;
  for (int i = 0; i < count; ++i) {
    lanes::LinkConstants& c = links[static_cast<std::size_t>(i)];
    const int kind = i == 0 ? 0 : 1 + (i - 1) % 8;
    c.kind = kKinds[kind];
    c.parent = i == 0 ? -1 : static_cast<std::int32_t>(std::uniform_int_distribution<int>{0, i - 1}(random));
    c.q = coordinates, c.v = rates;
    coordinates += kSizes[kind][0], rates += kSizes[kind][1];
    const Matrix3 R =
        Quaternion{any(random), any(random), any(random), any(random)}.normalized().toRotationMatrix();
    for (int k = 0; k < 9; ++k) c.R_PJ[k] = R(k / 3, k % 3);
    for (double& p : c.p_PJ) p = any(random);
    c.mass = 1 + any(random) / 2;
    for (double& h : c.moment) h = 0.1 * any(random);
    for (int k = 0; k < 3; ++k) c.inertia[k] = 1 + any(random) / 3, c.inertia[3 + k] = 0.1 * any(random);
    for (double& d : c.damping) d = 0.1;
    c.is_damped = true;
    c.is_loaded = i % 2 == 1;
    if (c.is_loaded) std::fill_n(c.armature, 3, 0.05);
    c.pitch = 0.2;
  }
  for (std::size_t i = links.size(); i-- > 1;) {
    lanes::LinkConstants& up = links[static_cast<std::size_t>(links[i].parent)];
    links[i].first_child = up.leaf;
    up.leaf = false;
  }
  return links;
}

/// Such a tree at eight random states, under gravity and efforts.
struct LaneTree {
  static constexpr std::size_t kStages = 8;
  std::uint32_t coordinates{0}, rates{0};
  std::vector<lanes::LinkConstants> links{};
  std::vector<double> q{}, v{}, efforts{};

  explicit LaneTree(int count) : links{random_tree(count, coordinates, rates)} {
    std::mt19937 random{5};
    std::uniform_real_distribution<double> any{-1, 1};
    q.resize(coordinates * kStages), v.resize(rates * kStages), efforts.resize(rates * kStages);
    for (std::vector<double>* numbers : {&q, &v, &efforts}) {
      for (double& x : *numbers) x = any(random);
    }
  }

  /// v' of all stages; with what closures exert, where there are any.
  std::vector<double> solve(const lanes::Kernel& kernel, lanes::LoopTask* loop = nullptr) const {
    std::vector<double> v_dot(rates * kStages);
    lanes::AlignedRoom room, loop_room;
    room.resize(kernel.work_size(links.size(), rates));
    if (loop != nullptr) {
      loop_room.resize(kernel.loop_size(loop->sizes));
      loop->work = loop_room.data();
    }
    for (std::size_t s = 0; s < kStages; s += static_cast<std::size_t>(kernel.lanes)) {
      const lanes::Task task{.links = links.data(),
                             .begin = 0,
                             .end = static_cast<std::uint32_t>(links.size()),
                             .q = q.data(),
                             .v = v.data(),
                             .v_dot = v_dot.data(),
                             .stages = kStages,
                             .first = s,
                             .gravity = {0.1, 0.2, -9.81},
                             .efforts = efforts.data(),
                             .work = room.data()};
      kernel.outward(task);
      if (loop != nullptr) kernel.trace(task, *loop);
      kernel.solve(task);
      if (loop != nullptr) kernel.close(task, *loop);
    }
    return v_dot;
  }
};

}  // namespace pantin::test
