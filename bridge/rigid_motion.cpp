// M = Q S, Q a rotation with angular velocity w (in axes of B), S symmetric:
//   Q^T M'  = [w] S + S'                                    =: A
//   A - A^T = [w] S + S [w] = [ (tr(S) 1 - S) w ]           so  (tr(S) 1 - S) w = vee(A - A^T)
//   A'      = -[w] A + Q^T M''
//   S'      = A - [w] S
//   (tr(S) 1 - S) w' = vee(A' - A'^T) - (tr(S') 1 - S') w   the time derivative of the second line
//   S''     = A' - [w'] S - [w] S'
// where vee([k]) = k. In W: w_W = Q w and, as Q w x w = 0, alpha_W = Q w'.
#include <pantin/bridge/rigid_motion.hpp>

#include <Eigen/LU>

#include <pantin/bridge/polar.hpp>

namespace pantin {
namespace {

Vector3 vee_of_skew_part_twice(const Matrix3& A) {
  return {A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1)};
}

Matrix3 resistance(const Matrix3& S) { return S.trace() * Matrix3::Identity() - S; }

}  // namespace

Matrix3 cross_matrix(const Vector3& w) {
  return Matrix3{{0, -w.z(), w.y()}, {w.z(), 0, -w.x()}, {-w.y(), w.x(), 0}};
}

LocalMotion constant_motion(const Affine& M) {
  LocalMotion motion;
  motion.value = M.affine();
  return motion;
}

LocalMotion operator*(const LocalMotion& a, const LocalMotion& b) {
  LocalMotion c;
  const Matrix3 a0 = a.value.leftCols<3>(), a1 = a.first.leftCols<3>(), a2 = a.second.leftCols<3>();
  c.value = a0 * b.value;
  c.first = a1 * b.value + a0 * b.first;
  c.second = a2 * b.value + 2 * (a1 * b.first) + a0 * b.second;
  c.value.col(3) += a.value.col(3);
  c.first.col(3) += a.first.col(3);
  c.second.col(3) += a.second.col(3);
  return c;
}

SplitMotion split(const LocalMotion& M) {
  const Polar parts = polar(M.value.leftCols<3>());
  SplitMotion out;
  out.S = parts.S;
  out.singular = parts.singular;
  out.X.X_AB = {M.value.col(3), parts.q};
  out.X.v_AB = M.first.col(3);
  out.X.a_AB = M.second.col(3);
  if (parts.singular || (M.first.leftCols<3>().isZero(0) && M.second.leftCols<3>().isZero(0))) return out;
  const Matrix3 Q = parts.q.toRotationMatrix();
  const Matrix3 A = Q.transpose() * M.first.leftCols<3>();
  const Matrix3 inverse = resistance(out.S).inverse();
  const Vector3 w = inverse * vee_of_skew_part_twice(A);
  const Matrix3 A1 = Q.transpose() * M.second.leftCols<3>() - cross_matrix(w) * A;
  out.S1 = A - cross_matrix(w) * out.S;
  const Vector3 w1 = inverse * (vee_of_skew_part_twice(A1) - resistance(out.S1) * w);
  out.S2 = A1 - cross_matrix(w1) * out.S - cross_matrix(w) * out.S1;
  out.X.w_AB = Q * w;
  out.X.alpha_AB = Q * w1;
  return out;
}

LocalMotion joined(const SplitMotion& split) {
  const RigidMotion& X = split.X;
  const Matrix3 R = X.X_AB.rotation();
  const Matrix3 w = cross_matrix(X.w_AB);
  const Matrix3 R1 = w * R;
  const Matrix3 R2 = cross_matrix(X.alpha_AB) * R + w * R1;
  LocalMotion M;
  M.value << R * split.S, X.X_AB.p;
  M.first << R1 * split.S + R * split.S1, X.v_AB;
  M.second << R2 * split.S + 2 * (R1 * split.S1) + R * split.S2, X.a_AB;
  return M;
}

RigidMotion relative_motion(const RigidMotion& A, const RigidMotion& B) {
  const Matrix3 R_AW = A.X_AB.rotation().transpose();
  const Vector3 p = B.X_AB.p - A.X_AB.p, v = B.v_AB - A.v_AB, a = B.a_AB - A.a_AB;
  const Vector3& w = A.w_AB;
  const Vector3 drag = w.cross(p);  // what A's turning gives a point that rests in A
  RigidMotion X_AB;
  X_AB.X_AB = inverse(A.X_AB) * B.X_AB;
  X_AB.v_AB = R_AW * (v - drag);
  X_AB.w_AB = R_AW * (B.w_AB - w);
  X_AB.a_AB = R_AW * (a - A.alpha_AB.cross(p) - w.cross(drag) - 2 * w.cross(v - drag));
  X_AB.alpha_AB = R_AW * (B.alpha_AB - A.alpha_AB - w.cross(B.w_AB - w));
  return X_AB;
}

RigidMotion composed(const RigidMotion& B, const RigidMotion& C) {
  const Matrix3 R = B.X_AB.rotation();
  const Vector3 p = R * C.X_AB.p, v = R * C.v_AB, w = R * C.w_AB;
  RigidMotion X;
  X.X_AB = B.X_AB * C.X_AB;
  X.v_AB = B.v_AB + B.w_AB.cross(p) + v;
  X.w_AB = B.w_AB + w;
  X.a_AB = B.a_AB + B.alpha_AB.cross(p) + B.w_AB.cross(B.w_AB.cross(p)) + 2 * B.w_AB.cross(v) + R * C.a_AB;
  X.alpha_AB = B.alpha_AB + B.w_AB.cross(w) + R * C.alpha_AB;
  return X;
}

}  // namespace pantin
