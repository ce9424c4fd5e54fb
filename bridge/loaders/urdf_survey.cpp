#include <pantin/bridge/loaders/urdf_survey.hpp>

#include <tinyxml2.h>

#include <array>

#include <pantin/bridge/loaders/urdf_numbers.hpp>

namespace pantin::urdf_loader {

bool has_value(JointType type) noexcept {
  return type == JointType::Revolute || type == JointType::Continuous || type == JointType::Prismatic;
}

bool has_axis(JointType type) noexcept { return has_value(type) || type == JointType::Planar; }

void check_origin(tinyxml2::XMLElement& element, const std::string& subject, Ledger& ledger) {
  tinyxml2::XMLElement* origin = element.FirstChildElement("origin");
  if (origin == nullptr) return;
  std::array<double, 3> numbers{};
  read_numbers(*origin, "xyz", numbers, subject, ledger);
  read_numbers(*origin, "rpy", numbers, subject, ledger);
}

Survey survey(tinyxml2::XMLElement& robot, Ledger& ledger) {
  Survey all{.robot = robot.Attribute("name")};
  for (auto* link = robot.FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    all.links.push_back(survey_link(*link, ledger));
  }
  for (auto* joint = robot.FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    all.joints.push_back(survey_joint(*joint, ledger));
  }
  check_mimics(all, ledger);
  check_graph(all, ledger);
  return all;
}

}  // namespace pantin::urdf_loader
