#include <pantin/physics/deflectors/sweep.hpp>

#include <algorithm>
#include <limits>

namespace pantin {

namespace {

constexpr double kNever = 2;    // a fraction of the update that does not come
constexpr double kDeep = 1e-9;  // of radius and distance from the world's origin

}  // namespace

void Sweep::cull(const CullBatch& batch) {
  for (const Deflector& d : deflectors_.all()) d.shape->cull(d.motion, batch);
}

Sweep::Met Sweep::first_met(const MovingParticle& particle, const Deflector* slides_on) {
  Met met;
  double first = kNever;
  for (Deflector& d : deflectors_.all()) {
    if (&d == slides_on) continue;
    const RelativePath path{particle.path, d.motion};
    const std::optional<SurfaceContact> contact =
        d.shape->first_contact(path, particle.path.s0, particle.radius, triangles_);
    if (!contact || !(contact->s < first)) continue;
    first = contact->s;
    met = {&d, *contact};
  }
  return met;
}

Deflector* Sweep::carry(MovingParticle& particle) {
  const Deflector* slides_on = nullptr;
  for (int k = 0; k < kMostContacts; ++k) {
    const Met met = first_met(particle, slides_on);
    if (met.deflector == nullptr) return nullptr;
    ++met.deflector->hits;
    ++counts.deflections;
    const SolidShape* solid = met.deflector->shape->as_solid();
    // What lies on a surface is a rounding inside of it: only more than that counts.
    if (solid != nullptr && met.contact.depth > kDeep * (particle.radius + particle.path.p.norm())) {
      ++counts.pushed_out;
    }
    const Response response = respond(particle, met.contact, *met.deflector, deflectors_);
    if (response == Response::Sticks) {
      ++counts.stuck;
      return met.deflector;
    }
    // What slides along a convex solid cannot meet it again within the update.
    slides_on = response == Response::Slides && solid != nullptr ? met.deflector : nullptr;
  }
  ++counts.unresolved;
  particle.v_end = particle.path.velocity(particle.path.s0);
  particle.ends_otherwise = true;
  particle.path.v.setZero();
  particle.path.a.setZero();
  return nullptr;
}

}  // namespace pantin
