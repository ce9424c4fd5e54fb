// Differences by groups: one number of every group is changed at a time (A. R. Curtis, M. J. D. Powell, J. K.
// Reid, On the estimation of sparse Jacobian matrices, 1974), several such states side by side.
#include <pantin/physics/integrators/jacobian.hpp>

#include <algorithm>
#include <numeric>

#include <pantin/physics/integrators/integrator.hpp>

namespace pantin {

void NumberGroups::clear() {
  numbers_.clear();
  ends_.clear();
}

void NumberGroups::add(std::size_t first, std::size_t count) {
  for (std::size_t i = first; i < first + count; ++i) numbers_.push_back(static_cast<std::uint32_t>(i));
}

void NumberGroups::end_group() {
  if (numbers_.size() > (ends_.empty() ? 0 : ends_.back())) ends_.push_back(numbers_.size());
}

std::span<const std::uint32_t> NumberGroups::group(std::size_t g) const {
  const std::size_t begin = g == 0 ? 0 : ends_[g - 1];
  return std::span{numbers_}.subspan(begin, ends_[g] - begin);
}

std::size_t NumberGroups::largest() const noexcept {
  std::size_t most = 0;
  for (std::size_t g = 0; g < size(); ++g) most = std::max(most, group(g).size());
  return most;
}

void Jacobian::fit() {
  begins_.assign(1, 0);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const std::size_t k = groups.group(g).size();
    begins_.push_back(begins_.back() + k * k);
  }
  entries_.assign(begins_.back(), 0.0);
}

void Dynamics::list_groups(NumberGroups& groups) {
  groups.clear();
  groups.add(0, coordinates() + velocities());
  groups.end_group();
}

void Dynamics::jacobian(const JacobianPoint& point, Jacobian& J) { take_differences(point, J); }

void Dynamics::take_differences(const JacobianPoint& point, Jacobian& J) {
  differences_.wanted.resize(J.groups.size());
  std::iota(differences_.wanted.begin(), differences_.wanted.end(), std::size_t{0});
  take_differences(point, differences_.wanted, J);
}

void Dynamics::take_differences(const JacobianPoint& point, std::span<const std::size_t> wanted,
                                Jacobian& J) {
  std::size_t most = 0;
  for (const std::size_t g : wanted) most = std::max(most, J.groups.group(g).size());
  for (std::size_t first = 0; first < most;) {
    const std::size_t count = most - first >= kSideBySide ? kSideBySide : 1;
    take_columns(point, wanted, first, count, J);
    first += count;
  }
}

void Dynamics::take_columns(const JacobianPoint& point, std::span<const std::size_t> wanted,
                            std::size_t first, std::size_t count, Jacobian& J) {
  const std::size_t nq = point.q.size(), n = nq + point.v.size();
  Differences& room = differences_;
  room.state.resize(n * kSideBySide);
  room.slope.resize(n * kSideBySide);
  room.at.assign(count, point.at);
  for (std::size_t i = 0; i < n; ++i) {
    std::fill_n(room.state.begin() + static_cast<std::ptrdiff_t>(i * count), count,
                i < nq ? point.q[i] : point.v[i - nq]);
  }
  const auto each_column = [&](const auto& visit) {
    for (const std::size_t g : wanted) {
      const std::span<const std::uint32_t> numbers = J.groups.group(g);
      for (std::size_t s = 0; s < count && first + s < numbers.size(); ++s) visit(g, numbers, s);
    }
  };
  each_column([&](std::size_t, std::span<const std::uint32_t> numbers, std::size_t s) {
    const std::size_t j = numbers[first + s];
    room.state[j * count + s] += point.change[j];
  });
  const std::span<double> y = std::span{room.state}.first(n * count),
                          f = std::span{room.slope}.first(n * count);
  if (count == 1) {
    derivative(point.at, y.first(nq), y.subspan(nq), f.first(nq), f.subspan(nq));
  } else {
    derivatives(
        {room.at, y.first(nq * count), y.subspan(nq * count), f.first(nq * count), f.subspan(nq * count)});
  }
  each_column([&](std::size_t g, std::span<const std::uint32_t> numbers, std::size_t s) {
    const std::size_t k = numbers.size(), j = numbers[first + s];
    const std::span<double> column = J.block(g).subspan((first + s) * k, k);
    for (std::size_t i = 0; i < k; ++i) {
      column[i] = (f[numbers[i] * count + s] - point.slope[numbers[i]]) / point.change[j];
    }
  });
}

}  // namespace pantin
