#include "mujoco_contender.hpp"

#include <mujoco/mujoco.h>

#include <cstdio>
#include <cstdlib>

namespace pantin::bench {
namespace {

/// printf into a string, for numbers in full precision.
template <class... Numbers>
std::string text(const char* format, Numbers... numbers) {
  char buffer[512];
  std::snprintf(buffer, sizeof buffer, format, numbers...);
  return buffer;
}

std::string inertial(double z, double mass, double x, double y, double about_z) {
  return text("<inertial pos='0 0 %.17g' mass='%.17g' diaginertia='%.17g %.17g %.17g'/>", z, mass, x, y,
              about_z);
}

std::string document(double gravity, const std::string& bodies) {
  return "<mujoco><compiler autolimits='false' angle='radian'/>" +
         text("<option integrator='RK4' gravity='0 0 %.17g'/>", -gravity) + "<worldbody>" + bodies +
         "</worldbody></mujoco>";
}

std::string document(const Chain& chain) {
  std::string bodies, ends;
  for (int i = 0; i < chain.links; ++i) {
    const double mass = rod_mass(chain, i), across = inertia_across(mass);
    bodies +=
        text("<body pos='0 0 %.17g'>", i == 0 ? 0 : -kRodLength) +
        inertial(-kRodLength / 2, mass, across, across, inertia_along(mass)) +
        text("<joint type='hinge' axis='%d %d 0'/>", turns_about_x(i) ? 1 : 0, turns_about_x(i) ? 0 : 1);
    ends += "</body>";
  }
  return document(kGravity, bodies + ends);
}

std::string document(const Top& top) {
  return document(
      0, "<body><freejoint/>" + inertial(0, 1, top.inertia[0], top.inertia[1], top.inertia[2]) + "</body>");
}

mjModel* load(const std::string& xml) {
  // Runs with steps too long go wrong on purpose: no log of that.
  mju_user_warning = [](const char*) {};
  char error[1000] = "";
  mjSpec* spec = mj_parseXMLString(xml.c_str(), nullptr, error, sizeof error);
  mjModel* model = spec != nullptr ? mj_compile(spec, nullptr) : nullptr;
  if (model == nullptr) {
    std::fprintf(stderr, "MuJoCo refuses the model: %s\n", spec != nullptr ? mjs_getError(spec) : error);
    std::exit(1);
  }
  mj_deleteSpec(spec);
  return model;
}

template <class Problem>
class Mujoco final : public Contender {
 public:
  explicit Mujoco(const Problem& problem)
      : problem_{problem}, model_{load(document(problem))}, data_{mj_makeData(model_)} {}
  ~Mujoco() override {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }
  Mujoco(const Mujoco&) = delete;
  Mujoco& operator=(const Mujoco&) = delete;

  std::string name() const override { return "MuJoCo RK4"; }
  int order() const override { return 4; }
  std::string setting(int k) const override { return std::to_string(steps_per_second(k)) + " steps/s"; }
  void prepare(int k) override {
    const auto rate = static_cast<double>(steps_per_second(k));
    steps_ = std::lround(rate * problem_.duration);
    model_->opt.timestep = 1 / rate;
    mj_resetData(model_, data_);
    place(problem_);
  }
  bool run() override {
    for (long i = 0; i < steps_; ++i) mj_step(model_, data_);
    // Bad numbers make MuJoCo start again from the reference position, with a warning.
    return data_->warning[mjWARN_BADQPOS].number + data_->warning[mjWARN_BADQVEL].number +
               data_->warning[mjWARN_BADQACC].number ==
           0;
  }
  long evaluations() const override { return 4 * steps_; }
  std::vector<Point> points() override { return points_of(problem_); }

 private:
  void place(const Chain& chain) {
    for (int i = 0; i < chain.links; ++i) data_->qpos[i] = start_angle(chain, i);
    data_->qvel[chain.links - 1] = chain.spin;
  }
  void place(const Top& top) {
    for (int k = 0; k < 3; ++k) data_->qvel[3 + k] = top.rate[k];
  }
  std::vector<Point> points_of(const Chain& chain) {
    mj_kinematics(model_, data_);
    std::vector<Point> points;
    for (int i = 1; i <= chain.links; ++i) {
      const mjtNum* p = data_->xipos + 3 * i;
      points.push_back({p[0], p[1], p[2]});
    }
    return points;
  }
  std::vector<Point> points_of(const Top&) {
    const mjtNum* q = data_->qpos + 3;
    return axes_of(q[0], q[1], q[2], q[3]);
  }

  Problem problem_{};
  mjModel* model_{nullptr};
  mjData* data_{nullptr};
  long steps_{0};
};

}  // namespace

std::unique_ptr<Contender> make_mujoco(const Chain& chain) { return std::make_unique<Mujoco<Chain>>(chain); }
std::unique_ptr<Contender> make_mujoco(const Top& top) { return std::make_unique<Mujoco<Top>>(top); }
std::string mujoco_version() { return mj_versionString(); }

}  // namespace pantin::bench
