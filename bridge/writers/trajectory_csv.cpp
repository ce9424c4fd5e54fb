#include <pantin/bridge/writers/trajectory_csv.hpp>

#include <charconv>

namespace pantin {
namespace {

void append(std::string& row, double number) {
  std::array<char, 32> text{};  // the shortest form of a double has at most 24 characters
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), number);
  row.append(text.data(), error == std::errc{} ? end : text.data());
}

void append_field(std::string& row, double number) {
  row += ',';
  append(row, number);
}

void append_field(std::string& row, const Vector3& v) {
  for (int i = 0; i < 3; ++i) append_field(row, v[i]);
}

void append_field(std::string& row, std::string_view text) {
  row += ',';
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    row += text;
    return;
  }
  row += '"';
  for (const char c : text) {
    if (c == '"') row += '"';
    row += c;
  }
  row += '"';
}

void append_field(std::string& row, const JointNumbers& numbers) {
  row += ',';
  for (int i = 0; i < numbers.size(); ++i) {
    if (i > 0) row += ' ';
    append(row, numbers[i]);
  }
}

}  // namespace

TrajectoryCsv::TrajectoryCsv(std::ostream& out) : out_{out} {
  out_ << "t,path,drive,px,py,pz,cx,cy,cz,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,joint,joint_value,joint_rate,"
          "kinetic,potential\r\n";
}

void TrajectoryCsv::write(const Sample& sample) {
  auto joint = sample.joints.begin();
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    const BodySample& body = sample.bodies[i];
    row_.clear();
    append(row_, sample.t);
    append_field(row_, std::string_view{body.path});
    append_field(row_, to_string(body.drive));
    append_field(row_, body.p_WB);
    append_field(row_, body.p_WBcm);
    for (const double number : {body.q_WB.w(), body.q_WB.x(), body.q_WB.y(), body.q_WB.z()})
      append_field(row_, number);
    append_field(row_, body.v_WBcm);
    append_field(row_, body.w_WB);
    if (joint != sample.joints.end() && joint->body == i) {
      append_field(row_, std::string_view{joint->name});
      append_field(row_, joint->value);
      append_field(row_, joint->rate);
      ++joint;
    } else {
      row_ += ",,,";
    }
    append_field(row_, sample.energy.kinetic);
    append_field(row_, sample.energy.potential);
    row_ += "\r\n";
    out_ << row_;
  }
}

void TrajectoryCsv::finish(const RunSummary&, const std::vector<Diagnostic>&) {}

}  // namespace pantin
