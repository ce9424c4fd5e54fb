#pragma once
// A link says how a node moves against its parent: which kind, about which axis, where zero is, how far, and
// the present value. It turns a value into a local matrix and a local matrix back into a value. It is
// geometry only: no mass, no force; the bridge makes a physics joint of it when the node is simulated.
#include <array>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <pantin/scenegraph/affine.hpp>

namespace pantin {

enum class LinkKind {
  Fixed,        ///< no motion, no value
  Pivot,        ///< rotation about `axis`; value: angle [rad], right-hand rule
  Slider,       ///< translation along `axis`; value: distance [m]
  Ball,         ///< free rotation; value: unit quaternion (w, x, y, z) of N in J
  Cylindrical,  ///< rotation about `axis` and translation along it; value: angle [rad], distance [m]
  Universal,    ///< rotation about `axis`, then about `axis2`, which it carries; value: two angles [rad]
  Planar,       ///< translation across `axis` and rotation about it; value: distances along `axis2` and along
                ///< axis x axis2 [m], angle [rad]
  Screw,        ///< rotation about `axis`, which moves along it by `pitch`; value: angle [rad]
  Free,         ///< anything rigid; value: translation (x, y, z) [m], then unit quaternion (w, x, y, z)
};

/// How many numbers a value of this kind has: 0, 1, 1, 4, 2, 2, 3, 1, 7.
[[nodiscard]] int value_size(LinkKind kind) noexcept;
/// How many numbers of its value may have limits: those that are not a quaternion; none of a Free link.
[[nodiscard]] int limit_count(LinkKind kind) noexcept;
[[nodiscard]] bool has_axis(LinkKind kind) noexcept;   ///< all but Fixed, Ball and Free
[[nodiscard]] bool has_axis2(LinkKind kind) noexcept;  ///< Universal and Planar
/// Lower-case name as used in JSON: "fixed", "pivot", "slider", "ball", "cylindrical", "universal", "planar",
/// "screw", "free".
[[nodiscard]] std::string_view to_string(LinkKind kind) noexcept;

/// The numbers of a link's value; how many and what they mean depends on the kind.
class LinkValue {
 public:
  LinkValue() = default;
  LinkValue(double number) : numbers_{number}, size_{1} {}  // NOLINT: a pivot's angle is a value
  LinkValue(std::initializer_list<double> numbers);         ///< at most 7
  explicit LinkValue(std::span<const double> numbers);      ///< at most 7

  [[nodiscard]] int size() const noexcept { return size_; }
  [[nodiscard]] double operator[](int i) const { return numbers_.at(static_cast<std::size_t>(i)); }
  [[nodiscard]] double& operator[](int i) { return numbers_.at(static_cast<std::size_t>(i)); }
  [[nodiscard]] std::span<const double> numbers() const noexcept {
    return {numbers_.data(), static_cast<std::size_t>(size_)};
  }
  friend bool operator==(const LinkValue&, const LinkValue&) = default;

 private:
  std::array<double, 7> numbers_{};
  int size_{0};
};

/// The value at which nothing is displaced: no numbers, 0, or an identity rotation.
[[nodiscard]] LinkValue zero_value(LinkKind kind);

/// The value follows another link's: value = multiplier * source + offset.
struct LinkMimic {
  std::string source;  ///< name of the link that leads
  double multiplier{1};
  double offset{0};  ///< [rad] or [m]
};

/// The range of one number of a value: lower <= upper.
struct LinkLimits {
  double lower{-std::numeric_limits<double>::infinity()};  ///< [rad] or [m]
  double upper{std::numeric_limits<double>::infinity()};   ///< [rad] or [m]
  [[nodiscard]] bool contain(double number) const noexcept { return lower <= number && number <= upper; }
  friend bool operator==(const LinkLimits&, const LinkLimits&) = default;
};

/// M_PN(value) = M_PJ * T(value) * M_JN. Zero is where T is the identity.
struct Link {
  LinkKind kind{LinkKind::Fixed};
  std::string name{};                  ///< may be empty
  Affine M_PJ{Affine::Identity()};     ///< joint frame in the parent node
  Affine M_JN{Affine::Identity()};     ///< node in the moved joint frame; not singular
  Vector3 axis{Vector3::UnitZ()};      ///< unit, in J; where has_axis(kind)
  Vector3 axis2{Vector3::UnitX()};     ///< unit, in J, perpendicular to axis; where has_axis2(kind)
  double pitch{0};                     ///< [m/rad], any sign; Screw only
  std::array<LinkLimits, 3> limits{};  ///< by number of the value; the first limit_count(kind) count
  std::optional<LinkMimic> mimic{};    ///< kinds whose value is one number
  LinkValue value{};                   ///< present value; its size fits the kind
};

/// The same link counted from elsewhere: where the given one has the value v, the result has v + offset, at
/// the same matrix, with limits and mimic shifted alike. For kinds without quaternion; as many numbers as a
/// value.
[[nodiscard]] Link with_zero_offset(Link link, const LinkValue& offset);

/// What is wrong with a value for a link of this kind (count, not finite, quaternion of length 0); empty if
/// nothing is.
[[nodiscard]] std::string problem_with(LinkKind kind, const LinkValue& value);
/// What is wrong with the settings (axis not unit, value of another size, singular frame, ...); empty if
/// nothing is.
[[nodiscard]] std::string problem_with(const Link& link);

/// The local matrix M_PN that the link has at `value`. Quaternions are normalised.
[[nodiscard]] Affine local_matrix(const Link& link, const LinkValue& value);

/// A value measured from a matrix, and how much of the matrix it does not explain.
struct LinkFit {
  LinkValue value{};
  double residual{0};  ///< greatest entry of |M_PN - local_matrix(link, value)|
};

/// The value at which T is nearest to inverse(M_PJ) * M_PN * inverse(M_JN), least squares over its entries:
/// rotation and translation each by themselves, but together for a Screw. Angles are those nearest to `near`,
/// so that whole turns are kept (a Screw's turns are read from its translation, unless its pitch is 0); a
/// quaternion has the sign nearest to `near`. `near` must fit the kind; where the matrix says nothing about
/// the angle (a flip about another axis), it is `near` itself. Limits are not applied.
[[nodiscard]] LinkFit fit_link(const Link& link, const Affine& M_PN, const LinkValue& near);

}  // namespace pantin
