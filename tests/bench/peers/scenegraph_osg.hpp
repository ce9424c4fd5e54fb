#pragma once
// The crowd in OpenSceneGraph: one MatrixTransform a node. OpenSceneGraph stores no world matrices and tracks
// no changes to them; it computes them whenever a visitor goes down, as its cull and intersection visitors do
// each frame. `update` is such a visitor, of all nodes, that does nothing else and keeps each matrix in its
// node.
#include <memory>
#include <span>

#include "../scenegraph_crowd.hpp"

namespace pantin::bench {

class OsgScene {
 public:
  explicit OsgScene(const Crowd& crowd);
  ~OsgScene();

  void set_locals(std::span<const std::uint32_t> nodes, std::span<const Matrix34> locals);
  void update();
  [[nodiscard]] Matrix34 world(std::uint32_t node) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pantin::bench
