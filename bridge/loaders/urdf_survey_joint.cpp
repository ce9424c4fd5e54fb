// The pre-flight over one <joint>: its type, links, axis, limits, dynamics and mimic.
#include <tinyxml2.h>

#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include <pantin/bridge/loaders/urdf_document.hpp>
#include <pantin/bridge/loaders/urdf_inventory.hpp>
#include <pantin/bridge/loaders/urdf_numbers.hpp>
#include <pantin/bridge/loaders/urdf_survey.hpp>

namespace pantin::urdf_loader {
namespace {

using tinyxml2::XMLElement;

constexpr std::array kTypes{
    std::pair{std::string_view{"revolute"}, JointType::Revolute},
    std::pair{std::string_view{"continuous"}, JointType::Continuous},
    std::pair{std::string_view{"prismatic"}, JointType::Prismatic},
    std::pair{std::string_view{"fixed"}, JointType::Fixed},
    std::pair{std::string_view{"floating"}, JointType::Floating},
    std::pair{std::string_view{"planar"}, JointType::Planar},
};

/// One joint under examination.
struct Context {
  XMLElement& joint;
  JointEntry& entry;
  std::string subject;
  Ledger& ledger;

  void error(int line, std::string problem, std::string remedy) const {
    ledger.error({line, subject, std::move(problem), std::move(remedy)});
  }
  void alike(Severity severity, const std::string& kind, int line, std::string problem,
             std::string remedy) const {
    ledger.alike(severity, kind, {line, subject, std::move(problem), std::move(remedy)});
  }
  /// Reads one number; nothing where the attribute is not there or bad.
  std::optional<double> number(XMLElement& element, const char* name) const {
    std::array<double, 1> value{};
    return read_numbers(element, name, value, subject, ledger) ? std::optional{value[0]} : std::nullopt;
  }
};

void read_type(const Context& c) {
  const char* type = c.joint.Attribute("type");
  for (const auto& [name, known] : kTypes) {
    if (type != nullptr && name == type) c.entry.type = known;
  }
  if (type == nullptr) {
    c.error(c.entry.line, "has no type",
            "write type=\"revolute\", continuous, prismatic, fixed, floating or planar");
  } else if (c.entry.type == JointType::Unknown) {
    c.error(c.entry.line, std::string{"type '"} + type + "' is not known to URDF",
            "use revolute, continuous, prismatic, fixed, floating or planar");
  }
}

/// The link named by <parent> or <child>.
std::string read_end(const Context& c, const char* end) {
  const XMLElement* element = c.joint.FirstChildElement(end);
  const char* link = element != nullptr ? element->Attribute("link") : nullptr;
  if (link == nullptr || *link == '\0') {
    c.error(element != nullptr ? element->GetLineNum() : c.entry.line,
            std::string{"names no "} + end + " link", std::string{"write <"} + end + " link=\"...\"/>");
    return {};
  }
  return link;
}

/// Removes from the copy what means nothing for this type of joint.
void drop_meaningless(const Context& c, XMLElement& element) {
  const std::string what =
      std::string{"<"} + element.Name() + "> of a " + c.joint.Attribute("type") + " joint";
  const bool harmless = std::string_view{element.Name()} != "mimic";  // who writes a mimic wants motion
  c.alike(harmless ? Severity::Note : Severity::Warning, what, element.GetLineNum(),
          what + " means nothing and is dropped", "");
  drop(element, what + " means nothing", c.ledger);
}

void read_axis(const Context& c) {
  XMLElement* axis = c.joint.FirstChildElement("axis");
  if (axis == nullptr || !has_attribute(*axis, "xyz")) {
    if (has_axis(c.entry.type)) {
      c.alike(Severity::Note, "default axis", axis != nullptr ? axis->GetLineNum() : c.entry.line,
              "has no axis: 1 0 0 is used, as URDF says", "");
      c.ledger.supply({number_of(c.joint), "/axis@xyz", "'1 0 0' is used"});
    }
    if (axis != nullptr) drop(*axis, "says nothing", c.ledger);
    return;
  }
  std::array<double, 3> xyz{};
  const bool readable = read_numbers(*axis, "xyz", xyz, c.subject, c.ledger);
  if (!has_axis(c.entry.type)) return drop_meaningless(c, *axis);
  if (!readable) return;
  const double length = std::hypot(xyz[0], xyz[1], xyz[2]);
  // Components of 1e300 have an infinite length, of 1e-320 one without precision: no robot means either.
  if (!(length > 1e-150 && length < 1e150)) {
    return c.error(axis->GetLineNum(), std::string{"axis '"} + axis->Attribute("xyz") + "' has no direction",
                   "write a unit vector, as in xyz=\"0 0 1\"");
  }
  if (std::abs(length - 1) <= 1e-9) return;
  const bool rounded = std::abs(length - 1) < 1e-3;  // what digits cut off in text amounts to
  c.alike(rounded ? Severity::Note : Severity::Warning, rounded ? "rounded axis" : "axis", axis->GetLineNum(),
          "axis has length " + number_text(length) + ": normalised", rounded ? "" : "write a unit vector");
  for (double& component : xyz) component /= length;
  write_numbers(*axis, "xyz", xyz);
}

/// lower and upper; effort and velocity are not used, but urdfdom wants them.
void read_limit(const Context& c) {
  XMLElement* limit = c.joint.FirstChildElement("limit");
  const bool limited = c.entry.type == JointType::Revolute || c.entry.type == JointType::Prismatic;
  if (limit == nullptr) {
    if (!limited) return;
    return c.error(c.entry.line, std::string{"a "} + c.joint.Attribute("type") + " joint needs <limit>",
                   c.entry.type == JointType::Revolute
                       ? "write <limit lower= upper= effort= velocity=/>, or type=\"continuous\""
                       : "write <limit lower= upper= effort= velocity=/>");
  }
  const int line = limit->GetLineNum();
  const std::optional<double> lower = c.number(*limit, "lower");
  const std::optional<double> upper = c.number(*limit, "upper");
  bool defaulted = false;
  for (const char* name : {"effort", "velocity"}) {
    defaulted = defaulted || !has_attribute(*limit, name);
    if (!has_attribute(*limit, name)) limit->SetAttribute(name, "0");
    c.number(*limit, name);
    c.ledger.lose({number_of(*limit), name, "limits of effort and velocity are not used"});
  }
  if (!limited && c.entry.type != JointType::Continuous) return drop_meaningless(c, *limit);
  if (defaulted && limited) {
    c.alike(Severity::Warning, "no effort", line,
            "limit lacks effort or velocity, which URDF requires; neither is used", "write both");
  } else {
    c.alike(Severity::Note, "effort", line, "limits of effort and velocity are not used and dropped", "");
  }
  const bool has_lower = has_attribute(*limit, "lower");
  const bool has_upper = has_attribute(*limit, "upper");
  if (!limited) {
    if (has_lower || has_upper) {
      c.alike(Severity::Note, "continuous limit", line,
              "lower and upper of a continuous joint mean nothing and are dropped",
              "write type=\"revolute\" to limit it");
    }
    drop(*limit, "a continuous joint has no limits, and effort and velocity are not used", c.ledger);
  } else if ((lower || !has_lower) && (upper || !has_upper) && lower.value_or(0) > upper.value_or(0)) {
    c.error(line,
            "limit: lower " + number_text(lower.value_or(0)) + " is above upper " +
                number_text(upper.value_or(0)),
            has_lower && has_upper ? "swap them" : "write both");
  } else if (!has_lower || !has_upper) {
    if (!has_lower) c.ledger.supply({number_of(*limit), "@lower", "'0' is used"});
    if (!has_upper) c.ledger.supply({number_of(*limit), "@upper", "'0' is used"});
    c.alike(Severity::Warning, "default limit", line,
            std::string{"limit has no "} +
                (has_lower   ? "upper"
                 : has_upper ? "lower"
                             : "lower and upper") +
                ": 0 is used, as URDF says",
            has_lower || has_upper ? "write both" : "write both, or the joint cannot move");
  }
}

void read_dynamics(const Context& c) {
  XMLElement* dynamics = c.joint.FirstChildElement("dynamics");
  if (dynamics == nullptr) return;
  bool any = false;
  for (const char* name : {"damping", "friction"}) {
    const std::optional<double> value = c.number(*dynamics, name);
    if (value && *value < 0) {
      c.alike(
          Severity::Warning, name, dynamics->GetLineNum(),
          std::string{name} + ' ' + number_text(*value) + " is negative and would drive the joint: dropped",
          "write 0 or more");
      dynamics->SetAttribute(name, "0");
    }
    any = any || has_attribute(*dynamics, name);
  }
  if (!has_axis(c.entry.type)) return drop_meaningless(c, *dynamics);
  if (!any) drop(*dynamics, "is empty", c.ledger);  // urdfdom refuses such
}

void read_mimic(const Context& c) {
  XMLElement* mimic = c.joint.FirstChildElement("mimic");
  if (mimic == nullptr) return;
  c.number(*mimic, "multiplier");
  c.number(*mimic, "offset");
  if (!has_value(c.entry.type)) return drop_meaningless(c, *mimic);
  const char* leader = mimic->Attribute("joint");
  if (leader == nullptr || *leader == '\0') {
    return c.error(mimic->GetLineNum(), "mimic names no joint", "write <mimic joint=\"...\"/>");
  }
  c.entry.mimic = leader;
  c.entry.mimic_line = mimic->GetLineNum();
}

/// Safety controller and calibration are for drivers of real robots: their numbers are checked, then they go.
void drop_controls(const Context& c) {
  for (const char* tag : {"safety_controller", "calibration"}) {
    XMLElement* element = c.joint.FirstChildElement(tag);
    if (element == nullptr) continue;
    for (const char* name : {"soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity", "rising",
                             "falling", "reference_position"}) {
      c.number(*element, name);
    }
    c.alike(Severity::Note, tag, element->GetLineNum(),
            std::string{"<"} + tag + "> is for drivers of real robots and is dropped", "");
    drop(*element, "is for drivers of real robots", c.ledger);
  }
}

}  // namespace

JointEntry survey_joint(XMLElement& joint, Ledger& ledger) {
  JointEntry entry{.line = joint.GetLineNum()};
  const Context c{joint, entry, subject_of(joint), ledger};
  const char* name = joint.Attribute("name");
  if (name == nullptr || *name == '\0') {
    c.error(entry.line, "has no name", "write <joint name=\"...\">");
  } else {
    entry.name = name;
  }
  read_type(c);
  entry.parent = read_end(c, "parent");
  entry.child = read_end(c, "child");
  check_origin(joint, c.subject, ledger);
  if (entry.type == JointType::Unknown) return entry;  // refused already
  read_axis(c);
  read_limit(c);
  read_dynamics(c);
  read_mimic(c);
  drop_controls(c);
  return entry;
}

}  // namespace pantin::urdf_loader
