// Masses of bodies. Bodies that Fixed joints make one are judged as one: a member whose own mass no body can
// have is carried by the top one if the sum is sound.
#include <algorithm>

#include <pantin/bridge/bits.hpp>
#include <pantin/bridge/bridge_impl.hpp>

namespace pantin {
namespace {

const MassProperties kMassless{0, Vector3::Zero(), Matrix3::Zero()};

bool same(const MassProperties& a, const MassProperties& b) {
  return a.mass == b.mass && a.p_BBcm == b.p_BBcm && a.I_BBcm_B == b.I_BBcm_B;
}

}  // namespace

DerivedMass Bridge::Impl::weigh(NodeId id, const Affine& M_BN, double density,
                                const std::unordered_set<NodeId>* also_bound) const {
  const auto is_bound = [&](NodeId node) {
    return find(node) != nullptr || (also_bound != nullptr && also_bound->contains(node));
  };
  return derive_mass({scene, node_bodies, is_bound}, id, M_BN, density);
}

// A body that would be left with nothing (all its mass came from nodes below that are gone) keeps what it
// had: without mass it could not be simulated.
void Bridge::Impl::reweigh(Binding* binding) {
  if (binding == nullptr) return;
  const DerivedMass derived = weigh(binding->node, binding->M_BN, binding->density);
  if (!derived.known) return;
  binding->own_mass = derived.mass;
  if (!binding->shares_mass && !problem_with(binding->own_mass, InertiaCheck::Solvable)) {
    set_mass(*binding, binding->own_mass);
  }
}

void Bridge::Impl::set_mass(Binding& binding, const MassProperties& mass) {
  const RigidBody body = physics.body(binding.body);
  if (same(body.mass_properties(), mass)) return;
  const bool is_written = same_bits(body.X_WB(), binding.X_WB_written);
  physics.set_mass_properties(binding.body, mass, InertiaCheck::Solvable);
  if (is_written) binding.X_WB_written = physics.body(binding.body).X_WB();  // rounded anew
}

Binding& Bridge::Impl::composite_top(Binding& binding) const {
  Binding* top = &binding;
  while (top->drive == Drive::Physics && top->above != nullptr && top->above->drive == Drive::Physics) {
    const JointTie tie = wanted_tie(*top);
    if (tie.kind != JointTie::Kind::Link || tie.link != LinkKind::Fixed) break;
    top = top->above;
  }
  return *top;
}

void Bridge::Impl::assign_masses(std::span<Binding* const> affected, std::vector<Diagnostic>& notes) {
  std::vector<Binding*> tops;  // of composites in which a mass is unsound, or was
  const auto look_at = [&](Binding& binding) {
    const bool unsound = problem_with(binding.own_mass, InertiaCheck::Solvable).has_value();
    if (!unsound && !binding.shares_mass) return set_mass(binding, binding.own_mass);
    Binding* top = &composite_top(binding);
    if (std::find(tops.begin(), tops.end(), top) == tops.end()) tops.push_back(top);
  };
  for (Binding* binding : affected) look_at(*binding);
  const std::vector<Binding*> before = sharing;
  for (Binding* binding : before) look_at(*binding);
  for (Binding* top : tops) assign_composite(*top, notes);
}

void Bridge::Impl::assign_composite(Binding& top, std::vector<Diagnostic>& notes) {
  std::vector<Binding*> members;
  std::vector<MassProperties> parts;
  const Binding* unsound = nullptr;
  const Pose X_TW = inverse(physics.body(top.body).X_WB());
  for (Binding* binding : ordered()) {
    if (&composite_top(*binding) != &top) continue;
    members.push_back(binding);
    parts.push_back(in_frame(X_TW * physics.body(binding->body).X_WB(), binding->own_mass));
    if (problem_with(binding->own_mass, InertiaCheck::Solvable)) unsound = binding;
  }
  for (Binding* member : members) {
    member->shares_mass = unsound != nullptr;
    std::erase(sharing, member);
    if (member->shares_mass) sharing.push_back(member);
  }
  if (unsound == nullptr) {
    for (Binding* member : members) set_mass(*member, member->own_mass);
    return;
  }
  const JointTie tie = wanted_tie(top);
  const bool moves =
      top.drive == Drive::Physics && !(tie.kind == JointTie::Kind::Link && tie.link == LinkKind::Fixed);
  const MassProperties whole = combined(parts);
  const std::optional<SettingsProblem> problem = problem_with(whole, InertiaCheck::Solvable);
  if (problem && moves) {
    const bool alone = members.size() == 1;
    notes.push_back(note(Severity::Error, top.node,
                         (alone ? "" : "together with what is fixed to it: ") + problem->text,
                         problem->remedy));
    return;
  }
  for (Binding* member : members) set_mass(*member, member == &top && !problem ? whole : kMassless);
  const SettingsProblem own = *problem_with(unsound->own_mass, InertiaCheck::Solvable);
  notes.push_back(
      note(Severity::Warning, unsound->node, own.text,
           problem ? "it is not moved by forces, so it was taken for massless"
                   : "the mass of all that is fixed together was given to '" + scene.name(top.node) + "'"));
}

}  // namespace pantin
