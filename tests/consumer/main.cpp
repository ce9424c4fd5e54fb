// Uses two installed components: a stone falls, a node stands where it is. Exits with 0 where both agree with
// the closed form.
#include <pantin/physics/forces/gravity.hpp>
#include <pantin/physics/physics_manager.hpp>
#include <pantin/scenegraph/scene.hpp>

#include <cmath>
#include <cstdio>

int main() {
  pantin::PhysicsManager physics;
  const pantin::BodyId stone = physics.add(pantin::RigidBodySettings{});
  physics.forces().add(pantin::Gravity{.g_W = {0, 0, -10}});
  for (int i = 0; i < 100; ++i) {
    if (!physics.step(0.01).ok()) return 2;
  }
  pantin::Scene scene;
  const pantin::NodeId child = scene.create(scene.root(), "stone");
  pantin::Affine local = pantin::Affine::Identity();
  local.translation() = physics.body(stone).X_WB().p;
  scene.set_local(child, local);
  scene.update();
  const double height = scene.world(child).translation().z();
  std::printf("the stone is at %.6f m\n", height);
  return std::abs(height + 5) < 1e-9 ? 0 : 1;  // -g t^2 / 2
}
