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

/// Motion of a frame fixed at (R_LJ, p_LJ) in another.
FrameMotion carried(const FrameMotion& L, const Mat3<double>& R_LJ, const Vec& p_LJ) {
  const Vec r = L.R * p_LJ, w_x_r = cross(L.w, r);
  FrameMotion J;
  J.R = L.R * R_LJ;
  J.p = L.p + r;
  J.w = L.w, J.al = L.al;
  J.v = L.v + w_x_r;
  J.a = L.a + cross(L.al, r) + cross(L.w, w_x_r);
  return J;
}

/// Motion of B in the world from that of A and of B in A.
FrameMotion composed(const FrameMotion& A, const RigidMotion& B) {
  FrameMotion out = carried(A, mat(B.X_AB.q), vec(B.X_AB.p));
  const Vec v = A.R * vec(B.v_AB), w = A.R * vec(B.w_AB);
  out.w += w;
  out.v += v;
  out.al += cross(A.w, w) + A.R * vec(B.alpha_AB);
  out.a += 2.0 * cross(A.w, v) + A.R * vec(B.a_AB);
  return out;
}

FrameMotion motion_of(const ClosureEnd& end, const Articulated& kernel,
                      std::span<const RigidMotion> grounds) {
  FrameMotion L;
  L.R = Mat3<double>::identity();
  if (end.link >= 0) {
    const LinkWork& work = kernel.link(end.link);
    L = {work.R, work.p, work.w, work.v, work.al + work.dal, work.a + work.da};
  } else if (end.ground >= 0) {
    const RigidMotion& ground = grounds[static_cast<std::size_t>(end.ground)];
    L = {mat(ground.X_AB.q), vec(ground.X_AB.p),   vec(ground.w_AB),
         vec(ground.v_AB),   vec(ground.alpha_AB), vec(ground.a_AB)};
  }
  return carried(L, end.R_LJ, end.p_LJ);
}

}  // namespace

ClosureMotion motion_of(const Closure& closure, const Articulated& kernel,
                        std::span<const RigidMotion> grounds, Instant at) {
  ClosureMotion motion{motion_of(closure.a, kernel, grounds), motion_of(closure.b, kernel, grounds)};
  if (closure.driver != nullptr) motion.a = composed(motion.a, closure.driver->motion(at.t, at.side));
  return motion;
}

void measure(const Closure& closure, const RelativeMotion& B, double* q) {
  const Matrix3 R = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(B.R.m);
  with_model(closure, [&](auto model) { model.measure(Pose{{B.p.x, B.p.y, B.p.z}, Quaternion{R}}, q); });
}

RelativeMotion relative(const ClosureMotion& m) {
  const FrameMotion &a = m.a, &b = m.b;
  RelativeMotion B;
  for (int j = 0; j < 3; ++j) {
    const Vec column = transposed_times(a.R, b.R.column(j));
    B.R.m[j] = column.x, B.R.m[3 + j] = column.y, B.R.m[6 + j] = column.z;
  }
  const Vec d = b.p - a.p;
  B.p = transposed_times(a.R, d);
  B.w = transposed_times(a.R, b.w - a.w);
  B.v = transposed_times(a.R, b.v - a.v - cross(a.w, d));
  return B;
}

}  // namespace pantin
