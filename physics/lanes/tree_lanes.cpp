#include <pantin/physics/lanes/tree_lanes.hpp>

#include <algorithm>
#include <array>
#include <string>

#include <pantin/physics/expects.hpp>

namespace pantin::lanes {

extern const Kernel kSse2Kernel;
#if defined(__x86_64__)
extern const Kernel kAvx2Kernel, kAvx512Kernel;
#endif

std::string_view to_string(InstructionSet set) noexcept {
  return set == InstructionSet::Sse2 ? "sse2" : set == InstructionSet::Avx2 ? "avx2" : "avx512";
}

std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets{InstructionSet::Sse2};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) sets.push_back(InstructionSet::Avx2);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
    sets.push_back(InstructionSet::Avx512);
#endif
  return sets;
}

namespace {

const std::vector<const Kernel*>& kernels_here() {
  static const std::vector<const Kernel*> kernels = [] {
    std::vector<const Kernel*> found;
    for (const InstructionSet set : instruction_sets()) {
#if defined(__x86_64__)
      if (set == InstructionSet::Avx2) found.push_back(&kAvx2Kernel);
      if (set == InstructionSet::Avx512) found.push_back(&kAvx512Kernel);
#endif
      if (set == InstructionSet::Sse2) found.push_back(&kSse2Kernel);
    }
    return found;
  }();
  return kernels;
}

}  // namespace

const Kernel& kernel_for(InstructionSet set) {
  const Kernel* found = nullptr;
  for (const Kernel* kernel : kernels_here()) {
    if (kernel->set == set) found = kernel;
  }
  PANTIN_EXPECTS(found != nullptr,
                 "this machine has no " + std::string{to_string(set)} + "; ask instruction_sets()");
  return *found;
}

const Kernel* kernel_for_stages(std::size_t stages) {
  // Asked for at every sweep: found once for each number of stages.
  static const std::array<const Kernel*, kMostNodes + 1> widest = [] {
    std::array<const Kernel*, kMostNodes + 1> found{};
    for (const Kernel* kernel : kernels_here()) {
      for (auto n = static_cast<std::size_t>(kernel->lanes); n < found.size(); ++n)
        if (n % static_cast<std::size_t>(kernel->lanes) == 0) found[n] = kernel;
    }
    return found;
  }();
  return stages < widest.size() ? widest[stages] : nullptr;
}

void put_motion(const RigidMotion& motion, std::size_t lanes, double* out) {
  const Matrix3 R = motion.X_AB.rotation();
  for (int k = 0; k < 9; ++k) out[static_cast<std::size_t>(k) * lanes] = R(k / 3, k % 3);
  const Vector3* vectors[] = {&motion.X_AB.p, &motion.w_AB, &motion.v_AB, &motion.alpha_AB, &motion.a_AB};
  double* to = out + 9 * lanes;
  for (const Vector3* vector : vectors) {
    for (int k = 0; k < 3; ++k, to += lanes) *to = (*vector)[k];
  }
}

double* AlignedRoom::data() {
  const auto address = reinterpret_cast<std::uintptr_t>(room_.data());
  return room_.data() + (64 - address % 64) % 64 / sizeof(double);
}

namespace {

void fill(const TreeLink& link, const BodyStore& bodies, std::int32_t& given, LinkConstants& c) {
  c = {};
  c.parent = link.parent, c.kind = link.kind, c.q = link.q, c.v = link.v, c.pitch = link.pitch;
  if (link.parent < 0 && link.ground >= 0 &&
      bodies.kinds[static_cast<std::size_t>(link.ground)] != BodyKind::Simulated) {
    c.ground = given++;
  }
  if (link.driver != nullptr) c.given = given++;
  std::copy_n(link.R_PJ.m, 9, c.R_PJ);
  const kernel::Vec3<double>&p = link.p_PJ, &h = link.moment;
  const kernel::Sym3<double>& I = link.inertia;
  c.p_PJ[0] = p.x, c.p_PJ[1] = p.y, c.p_PJ[2] = p.z;
  c.mass = link.mass;
  c.moment[0] = h.x, c.moment[1] = h.y, c.moment[2] = h.z;
  c.inertia[0] = I.xx, c.inertia[1] = I.yy, c.inertia[2] = I.zz;
  c.inertia[3] = I.xy, c.inertia[4] = I.xz, c.inertia[5] = I.yz;
  std::copy(link.damping.begin(), link.damping.end(), c.damping);
  std::copy(link.armature.begin(), link.armature.end(), c.armature);
  c.is_damped = link.damping != std::array<double, 3>{};
  c.is_loaded = link.is_loaded;
}

}  // namespace

std::int32_t fill_constants(const TreeLayout& layout, const BodyStore& bodies,
                            std::vector<LinkConstants>& links, std::vector<FreeConstants>& free) {
  links.resize(layout.links.size());
  std::int32_t given = 0;
  for (std::size_t i = 0; i < links.size(); ++i) fill(layout.links[i], bodies, given, links[i]);
  for (std::size_t i = links.size(); i-- > 0;) {
    if (links[i].parent < 0) continue;
    LinkConstants& up = links[static_cast<std::size_t>(links[i].parent)];
    links[i].first_child = up.leaf;
    up.leaf = false;
  }
  free.resize(layout.free_bodies.size());
  for (std::size_t i = 0; i < free.size(); ++i) {
    const std::size_t body = layout.free_bodies[i];
    free[i].inverse_mass = 1 / bodies.mass[body].mass;
    for (int k = 0; k < 9; ++k) free[i].inverse_inertia[k] = bodies.inverse_inertia[body](k / 3, k % 3);
  }
  return given;
}

}  // namespace pantin::lanes
