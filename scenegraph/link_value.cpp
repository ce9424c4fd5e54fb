#include <algorithm>
#include <cmath>

#include <pantin/scenegraph/expects.hpp>
#include <pantin/scenegraph/link.hpp>

namespace pantin {

int value_size(LinkKind kind) noexcept {
  switch (kind) {
    case LinkKind::Fixed:
      return 0;
    case LinkKind::Pivot:
    case LinkKind::Slider:
    case LinkKind::Screw:
      return 1;
    case LinkKind::Cylindrical:
    case LinkKind::Universal:
      return 2;
    case LinkKind::Planar:
      return 3;
    case LinkKind::Ball:
      return 4;
    case LinkKind::Free:
      return 7;
  }
  return 0;
}

int limit_count(LinkKind kind) noexcept { return has_axis(kind) ? value_size(kind) : 0; }

bool has_axis(LinkKind kind) noexcept {
  return kind != LinkKind::Fixed && kind != LinkKind::Ball && kind != LinkKind::Free;
}

bool has_axis2(LinkKind kind) noexcept { return kind == LinkKind::Universal || kind == LinkKind::Planar; }

std::string_view to_string(LinkKind kind) noexcept {
  switch (kind) {
    case LinkKind::Fixed:
      return "fixed";
    case LinkKind::Pivot:
      return "pivot";
    case LinkKind::Slider:
      return "slider";
    case LinkKind::Ball:
      return "ball";
    case LinkKind::Cylindrical:
      return "cylindrical";
    case LinkKind::Universal:
      return "universal";
    case LinkKind::Planar:
      return "planar";
    case LinkKind::Screw:
      return "screw";
    case LinkKind::Free:
      return "free";
  }
  return "";
}

LinkValue::LinkValue(std::initializer_list<double> numbers)
    : LinkValue{std::span<const double>{numbers.begin(), numbers.size()}} {}

LinkValue::LinkValue(std::span<const double> numbers) {
  PANTIN_EXPECTS(numbers.size() <= numbers_.size(),
                 "a link value has at most 7 numbers, not " + std::to_string(numbers.size()));
  std::copy(numbers.begin(), numbers.end(), numbers_.begin());
  size_ = static_cast<int>(numbers.size());
}

LinkValue zero_value(LinkKind kind) {
  switch (kind) {
    case LinkKind::Fixed:
      return {};
    case LinkKind::Pivot:
    case LinkKind::Slider:
    case LinkKind::Screw:
      return LinkValue{0.0};
    case LinkKind::Cylindrical:
    case LinkKind::Universal:
      return {0, 0};
    case LinkKind::Planar:
      return {0, 0, 0};
    case LinkKind::Ball:
      return {1, 0, 0, 0};
    case LinkKind::Free:
      return {0, 0, 0, 1, 0, 0, 0};
  }
  return {};
}

std::string problem_with(LinkKind kind, const LinkValue& value) {
  const std::size_t size = static_cast<std::size_t>(value_size(kind));
  const std::span<const double> numbers = value.numbers();
  if (numbers.size() != size)
    return "a " + std::string{to_string(kind)} + " link's value has " + std::to_string(size) +
           " numbers, not " + std::to_string(numbers.size());
  if (!std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); }))
    return "value has a number that is not finite";
  if (size < 4) return {};
  const Eigen::Map<const Eigen::Vector4d> q{numbers.data() + size - 4};
  if (!(q.stableNorm() > 0)) return "value has a quaternion of length 0; the identity is 1, 0, 0, 0";
  return {};
}

}  // namespace pantin
