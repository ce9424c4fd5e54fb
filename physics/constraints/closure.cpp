#include <pantin/physics/constraints/closure.hpp>

#include <cmath>

#include <pantin/physics/constraints/joint_models.hpp>

namespace pantin {

namespace {

using kernel::dot;
using kernel::Mat3;
using Vec = kernel::Vec3<double>;

double length(const Vec& v) { return std::sqrt(dot(v, v)); }

/// Writes the rows of one closure.
class Rows {
 public:
  Rows(const Closure& closure, const ClosureMotion& m, ClosureRow* out)
      : pair_{m.a, m.b},
        pitch_{closure.pitch},
        next_{out},
        size_{length(m.a.p) + length(m.b.p)},
        speed_{length(m.a.v) + length(m.b.v)},
        spin_{length(m.a.w) + length(m.b.w)} {}

  void across(int i) { write(pair_.along(pair_.a().R.column(i)), size_, speed_); }
  void square(int i, int j) { write(pair_.square(i, j), 1, spin_); }
  void threaded() {
    const Mat3<double>&A = pair_.a().R, &B = pair_.b().R;
    const Vec x = A.column(0), y = A.column(1), z = A.column(2), x_b = B.column(0), y_b = B.column(1);
    const kernel::RowTerms<double> distance = pair_.along(z), turn = pair_.about(z, pair_.a().w);
    const double angle = std::atan2(dot(y, x_b) - dot(x, y_b), dot(x, x_b) + dot(y, y_b));
    const double turns =
        pitch_ == 0 ? 0 : std::round((distance.gap / pitch_ - angle) / (2 * M_PI));  // the nearest thread
    write({distance.force, -pitch_ * z, distance.gap - pitch_ * (angle + 2 * M_PI * turns),
           distance.rate - pitch_ * turn.rate, distance.acceleration - pitch_ * turn.acceleration},
          size_, speed_);
  }
  void rotor(const kernel::RowTerms<double>& row, double armature) {
    write(row, 1, 1);
    next_[-1].gap = next_[-1].rate = 0;
    next_[-1].compliance = 1 / armature;
    next_[-1].turning = row.rate;
  }

  [[nodiscard]] const kernel::FramePair<double>& pair() const { return pair_; }

 private:
  void write(const kernel::RowTerms<double>& row, double size, double rate_size) {
    *next_++ = {{row.force, row.torque, pair_.b().p}, row.gap, row.rate, row.acceleration, size, rate_size};
  }

  kernel::FramePair<double> pair_;
  double pitch_;
  ClosureRow* next_;
  double size_, speed_, spin_;
};

}  // namespace

kernel::Rotors rotors_of(const Closure& closure) {
  kernel::Rotors rotors;
  for (int j = 0; j < 3; ++j) {
    rotors.armature[j] = closure.armature[static_cast<std::size_t>(j)];
    rotors.slides[j] = is_length(closure.kind, j);
  }
  return rotors;
}

void write_rows(const Closure& closure, const ClosureMotion& motion, std::span<ClosureRow> out) {
  Rows rows{closure, motion, out.data()};
  kernel::list_rows(closure.kind, rows);
  if (closure.armature == std::array<double, 3>{}) return;
  with_model(closure, [&](auto model) {
    kernel::list_rotors(model, closure.kind, rotors_of(closure), rows.pair(), rows);
  });
}

}  // namespace pantin
