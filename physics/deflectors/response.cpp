// With n the normal, v the velocity against the surface at the contact, a the acceleration against it, m the
// mass of the particle, 1/m_n = 1/m + 1/M + (I^-1 (r x n)) x r . n that of particle and body together along
// n:
//   approach and rebound    J = -(1 + e) m_n (v . n)
//   friction (Coulomb)      |J_t| <= mu J, against the sliding, at most until it ends
//   pressed to the surface  where the rebound would be over within a tenth of the update: e = 0, a loses its
//   part along
//                           n, which is the load; friction takes up to mu |a . n| from the sliding
// The particle's share of an impulse is all that it gets from the surface; the body gets the opposite.
#include <pantin/physics/deflectors/response.hpp>

#include <algorithm>
#include <cmath>

namespace pantin {
namespace {

constexpr double kShortestFlight = 0.1;  // of the update

/// 1 / (effective mass) along a direction.
double mobility(const MovingParticle& particle, const StruckBody* body, const Vector3& r,
                const Vector3& direction) {
  double sum = 1 / particle.mass;
  if (body != nullptr) {
    const Vector3 turn = body->inverse_inertia_W * r.cross(direction);
    sum += body->inverse_mass + turn.cross(r).dot(direction);
  }
  return sum;
}

struct Site {
  Vector3 p{Vector3::Zero()}, n{Vector3::UnitZ()}, r{Vector3::Zero()};
  double left{0};  ///< of the update [s]
  Vector3 a_surface{Vector3::Zero()};
};

Site site_of(const ParticlePath& path, const SurfaceContact& contact, const DeflectorMotion& motion) {
  Site site;
  site.n = motion.rotation(contact.s) * contact.normal_D;
  site.p = path.at(contact.s) + contact.depth * site.n;
  // A particle does not spin: what it gets acts at its centre, and so does the reaction.
  site.r = site.p - motion.centre(contact.s);
  site.left = (1 - contact.s) * path.h;
  site.a_surface = motion.centre_curvature() / (motion.duration() * motion.duration());
  return site;
}

/// The way of a particle that stays on the surface: `v` is its velocity against it, along it.
void slide(MovingParticle& particle, const Site& site, const Vector3& v_surface, const Vector3& v,
           const Vector3& a, double friction) {
  const double pressing = std::max(0.0, -a.dot(site.n));
  const Vector3 along = a + pressing * site.n;  // what pulls it off the surface stays
  const double brake = friction * pressing, speed = v.norm(), T = site.left;
  const Vector3 free_end = v + T * along;
  Vector3 end = Vector3::Zero(), way = Vector3::Zero();
  const double free_speed = free_end.norm();
  if (free_speed > brake * T) {
    end = (1 - brake * T / free_speed) * free_end;
    way = 0.5 * T * (v + end);
  } else if (speed > 0) {  // comes to rest within the update
    const double net = brake - along.dot(v) / speed;
    const double stops_after = net > 0 ? std::min(T, speed / net) : T;
    way = 0.5 * stops_after * v;
  }
  particle.path.v = v_surface + (T > 0 ? Vector3{way / T} : Vector3::Zero());
  particle.path.a = site.a_surface;
  particle.v_end = v_surface + T * site.a_surface + end;
  particle.ends_otherwise = true;
}

}  // namespace

Response respond(MovingParticle& particle, const SurfaceContact& contact, const Deflector& deflector,
                 DeflectorManager& deflectors) {
  const DeflectorMotion& motion = deflector.motion;
  const SurfaceSettings& surface = deflector.surface;
  ParticlePath& path = particle.path;
  const double h = path.h, s = contact.s;
  const Vector3 v = path.velocity(s);
  const Site site = site_of(path, contact, motion);
  const StruckBody* body = deflectors.struck(deflector);
  const auto surface_velocity = [&] {
    Vector3 u = motion.velocity(site.p, s);
    if (body != nullptr) u += body->dv + body->dw.cross(site.r);
    return u;
  };
  const Vector3 a = path.a;
  const Vector3 a_against = a - site.a_surface;
  Vector3 v_against = v - surface_velocity();
  const double leaving = v_against.dot(site.n);
  const double pull = -a_against.dot(site.n);
  double rebound = leaving < 0 ? -surface.restitution * leaving : leaving;
  const bool pressed = rebound <= 0 || 2 * rebound < kShortestFlight * h * pull;
  if (pressed) rebound = 0;
  const bool sticks = surface.stickiness > 0 && rebound <= surface.stickiness;

  Vector3 total = Vector3::Zero();  // impulse on the particle
  const auto give = [&](const Vector3& j) {
    total += j;
    deflectors.react(deflector, j, site.p.cross(j));
    v_against = v + total / particle.mass - surface_velocity();
  };
  const double bounce = std::max(0.0, rebound - leaving) / mobility(particle, body, site.r, site.n);
  give(bounce * site.n);
  Vector3 sliding = v_against - v_against.dot(site.n) * site.n;
  const double speed = sliding.norm();
  const double grip = sticks ? std::numeric_limits<double>::infinity() : surface.friction * bounce;
  if (speed > 0 && grip > 0) {
    const Vector3 direction = sliding / speed;
    give(-std::min(grip, speed / mobility(particle, body, site.r, direction)) * direction);
    sliding = v_against - v_against.dot(site.n) * site.n;
  }

  path.p = site.p;
  path.s0 = s;
  path.v = v + total / particle.mass;
  path.a = a;
  particle.ends_otherwise = false;
  if (sticks) return Response::Sticks;
  if (!pressed) return Response::Bounced;
  slide(particle, site, path.v - sliding, sliding, a_against, surface.friction);
  // What pressing and friction did until the end of the update: the difference to a free flight.
  const ParticlePath free{site.p, v + total / particle.mass, a, s, h};
  const Vector3 linear = particle.mass * (particle.v_end - free.velocity(1));
  deflectors.react(
      deflector, linear,
      particle.mass * (particle.end_position().cross(particle.v_end) - free.at(1).cross(free.velocity(1))));
  return Response::Slides;
}

}  // namespace pantin
