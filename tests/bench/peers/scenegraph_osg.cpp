#include "scenegraph_osg.hpp"

#include <osg/MatrixTransform>
#include <osg/NodeVisitor>

namespace pantin::bench {
namespace {

/// OpenSceneGraph multiplies row vectors from the left: its matrices are the transposed ones.
osg::Matrixd to_osg(const Matrix34& M) {
  osg::Matrixd out;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      out(column, row) = M.m[static_cast<std::size_t>(4 * row + column)];
  return out;
}

class Placed : public osg::MatrixTransform {
 public:
  osg::Matrixd world{};
};

class WorldVisitor : public osg::NodeVisitor {
 public:
  WorldVisitor() : osg::NodeVisitor{TRAVERSE_ALL_CHILDREN} {}
  using osg::NodeVisitor::apply;
  void apply(osg::MatrixTransform& node) override {
    Placed& placed = static_cast<Placed&>(node);
    placed.world.mult(placed.getMatrix(), *above_);
    const osg::Matrixd* const above = above_;
    above_ = &placed.world;
    traverse(node);
    above_ = above;
  }

 private:
  const osg::Matrixd identity_{};
  const osg::Matrixd* above_{&identity_};
};

}  // namespace

struct OsgScene::Impl {
  std::vector<osg::ref_ptr<Placed>> nodes{};
};

OsgScene::OsgScene(const Crowd& crowd) : impl_{std::make_unique<Impl>()} {
  for (std::size_t i = 0; i < crowd.parents.size(); ++i) {
    impl_->nodes.push_back(new Placed);
    impl_->nodes[i]->setMatrix(to_osg(crowd.locals[i]));
    if (i > 0) impl_->nodes[crowd.parents[i]]->addChild(impl_->nodes[i].get());
  }
}
OsgScene::~OsgScene() = default;

void OsgScene::set_locals(std::span<const std::uint32_t> nodes, std::span<const Matrix34> locals) {
  for (std::size_t k = 0; k < nodes.size(); ++k) impl_->nodes[nodes[k]]->setMatrix(to_osg(locals[k]));
}

void OsgScene::update() {
  WorldVisitor visitor;
  impl_->nodes[0]->accept(visitor);
}

Matrix34 OsgScene::world(std::uint32_t node) const {
  Matrix34 out;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      out.m[static_cast<std::size_t>(4 * row + column)] = impl_->nodes[node]->world(column, row);
  return out;
}

}  // namespace pantin::bench
