// Where the two frames of a cut joint are and how they move.
#include <pantin/physics/constraints/closure.hpp>
#include <pantin/physics/constraints/joint_models.hpp>

namespace pantin {

namespace {

using kernel::cross;
using kernel::Mat3;
using Vec = kernel::Vec3<double>;

Vec vec(const Vector3& v) { return {v.x(), v.y(), v.z()}; }
Mat3<double> mat(const Quaternion& q) {
  const double c[4] = {q.w(), q.x(), q.y(), q.z()};
  return kernel::rotation_of(c);
}

FrameMotion frame(const RigidMotion& m) {
  return {mat(m.X_AB.q), vec(m.X_AB.p), vec(m.w_AB), vec(m.v_AB), vec(m.alpha_AB), vec(m.a_AB)};
}

FrameMotion motion_of(const ClosureEnd& end, const Articulated& kernel,
                      std::span<const RigidMotion> grounds) {
  FrameMotion L;
  L.R = Mat3<double>::identity();
  if (end.link >= 0) {
    const LinkWork& work = kernel.link(end.link);
    L = {work.R, work.p, work.w, work.v, work.al + work.dal, work.a + work.da};
  } else if (end.ground >= 0) {
    L = frame(grounds[static_cast<std::size_t>(end.ground)]);
  }
  return kernel::carried(L, end.R_LJ, end.p_LJ);
}

}  // namespace

ClosureMotion motion_of(const Closure& closure, const Articulated& kernel,
                        std::span<const RigidMotion> grounds, Instant at) {
  ClosureMotion motion{motion_of(closure.a, kernel, grounds), motion_of(closure.b, kernel, grounds)};
  if (closure.driver != nullptr)
    motion.a = kernel::composed(motion.a, frame(closure.driver->motion(at.t, at.side)));
  return motion;
}

void measure(const Closure& closure, const RelativeMotion& B, double* q) {
  const Matrix3 R = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(B.R.m);
  with_model(closure, [&](auto model) { model.measure(Pose{{B.p.x, B.p.y, B.p.z}, Quaternion{R}}, q); });
}

RelativeMotion relative(const ClosureMotion& m) {
  const FrameMotion &a = m.a, &b = m.b;
  RelativeMotion B;
  B.R = kernel::relative_rotation(a.R, b.R);
  const Vec d = b.p - a.p;
  B.p = transposed_times(a.R, d);
  B.w = transposed_times(a.R, b.w - a.w);
  B.v = transposed_times(a.R, b.v - a.v - cross(a.w, d));
  return B;
}

}  // namespace pantin
