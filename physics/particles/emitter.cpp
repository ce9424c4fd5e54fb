#include <pantin/physics/particles/emitter.hpp>

#include <cmath>
#include <numbers>
#include <string>

#include <pantin/physics/random_draws.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

double between(RandomDraws& draw, const Range& range) {
  const double u = draw();
  return range.least == range.most ? range.least : range.least + u * (range.most - range.least);
}

/// Evenly over the cap of the unit sphere around z whose cosine is at least `lowest`.
Vector3 direction(RandomDraws& draw, double lowest) {
  const double z = 1 - draw() * (1 - lowest), phi = 2 * std::numbers::pi * draw();
  const double r = std::sqrt(std::max(0.0, 1 - z * z));
  return {r * std::cos(phi), r * std::sin(phi), z};
}

Vector3 place(RandomDraws& draw, const EmitterSettings& settings) {
  switch (settings.region) {
    case EmitterRegion::Point:
      return Vector3::Zero();
    case EmitterRegion::Sphere: {
      const Vector3 to = direction(draw, -1);
      return settings.size.x() * std::cbrt(draw()) * to;
    }
    case EmitterRegion::Disc: {
      const double phi = 2 * std::numbers::pi * draw(), r = settings.size.x() * std::sqrt(draw());
      return {r * std::cos(phi), r * std::sin(phi), 0};
    }
    case EmitterRegion::Box: {
      const double x = draw(), y = draw(), z = draw();
      return settings.size.cwiseProduct(Vector3{x - 0.5, y - 0.5, z - 0.5});
    }
  }
  return Vector3::Zero();
}

std::optional<SettingsProblem> range_problem(const SettingName& name, const Range& range) {
  if (range.least <= range.most) return std::nullopt;
  return SettingsProblem{ProblemCode::OutOfRange,
                         std::string{name.subject} + ": " + std::string{name.setting} + " goes from " +
                             text_of(range.least) + " to " + text_of(range.most),
                         "give the lesser number first"};
}

std::optional<SettingsProblem> time_problem(const EmitterSettings& settings) {
  if (!(settings.stop >= settings.start)) {
    return SettingsProblem{ProblemCode::OutOfRange,
                           "emitter: it stops at " + text_of(settings.stop) + " s, before it starts at " +
                               text_of(settings.start) + " s",
                           "give a stop that is not before the start"};
  }
  if (!(settings.lifetime.least > 0)) {
    return SettingsProblem{
        ProblemCode::OutOfRange,
        "emitter: lifetime is " + text_of(settings.lifetime.least) + " s; it must be more than zero",
        "give a lifetime above zero, or infinity"};
  }
  if (settings.lifetime.least < settings.lifetime.most && std::isinf(settings.lifetime.most)) {
    return SettingsProblem{ProblemCode::NotFinite, "emitter: lifetime is spread up to infinity",
                           "give a finite range, or infinity for all"};
  }
  for (std::size_t k = 0; k < settings.bursts.size(); ++k) {
    const double time = settings.bursts[k].time;
    if (!std::isfinite(time) || (k > 0 && time < settings.bursts[k - 1].time)) {
      return SettingsProblem{ProblemCode::OutOfRange,
                             "emitter: burst " + std::to_string(k) + " is at " + text_of(time) + " s",
                             "give finite times in ascending order"};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<SettingsProblem> problem_with(const EmitterSettings& settings) {
  if (settings.spread > std::numbers::pi) {
    return SettingsProblem{ProblemCode::OutOfRange,
                           "emitter: spread is " + text_of(settings.spread) + " rad; it must be at most pi",
                           "give a half angle from 0 to pi"};
  }
  return first_problem({must_be_finite({"emitter", "position", "m"}, settings.X_BE.p),
                        must_be_unit({"emitter", "orientation", ""}, settings.X_BE.q),
                        must_be_finite({"emitter", "size", "m"}, settings.size),
                        must_not_be_negative({"emitter", "size", "m"}, settings.size.minCoeff()),
                        must_not_be_negative({"emitter", "speed", "m/s"}, settings.speed.least),
                        must_be_finite({"emitter", "speed", "m/s"}, settings.speed.most),
                        range_problem({"emitter", "speed", "m/s"}, settings.speed),
                        must_not_be_negative({"emitter", "spread", "rad"}, settings.spread),
                        must_be_finite({"emitter", "inherit", ""}, settings.inherit),
                        must_not_be_negative({"emitter", "rate", "1/s"}, settings.rate),
                        must_be_finite({"emitter", "start", "s"}, settings.start),
                        range_problem({"emitter", "lifetime", "s"}, settings.lifetime),
                        time_problem(settings)});
}

Birth birth_of(const EmitterSettings& settings, std::uint64_t n) {
  RandomDraws draw{settings.seed, n};
  Birth birth;
  birth.p_EP = place(draw, settings);
  const Vector3 to = direction(draw, std::cos(settings.spread));
  birth.v_EP = between(draw, settings.speed) * to;
  birth.lifetime = between(draw, settings.lifetime);
  return birth;
}

}  // namespace pantin
