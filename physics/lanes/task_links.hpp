#pragma once
// How the lane kernels reach what a task consists of.
#include <pantin/physics/constraints/ball.hpp>
#include <pantin/physics/constraints/cylindrical.hpp>
#include <pantin/physics/constraints/fixed.hpp>
#include <pantin/physics/constraints/free_root.hpp>
#include <pantin/physics/constraints/pivot.hpp>
#include <pantin/physics/constraints/planar.hpp>
#include <pantin/physics/constraints/screw.hpp>
#include <pantin/physics/constraints/slider.hpp>
#include <pantin/physics/constraints/universal.hpp>
#include <pantin/physics/lanes/link_lanes.hpp>

namespace pantin::lanes {

/// Links, rates and numbers of a task, in lanes.
template <class T>
class TaskLinks {
 public:
  /// A joint whose motion is given: no rates.
  struct Given {
    static constexpr int kCoordinates = 0, kRates = 0;
  };

  template <class F>
  static void with_kind(const LinkConstants& c, F&& f) {
    if (c.given >= 0) return f(Given{});
    with_model_of(c.kind, c.pitch, f);
  }
  template <class F>
  static void with_model_of(JointKind kind, double pitch, F&& f) {
    switch (kind) {
      case JointKind::Pivot:
        return f(PivotModel{});
      case JointKind::Slider:
        return f(SliderModel{});
      case JointKind::Ball:
        return f(BallModel{});
      case JointKind::Fixed:
        return f(FixedModel{});
      case JointKind::Cylindrical:
        return f(CylindricalModel{});
      case JointKind::Universal:
        return f(UniversalModel{});
      case JointKind::Planar:
        return f(PlanarModel{});
      case JointKind::Screw:
        return f(ScrewModel{pitch});
      case JointKind::Free:
        return f(FreeModel{});
      case JointKind::Driven:
        return;  // never tied by a model
    }
  }

  static LinkLanes<T>& link(const Task& task, std::uint32_t i) {
    return reinterpret_cast<LinkLanes<T>*>(task.work)[i - task.begin];
  }
  static RateLanes<T>* rates(const Task& task, const LinkConstants& c) {
    double* after = task.work + (task.end + 1 - task.begin) * sizeof(LinkLanes<T>) / sizeof(double);
    return reinterpret_cast<RateLanes<T>*>(after) + (c.v - task.links[task.begin].v);
  }
  static T number(const Task& task, const double* of, std::uint32_t i) {
    return T::load(of + i * task.stages + task.first);
  }
};

}  // namespace pantin::lanes
