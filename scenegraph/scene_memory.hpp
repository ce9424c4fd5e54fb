#pragma once
// What a Scene takes in memory.
#include <cstddef>

namespace pantin {

/// Bytes that a scene holds, room to spare included. Tables by id (`ids`, `names`) keep the size of the
/// greatest number of nodes that there ever were at once; all else shrinks with `Scene::compact`.
struct SceneMemory {
  std::size_t matrices{0};  ///< locals and worlds: 192 a node
  std::size_t topology{0};  ///< parents, sizes, tails and dirty bits
  std::size_t ids{0};       ///< both ways between ids and positions
  std::size_t names{0};     ///< 32 a node, and the text of names of more than 15 bytes
  std::size_t links{0};     ///< what a link and its entry take, and the text of its names

  [[nodiscard]] std::size_t total() const noexcept { return matrices + topology + ids + names + links; }
};

}  // namespace pantin
