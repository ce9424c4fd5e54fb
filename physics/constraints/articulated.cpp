#include <pantin/physics/constraints/articulated.hpp>

#include <algorithm>

#include <pantin/physics/constraints/joint_models.hpp>

namespace pantin {

namespace {

using kernel::cross;
using kernel::dot;
using kernel::Mat3;
using kernel::Sym3;
using Vec = kernel::Vec3<double>;

Vec vec(const Vector3& v) { return {v.x(), v.y(), v.z()}; }
Vector3 eigen(const Vec& v) { return {v.x, v.y, v.z}; }

Mat3<double> mat(const Quaternion& q) {
  const double c[4] = {q.w(), q.x(), q.y(), q.z()};
  return kernel::rotation_of(c);
}

}  // namespace

void Articulated::resize(const TreeLayout& layout) {
  work_.resize(layout.links.size());
  S_a_.resize(layout.rates);
  S_l_.resize(layout.rates);
  U_a_.resize(layout.rates);
  U_l_.resize(layout.rates);
  u_.resize(layout.rates);
  D_.resize(layout.rates);
  scale_.resize(layout.rates);
  holds_ = false;
}

void Articulated::place(const TreeLayout& layout, const Tree& tree, std::span<const RigidMotion> grounds,
                        Instant at, std::span<const double> q, std::span<const double> v) {
  for (std::uint32_t i = tree.links_begin; i < tree.links_end; ++i) {
    const TreeLink& link = layout.links[i];
    LinkWork& work = work_[i];
    Mat3<double> R_p = Mat3<double>::identity();
    Vec p_p, w_p, v_p, al_p, a_p;
    if (link.parent >= 0) {
      const LinkWork& parent = work_[static_cast<std::size_t>(link.parent)];
      R_p = parent.R, p_p = parent.p, w_p = parent.w, v_p = parent.v, al_p = parent.al, a_p = parent.a;
    } else if (link.ground >= 0) {
      const RigidMotion& ground = grounds[static_cast<std::size_t>(link.ground)];
      R_p = mat(ground.X_AB.q), p_p = vec(ground.X_AB.p), w_p = vec(ground.w_AB), v_p = vec(ground.v_AB);
      al_p = vec(ground.alpha_AB), a_p = vec(ground.a_AB);
    }
    const Mat3<double> R_J = R_p * link.R_PJ;
    Mat3<double> R_rel;
    Vec p_rel, w_rel, v_rel, al_rel, a_rel;
    if (link.driver != nullptr) {
      RigidMotion motion = link.driver->motion(at.t, at.side);
      if (link.reversed) motion = inverse(motion);
      R_rel = mat(motion.X_AB.q), p_rel = vec(motion.X_AB.p);
      w_rel = R_J * vec(motion.w_AB), v_rel = R_J * vec(motion.v_AB);
      al_rel = R_J * vec(motion.alpha_AB), a_rel = R_J * vec(motion.a_AB);
    } else {
      with_model(link, [&](auto model) {
        using Model = decltype(model);
        model.place(q.data() + link.q, R_rel, p_rel);
        Vec* S_a = S_a_.data() + link.v;
        Vec* S_l = S_l_.data() + link.v;
        model.columns(R_rel, S_a, S_l);
        for (int j = 0; j < Model::kRates; ++j) {
          S_a[j] = R_J * S_a[j];
          S_l[j] = R_J * S_l[j];
          if (is_locked(link.v + static_cast<std::uint32_t>(j))) S_a[j] = S_l[j] = {};
          const double rate = v[link.v + static_cast<std::uint32_t>(j)];
          w_rel += rate * S_a[j];
          v_rel += rate * S_l[j];
        }
        if constexpr (requires { model.bias(R_rel, v.data(), al_rel, a_rel); }) {
          model.bias(R_rel, v.data() + link.v, al_rel, a_rel);
          al_rel = R_J * al_rel;
          a_rel = R_J * a_rel;
        }
      });
    }
    const Vec r = R_p * link.p_PJ + R_J * p_rel;
    const Vec w_p_x_r = cross(w_p, r);
    work.R = R_J * R_rel;
    work.r = r;
    work.p = p_p + r;
    work.w = w_p + w_rel;
    work.v = v_p + w_p_x_r + v_rel;
    work.al = al_p + cross(w_p, w_rel) + al_rel;
    work.a = a_p + cross(al_p, r) + cross(w_p, w_p_x_r) + 2.0 * cross(w_p, v_rel) + a_rel;
  }
}

void Articulated::write_members(const TreeLayout& layout, const Tree& tree,
                                std::span<const MassProperties> mass, std::span<BodyKinematics> out) const {
  for (std::uint32_t i = tree.links_begin; i < tree.links_end; ++i) {
    const LinkWork& work = work_[i];
    for (std::uint32_t m = layout.links[i].members_begin; m < layout.links[i].members_end; ++m) {
      const TreeMember& member = layout.members[m];
      BodyKinematics& k = out[member.body];
      const Mat3<double> R = work.R * mat(member.X_LB.q);
      const Vec c = work.R * vec(member.X_LB * mass[member.body].p_BBcm);
      k.p_WBcm = eigen(work.p + c);
      k.R_WB << R.m[0], R.m[1], R.m[2], R.m[3], R.m[4], R.m[5], R.m[6], R.m[7], R.m[8];
      k.v_WBcm = eigen(work.v + cross(work.w, c));
      k.w_WB = eigen(work.w);
    }
  }
}

void Articulated::start_inertia(const TreeLink& link, LinkWork& work) const {
  work.h = work.R * link.moment;
  work.A = rotated(work.R, link.inertia);
  work.B = {{0, -work.h.z, work.h.y, work.h.z, 0, -work.h.x, -work.h.y, work.h.x, 0}};
  work.M = {link.mass, link.mass, link.mass, 0, 0, 0};
}

void Articulated::load(const TreeLayout& layout, const Tree& tree) {
  for (std::uint32_t i = tree.links_begin; i < tree.links_end; ++i) {
    LinkWork& work = work_[i];
    start_inertia(layout.links[i], work);
    work.p_a = work.A * work.al + cross(work.w, work.A * work.w) + cross(work.h, work.a);
    work.p_l = layout.links[i].mass * work.a + cross(work.al, work.h) + cross(work.w, cross(work.w, work.h));
  }
}

void Articulated::load_momenta(const TreeLayout& layout, const Tree& tree,
                               std::span<const MassProperties> mass, std::span<const BodyState> bodies) {
  for (std::uint32_t i = tree.links_begin; i < tree.links_end; ++i) {
    const TreeLink& link = layout.links[i];
    LinkWork& work = work_[i];
    start_inertia(link, work);
    work.p_a = work.A * work.w + cross(work.h, work.v);
    work.p_l = link.mass * work.v + cross(work.w, work.h);
    for (std::uint32_t m = link.members_begin; m < link.members_end; ++m) {
      const TreeMember& member = layout.members[m];
      const BodyState& s = bodies[member.body];
      const Vec c = work.R * vec(member.X_LB * mass[member.body].p_BBcm);
      add_wrench(static_cast<std::int32_t>(i), s.linear_momentum, s.angular_momentum, eigen(work.p + c));
    }
  }
}

void Articulated::add_wrench(std::int32_t link, const Vector3& force, const Vector3& torque,
                             const Vector3& p_WQ) {
  LinkWork& work = work_[static_cast<std::size_t>(link)];
  const Vec f = vec(force);
  work.p_l = work.p_l - f;
  work.p_a = work.p_a - vec(torque) - cross(vec(p_WQ) - work.p, f);
}

template <int N>
void Articulated::eliminate_link(const TreeLink& link, LinkWork& work, std::span<const double> v,
                                 std::span<const double> efforts) {
  const Vec* S_a = S_a_.data() + link.v;
  const Vec* S_l = S_l_.data() + link.v;
  Vec* U_a = U_a_.data() + link.v;
  Vec* U_l = U_l_.data() + link.v;
  double* u = u_.data() + link.v;
  std::array<double, 6>* D = D_.data() + link.v;
  const double angular = work.A.xx + work.A.yy + work.A.zz, linear = work.M.xx + work.M.yy + work.M.zz;
  const auto rotor = [&link](int j) { return N <= 3 ? link.armature[static_cast<std::size_t>(j)] : 0.0; };
  for (int j = 0; j < N; ++j) {
    U_a[j] = work.A * S_a[j] + work.B * S_l[j];
    U_l[j] = transposed_times(work.B, S_a[j]) + work.M * S_l[j];
    u[j] = -dot(S_a[j], work.p_a) - dot(S_l[j], work.p_l);
    if constexpr (N <= 3) {
      if (!v.empty())
        u[j] -= link.damping[static_cast<std::size_t>(j)] * v[link.v + static_cast<std::uint32_t>(j)];
      if (link.is_loaded && !efforts.empty()) u[j] += efforts[link.v + static_cast<std::uint32_t>(j)];
    }
    if (holds_) hold_rate(link.v + static_cast<std::uint32_t>(j), !v.empty());
    scale_[link.v + static_cast<std::uint32_t>(j)] =
        dot(S_a[j], S_a[j]) * angular + dot(S_l[j], S_l[j]) * linear + rotor(j);
  }
  // D = S^T U + armature = L d L^T; row j holds L(j, 0..j-1) and d(j).
  for (int j = 0; j < N; ++j) {
    for (int k = 0; k <= j; ++k) {
      double d = dot(S_a[j], U_a[k]) + dot(S_l[j], U_l[k]);
      if (j == k) d += rotor(j);
      if (k == j && is_locked(link.v + static_cast<std::uint32_t>(j))) d = 1;
      const auto row = static_cast<std::size_t>(j), col = static_cast<std::size_t>(k);
      for (std::size_t l = 0; l < col; ++l) d -= D[j][l] * D[k][l] * D[l][l];
      D[row][col] = k < j ? d / D[k][col] : d;
    }
  }
  // U <- U L^-T, u <- L^-1 u: then I^A - U d^-1 U^T and p + U d^-1 u are sums over the columns.
  for (int j = 0; j < N; ++j) {
    for (int k = 0; k < j; ++k) {
      const double l = D[j][static_cast<std::size_t>(k)];
      U_a[j] = U_a[j] - l * U_a[k];
      U_l[j] = U_l[j] - l * U_l[k];
      u[j] -= l * u[k];
    }
    const double inverse_d = 1 / D[j][static_cast<std::size_t>(j)];
    const Vec a = inverse_d * U_a[j], b = inverse_d * U_l[j];
    const Vec &x = U_a[j], &y = U_l[j];
    Sym3<double>&A = work.A, &M = work.M;
    A.xx -= x.x * a.x, A.yy -= x.y * a.y, A.zz -= x.z * a.z, A.xy -= x.x * a.y, A.xz -= x.x * a.z,
        A.yz -= x.y * a.z;
    M.xx -= y.x * b.x, M.yy -= y.y * b.y, M.zz -= y.z * b.z, M.xy -= y.x * b.y, M.xz -= y.x * b.z,
        M.yz -= y.y * b.z;
    double* B = work.B.m;
    B[0] -= x.x * b.x, B[1] -= x.x * b.y, B[2] -= x.x * b.z;
    B[3] -= x.y * b.x, B[4] -= x.y * b.y, B[5] -= x.y * b.z;
    B[6] -= x.z * b.x, B[7] -= x.z * b.y, B[8] -= x.z * b.z;
    work.p_a += u[j] * a;
    work.p_l += u[j] * b;
  }
}

void Articulated::shift_to_parent(const LinkWork& work, LinkWork& parent) const {
  const Vec& r = work.r;
  const Sym3<double>& M = work.M;
  const double* B = work.B.m;
  // B' = B + [r] M, column by column of M.
  const Vec m0 = cross(r, Vec{M.xx, M.xy, M.xz}), m1 = cross(r, Vec{M.xy, M.yy, M.yz}),
            m2 = cross(r, Vec{M.xz, M.yz, M.zz});
  const double C[9] = {B[0] + m0.x, B[1] + m1.x, B[2] + m2.x, B[3] + m0.y, B[4] + m1.y,
                       B[5] + m2.y, B[6] + m0.z, B[7] + m1.z, B[8] + m2.z};
  // -B [r]: row i is r x (row i of B), and [r] B'^T: column j is r x (row j of B').
  const Vec b0 = cross(r, Vec{B[0], B[1], B[2]}), b1 = cross(r, Vec{B[3], B[4], B[5]}),
            b2 = cross(r, Vec{B[6], B[7], B[8]});
  const Vec c0 = cross(r, Vec{C[0], C[1], C[2]}), c1 = cross(r, Vec{C[3], C[4], C[5]}),
            c2 = cross(r, Vec{C[6], C[7], C[8]});
  Sym3<double>& A = parent.A;
  A.xx += work.A.xx + b0.x + c0.x;
  A.yy += work.A.yy + b1.y + c1.y;
  A.zz += work.A.zz + b2.z + c2.z;
  A.xy += work.A.xy + b0.y + c1.x;
  A.xz += work.A.xz + b0.z + c2.x;
  A.yz += work.A.yz + b1.z + c2.y;
  for (int k = 0; k < 9; ++k) parent.B.m[k] += C[k];
  parent.M.xx += M.xx, parent.M.yy += M.yy, parent.M.zz += M.zz;
  parent.M.xy += M.xy, parent.M.xz += M.xz, parent.M.yz += M.yz;
  parent.p_a += work.p_a + cross(r, work.p_l);
  parent.p_l += work.p_l;
}

void Articulated::eliminate(const TreeLayout& layout, const Tree& tree, std::span<const double> v,
                            std::span<const double> efforts) {
  for (std::uint32_t i = tree.links_end; i-- > tree.links_begin;) {
    const TreeLink& link = layout.links[i];
    LinkWork& work = work_[i];
    with_model(link, [&](auto model) { eliminate_link<decltype(model)::kRates>(link, work, v, efforts); });
    if (link.parent >= 0) shift_to_parent(work, work_[static_cast<std::size_t>(link.parent)]);
  }
}

template <int N>
void Articulated::substitute_link(const TreeLink& link, LinkWork& work, const Vec& dal, const Vec& da,
                                  std::span<double> v_dot) {
  // L^T v' = d^-1 (L^-1 (u - U^T da')), with U and u already multiplied by L^-1.
  double x[kMostRates];
  const std::array<double, 6>* D = D_.data() + link.v;
  work.dal = dal;
  work.da = da;
  for (int j = N - 1; j >= 0; --j) {
    const auto J = static_cast<std::uint32_t>(j);
    x[j] = (u_[link.v + J] - dot(U_a_[link.v + J], dal) - dot(U_l_[link.v + J], da)) / D[j][J];
    for (int k = j + 1; k < N; ++k) x[j] -= D[k][J] * x[k];
    v_dot[link.v + J] = x[j];
    work.dal += x[j] * S_a_[link.v + J];
    work.da += x[j] * S_l_[link.v + J];
  }
}

void Articulated::substitute(const TreeLayout& layout, const Tree& tree, std::span<double> v_dot) {
  for (std::uint32_t i = tree.links_begin; i < tree.links_end; ++i) {
    const TreeLink& link = layout.links[i];
    LinkWork& work = work_[i];
    Vec dal, da;
    if (link.parent >= 0) {
      const LinkWork& parent = work_[static_cast<std::size_t>(link.parent)];
      dal = parent.dal;
      da = parent.da + cross(parent.dal, work.r);
    }
    with_model(link,
               [&](auto model) { substitute_link<decltype(model)::kRates>(link, work, dal, da, v_dot); });
  }
}

bool Articulated::is_singular(const TreeLayout& layout, std::int32_t index) const {
  const TreeLink& link = layout.links[static_cast<std::size_t>(index)];
  bool singular = false;
  with_model(link, [&](auto model) {
    for (std::uint32_t j = 0; j < decltype(model)::kRates; ++j) {
      const double d = D_[link.v + j][j];
      singular = singular || d <= 1e-12 * scale_[link.v + j];
    }
  });
  return singular;
}

}  // namespace pantin
