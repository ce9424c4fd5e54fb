#include <pantin/physics/integrators/motion_record.hpp>

#include <algorithm>
#include <string>

#include <pantin/physics/expects.hpp>

namespace pantin {

void MotionRecord::clear() noexcept {
  parts_.clear();
  coefficients_.clear();
}

void MotionRecord::keep_first(std::size_t parts) {
  if (parts >= parts_.size()) return;
  coefficients_.resize(parts_[parts].first);
  parts_.resize(parts);
}

MotionRecord::Span MotionRecord::part(std::size_t i) const {
  return {parts_[i].t, parts_[i].h, parts_[i].degree};
}

void MotionRecord::coefficients(std::size_t i, std::size_t number, std::span<double> c) const {
  const Part& part = parts_[i];
  for (std::size_t k = 0; k <= part.degree; ++k) {
    c[k] = coefficients_[part.first + k * (part.q + part.v) + number];
  }
}

double MotionRecord::begin() const {
  PANTIN_EXPECTS(!empty(), "the record of the motion is empty; ask empty() first");
  return parts_.front().t;
}

double MotionRecord::end() const {
  PANTIN_EXPECTS(!empty(), "the record of the motion is empty; ask empty() first");
  return parts_.back().t + parts_.back().h;
}

MotionRecord::Room MotionRecord::add(double t, double h, std::size_t degree, std::span<const double> q,
                                     std::span<const double> v) {
  const std::size_t size = q.size() + v.size(), first = coefficients_.size();
  parts_.push_back({.t = t, .h = h, .degree = degree, .q = q.size(), .v = v.size(), .first = first});
  coefficients_.resize(first + (degree + 1) * size);
  const Room room{size, std::span<double>{coefficients_}.subspan(first)};
  std::copy(q.begin(), q.end(), room.c.begin());
  std::copy(v.begin(), v.end(), room.c.begin() + static_cast<std::ptrdiff_t>(q.size()));
  return room;
}

void MotionRecord::fit_cubic(const Room& part, double h) {
  for (std::size_t i = 0; i < part.size; ++i) {
    const double change = part.at(1)[i] - part.at(0)[i];
    const double slope_begin = h * part.at(3)[i], slope_end = h * part.at(2)[i];
    part.at(1)[i] = slope_begin;
    part.at(2)[i] = 3 * change - 2 * slope_begin - slope_end;
    part.at(3)[i] = slope_begin + slope_end - 2 * change;
  }
}

void MotionRecord::evaluate(double t, std::span<double> q, std::span<double> v) const {
  PANTIN_EXPECTS(!empty() && t >= begin() && t <= end(),
                 "time " + std::to_string(t) + " s is outside of the motion that was recorded");
  const auto found =
      std::find_if(parts_.begin(), parts_.end(), [t](const Part& part) { return t <= part.t + part.h; });
  const Part& part = found != parts_.end() ? *found : parts_.back();
  PANTIN_EXPECTS(q.size() <= part.q && v.size() <= part.v,
                 "more numbers are asked for than were recorded; the bodies have changed since");
  const double x = std::clamp((t - part.t) / part.h, 0.0, 1.0);
  const std::size_t size = part.q + part.v;
  const auto polynomial = [&](std::size_t i) {
    double y = 0;
    for (std::size_t k = part.degree + 1; k-- > 0;) y = y * x + coefficients_[part.first + k * size + i];
    return y;
  };
  for (std::size_t i = 0; i < q.size(); ++i) q[i] = polynomial(i);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = polynomial(part.q + i);
}

}  // namespace pantin
