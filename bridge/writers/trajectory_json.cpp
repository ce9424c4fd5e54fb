#include <pantin/bridge/writers/trajectory_json.hpp>

#include <pantin/bridge/writers/ledger_json.hpp>

namespace pantin {
namespace {

void write_body(JsonStream& json, const BodySample& body) {
  json.key(body.path).begin_object();
  json.member("position_origin", body.p_WB).member("position_cog", body.p_WBcm);
  json.member("quaternion_wxyz", body.q_WB).member("velocity_cog", body.v_WBcm);
  json.member("angular_velocity_world", body.w_WB).member("drive", to_string(body.drive));
  json.end_object();
}

void write_numbers(JsonStream& json, std::string_view key, const JointNumbers& numbers) {
  json.key(key);
  numbers.size() == 1 ? json.value(numbers[0]) : json.value(numbers.numbers());
}

}  // namespace

TrajectoryJson::TrajectoryJson(std::ostream& out) : json_{out} {
  json_.begin_object(JsonLayout::Lines).key("samples").begin_array(JsonLayout::Lines);
}

void TrajectoryJson::write(const Sample& sample) {
  json_.begin_object().member("t", sample.t);
  json_.key("bodies").begin_object();
  for (const BodySample& body : sample.bodies) write_body(json_, body);
  json_.end_object();
  json_.key("joints").begin_object();
  for (const JointSample& joint : sample.joints) {
    json_.key(joint.name).begin_object();
    write_numbers(json_, "value", joint.value);
    write_numbers(json_, "rate", joint.rate);
    json_.end_object();
  }
  json_.end_object();
  json_.key("energy").begin_object().member("kinetic", sample.energy.kinetic);
  json_.member("potential", sample.energy.potential).member("total", sample.energy.total());
  json_.end_object().end_object();
}

void TrajectoryJson::finish(const RunSummary& summary, const std::vector<Diagnostic>& ledger) {
  json_.end_array().key("summary");
  write_summary(json_, summary);
  json_.key("ledger");
  write_ledger(json_, ledger);
  json_.end_object();
}

}  // namespace pantin
