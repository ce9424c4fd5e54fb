#include "reference_run.hpp"

#include <gtest/gtest.h>

#include <pantin/physics/integrators/dormand_prince.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include <pantin/physics/integrators/dormand_prince.hpp>

namespace pantin::test {
namespace fs = std::filesystem;

double attitude_error(const Quaternion& q, const Quaternion& q_ref) {
  const Quaternion difference = q.conjugate() * q_ref;
  return 2 * std::atan2(difference.vec().norm(), std::abs(difference.w()));
}

namespace {

/// Steps until `t`: equal steps, none longer than asked for; what rounding leaves, the next call makes up
/// for. False if a step failed.
bool advance_to(PhysicsManager& physics, double t, const RunSettings& settings, RunErrors& errors) {
  const double from = physics.time(), interval = t - from;
  if (interval <= 0) return true;
  const long whole = std::max(1L, std::lround(std::ceil(interval / settings.step - 1e-9)));
  const long count = whole * settings.refinement;
  for (long i = 0; i < count; ++i) {
    const StepReport report = physics.step(interval / static_cast<double>(count));
    if (!report.ok()) {
      errors.failure = "t = " + std::to_string(physics.time()) + " s: " + report.message;
      return false;
    }
  }
  return true;
}

double energy_scale(const ReferenceProblem& problem) {
  double scale = 0;
  for (const reference::Sample& sample : problem.samples) {
    if (!sample.energy) continue;
    for (const double part : {sample.energy->kinetic, sample.energy->potential_gravity,
                              sample.energy->potential_elastic_or_central, sample.energy->total}) {
      scale = std::max(scale, std::abs(part));
    }
  }
  return scale > 0 ? scale : 1;
}

void compare(const reference::Sample& sample, const ReferenceInstance& built, const PhysicsManager& physics,
             double scale, RunErrors& errors) {
  for (const reference::BodySample& expected : sample.bodies) {
    if (const auto particle = built.particles.find(expected.name); particle != built.particles.end()) {
      const ParticleSystem system = physics.particles().system(particle->second.system);
      ++errors.compared;
      if (expected.p_WBcm)
        errors.position = std::max(errors.position, (system.p_WP(0) - *expected.p_WBcm).norm());
      continue;
    }
    const RigidBody body = physics.body(built.bodies.find(expected.name)->second);
    ++errors.compared;
    if (expected.p_WBcm) {
      errors.position = std::max(errors.position, (body.p_WBcm() - *expected.p_WBcm).norm());
    }
    if (expected.q_WB)
      errors.attitude = std::max(errors.attitude, attitude_error(body.q_WB(), *expected.q_WB));
  }
  if (sample.energy) {
    const double total = physics.energy().total() + physics.particles().energy().total();
    errors.energy = std::max(errors.energy, std::abs(total - sample.energy->total) / scale);
  }
  const JointDrift drift = physics.joint_drift();
  errors.joint_drift = std::max({errors.joint_drift, drift.distance, drift.angle});
}

}  // namespace

RunErrors run(const ReferenceProblem& problem, const RunSettings& settings) {
  RunErrors errors;
  PhysicsManager physics;
  if (settings.tolerance) {
    physics.set_integrator(make_dormand_prince({.tolerance = *settings.tolerance}));
  } else {
    physics.set_integrator(make_integrator(settings.integrator));
  }
  const Loaded<ReferenceInstance> built = instantiate(problem, physics);
  if (!built.value) {
    errors.failure = lines(built.notes);
    return errors;
  }
  const double scale = energy_scale(problem),
               until = std::min(settings.until, problem.duration) * (1 + 1e-12);
  for (const reference::Sample& sample : problem.samples) {
    if (sample.t > until) break;
    if (!advance_to(physics, sample.t, settings, errors)) return errors;
    compare(sample, *built.value, physics, scale, errors);
  }
  return errors;
}

std::vector<fs::path> problems_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator{folder, code}) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

fs::path reference_folder() {
  const char* given = std::getenv("PANTIN_PROBLEMS_DIR");
  if (given != nullptr && *given != '\0') return given;
  std::error_code code;
  for (const fs::directory_entry& neighbour :
       fs::directory_iterator{fs::path{PANTIN_SOURCE_DIR}.parent_path(), code}) {
    std::ifstream index{neighbour.path() / "problems" / "INDEX.md"};
    const std::string text{std::istreambuf_iterator<char>{index}, {}};
    std::ifstream readme{neighbour.path() / "problems" / "README.md"};
    const std::string words{std::istreambuf_iterator<char>{readme}, {}};
    if ((text + words).find("rigid-ref/1") != std::string::npos) return neighbour.path() / "problems";
  }
  return {};
}

fs::path own_folder() { return fs::path{PANTIN_SOURCE_DIR} / "assets" / "problems"; }

std::optional<ReferenceProblem> loaded(const fs::path& file) {
  Loaded<ReferenceProblem> read = load_rigid_ref(file);
  if (!read.value) ADD_FAILURE() << lines(read.notes);
  return std::move(read.value);
}

std::string lines(const std::vector<Diagnostic>& notes) {
  std::string out;
  for (const Diagnostic& note : notes) out += to_string(note) + '\n';
  return out;
}

std::string test_name(const fs::path& file) {
  std::string name = file.stem().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

}  // namespace pantin::test
