#pragma once
// Everything public in one include: scene graph, physics, bridge. Loaders are declared here and linked where
// built.

#include <pantin/scenegraph/affine.hpp>
#include <pantin/scenegraph/clip.hpp>
#include <pantin/scenegraph/expects.hpp>
#include <pantin/scenegraph/link.hpp>
#include <pantin/scenegraph/node_id.hpp>
#include <pantin/scenegraph/player.hpp>
#include <pantin/scenegraph/scene.hpp>

#include <pantin/physics/bodies_at.hpp>
#include <pantin/physics/constraints/ball.hpp>
#include <pantin/physics/constraints/cylindrical.hpp>
#include <pantin/physics/constraints/driven.hpp>
#include <pantin/physics/constraints/fixed.hpp>
#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/constraints/pivot.hpp>
#include <pantin/physics/constraints/planar.hpp>
#include <pantin/physics/constraints/screw.hpp>
#include <pantin/physics/constraints/slider.hpp>
#include <pantin/physics/constraints/universal.hpp>
#include <pantin/physics/driver.hpp>
#include <pantin/physics/expects.hpp>
#include <pantin/physics/forces/constant_load.hpp>
#include <pantin/physics/forces/damped_spring.hpp>
#include <pantin/physics/forces/force_law.hpp>
#include <pantin/physics/forces/force_manager.hpp>
#include <pantin/physics/forces/gravity.hpp>
#include <pantin/physics/forces/linear_drag.hpp>
#include <pantin/physics/ids.hpp>
#include <pantin/physics/integrators/integrator.hpp>
#include <pantin/physics/mass_properties.hpp>
#include <pantin/physics/physics_manager.hpp>
#include <pantin/physics/pose.hpp>
#include <pantin/physics/problem.hpp>
#include <pantin/physics/rigid_body.hpp>
#include <pantin/physics/shape.hpp>
#include <pantin/physics/state.hpp>
#include <pantin/physics/step_report.hpp>

#include <pantin/bridge/bridge.hpp>
#include <pantin/bridge/clock.hpp>
#include <pantin/bridge/diagnostic.hpp>
#include <pantin/bridge/drive.hpp>
#include <pantin/bridge/loaders/load_model.hpp>
#include <pantin/bridge/model.hpp>
