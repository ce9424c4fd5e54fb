// The pre-flight over one <link>: its inertial, collisions and visuals.
#include <tinyxml2.h>

#include <array>
#include <optional>

#include <pantin/bridge/loaders/urdf_document.hpp>
#include <pantin/bridge/loaders/urdf_numbers.hpp>
#include <pantin/bridge/loaders/urdf_survey.hpp>
#include <pantin/physics/mass_properties.hpp>

namespace pantin::urdf_loader {
namespace {

using tinyxml2::XMLElement;

XMLElement& child_or_new(XMLElement& parent, const char* name) {
  XMLElement* child = parent.FirstChildElement(name);
  return child != nullptr ? *child : *parent.InsertNewChildElement(name);
}

/// The mass given; nothing, with a finding, where there is none. For urdfdom a missing one becomes 0, because
/// it would drop the inertial.
std::optional<double> read_mass(XMLElement& inertial, const std::string& subject, Ledger& ledger) {
  std::array<double, 1> mass{};
  XMLElement* element = inertial.FirstChildElement("mass");
  if (element == nullptr || !has_attribute(*element, "value")) {
    ledger.alike(Severity::Warning, "no mass",
                 {inertial.GetLineNum(), subject, "<inertial> says no mass: 0 is used",
                  "write <mass value=\"...\"/>"});
    write_numbers(child_or_new(inertial, "mass"), "value", mass);
    return std::nullopt;
  }
  return read_numbers(*element, "value", mass, subject, ledger) ? std::optional{mass[0]} : std::nullopt;
}

/// The inertia given; nothing, with a finding, where it is missing or bad. For urdfdom missing entries become
/// 0, because it would drop all six.
std::optional<Matrix3> read_inertia(XMLElement& inertial, const std::string& subject, Ledger& ledger) {
  constexpr std::array kNames{"ixx", "ixy", "ixz", "iyy", "iyz", "izz"};
  std::array<double, 6> entries{};
  XMLElement& element = child_or_new(inertial, "inertia");
  std::string missing;
  bool readable = true;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const std::span<double> entry{&entries[i], 1};
    if (has_attribute(element, kNames[i])) {
      readable = read_numbers(element, kNames[i], entry, subject, ledger) && readable;
    } else {
      missing += (missing.empty() ? "" : " ") + std::string{kNames[i]};
      write_numbers(element, kNames[i], entry);
    }
  }
  if (!missing.empty()) {
    const int line = element.GetLineNum() > 0 ? element.GetLineNum() : inertial.GetLineNum();
    ledger.alike(
        Severity::Warning, "incomplete inertia",
        {line, subject, "inertia lacks " + missing + ": 0 is used", "write all of ixx ixy ixz iyy iyz izz"});
  }
  if (!readable || !missing.empty()) return std::nullopt;
  Matrix3 inertia;
  inertia << entries[0], entries[1], entries[2],  //
      entries[1], entries[3], entries[4],         //
      entries[2], entries[4], entries[5];
  return inertia;
}

/// Unphysical values are kept as read: what they mean for a simulation is judged at hand-over, with what the
/// link is rigidly joined to.
void judge_mass(double mass, const Matrix3& inertia, int line, const std::string& subject, Ledger& ledger) {
  const auto warn = [&](const char* kind, std::string problem, std::string remedy) {
    ledger.alike(Severity::Warning, kind,
                 {line, subject, std::move(problem) + "; kept as read", std::move(remedy)});
  };
  if (mass < 0) {
    warn("negative mass", "mass " + number_text(mass) + " is negative", "write the mass in kg");
  } else if (mass == 0) {
    warn("zero mass", inertia.isZero(0) ? "mass and inertia are 0" : "mass is 0 but inertia is not",
         "leave out <inertial> for a link without mass");
  } else if (inertia.isZero(0)) {
    warn("zero inertia", "inertia is 0 with mass " + number_text(mass), "write the inertia in kg m^2");
  } else if (const auto problem = problem_with(MassProperties{.mass = mass, .I_BBcm_B = inertia})) {
    warn("impossible inertia", problem->text, problem->remedy);
  }
}

void survey_inertial(XMLElement& link, const std::string& subject, Ledger& ledger) {
  XMLElement* inertial = link.FirstChildElement("inertial");
  if (inertial == nullptr) return;
  check_origin(*inertial, subject, ledger);
  const std::optional<double> mass = read_mass(*inertial, subject, ledger);
  const std::optional<Matrix3> inertia = read_inertia(*inertial, subject, ledger);
  if (mass && inertia) judge_mass(*mass, *inertia, inertial->GetLineNum(), subject, ledger);
}

}  // namespace

LinkEntry survey_link(XMLElement& link, Ledger& ledger) {
  LinkEntry entry{.line = link.GetLineNum()};
  const char* name = link.Attribute("name");
  if (name == nullptr || *name == '\0') {
    ledger.error({entry.line, "link", "has no name", "write <link name=\"...\">"});
  } else {
    entry.name = name;
  }
  const std::string subject = subject_of(link);
  survey_inertial(link, subject, ledger);
  survey_geometry(link, false, entry, ledger);
  survey_geometry(link, true, entry, ledger);
  return entry;
}

}  // namespace pantin::urdf_loader
