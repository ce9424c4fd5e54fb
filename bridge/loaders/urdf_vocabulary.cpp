// Which elements and attributes URDF 1.0 has (http://wiki.ros.org/urdf/XML, and <capsule>, which most tools
// accept), and what becomes of the others.
#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include <pantin/bridge/loaders/urdf_document.hpp>
#include <pantin/bridge/loaders/urdf_inventory.hpp>

namespace pantin::urdf_loader {
namespace {

using std::string_view;
using tinyxml2::XMLElement;

enum class Times { Once, Many };

struct Rule {
  string_view parent;
  string_view name;
  Times times;
  string_view attributes;  ///< between blanks
};

constexpr std::array kRules{
    Rule{"", "robot", Times::Once, " name version "},
    Rule{"robot", "link", Times::Many, " name "},
    Rule{"robot", "joint", Times::Many, " name type "},
    Rule{"link", "inertial", Times::Once, " "},
    Rule{"link", "visual", Times::Many, " name "},
    Rule{"link", "collision", Times::Many, " name "},
    Rule{"inertial", "origin", Times::Once, " xyz rpy "},
    Rule{"inertial", "mass", Times::Once, " value "},
    Rule{"inertial", "inertia", Times::Once, " ixx ixy ixz iyy iyz izz "},
    Rule{"visual", "origin", Times::Once, " xyz rpy "},
    Rule{"visual", "geometry", Times::Once, " "},
    Rule{"collision", "origin", Times::Once, " xyz rpy "},
    Rule{"collision", "geometry", Times::Once, " "},
    Rule{"geometry", "box", Times::Once, " size "},
    Rule{"geometry", "cylinder", Times::Once, " radius length "},
    Rule{"geometry", "sphere", Times::Once, " radius "},
    Rule{"geometry", "capsule", Times::Once, " radius length "},
    Rule{"geometry", "mesh", Times::Once, " filename scale "},
    Rule{"joint", "origin", Times::Once, " xyz rpy "},
    Rule{"joint", "parent", Times::Once, " link "},
    Rule{"joint", "child", Times::Once, " link "},
    Rule{"joint", "axis", Times::Once, " xyz "},
    Rule{"joint", "limit", Times::Once, " lower upper effort velocity "},
    Rule{"joint", "dynamics", Times::Once, " damping friction "},
    Rule{"joint", "mimic", Times::Once, " joint multiplier offset "},
    Rule{"joint", "safety_controller", Times::Once,
         " soft_lower_limit soft_upper_limit k_position k_velocity "},
    Rule{"joint", "calibration", Times::Once, " rising falling reference_position "},
};

/// Elements that other programs put into URDF files, or that only draw.
constexpr std::array<string_view, 15> kWellKnown{
    "transmission", "gazebo",  "material", "color",  "texture", "sensor",      "ros2_control",
    "contact",      "surface", "verbose",  "mujoco", "gravity", "self_filter", "collision_checking",
    "kinematic"};

bool is_well_known(string_view name) {
  return std::find(kWellKnown.begin(), kWellKnown.end(), name) != kWellKnown.end() ||
         name.find(':') != string_view::npos;
}

const Rule* rule_of(string_view parent, string_view name) {
  const auto found = std::find_if(kRules.begin(), kRules.end(), [&](const Rule& rule) {
    return rule.parent == parent && rule.name == name;
  });
  return found == kRules.end() ? nullptr : &*found;
}

/// An element that was kept, and the link or joint it belongs to.
struct Kept {
  XMLElement* element;
  const Rule* rule;
  std::string subject;
};

void remove_attributes(const Kept& kept, Ledger& ledger) {
  std::vector<std::string> unknown;
  for (const tinyxml2::XMLAttribute* a = kept.element->FirstAttribute(); a != nullptr; a = a->Next()) {
    const std::string name = a->Name();
    if (kept.rule->attributes.find(' ' + name + ' ') == string_view::npos) unknown.push_back(name);
  }
  std::string list;
  for (const std::string& name : unknown) {
    const bool is_prefix = name.starts_with("xmlns");  // declares one, says nothing about the robot
    drop_attribute(*kept.element, name, is_prefix ? "declares a prefix of names" : "is unknown", ledger);
    if (is_prefix) continue;
    list += (list.empty() ? "'" : ", '") + name + '\'';
  }
  if (list.empty()) return;
  const std::string problem =
      "attribute " + list + " of <" + kept.element->Name() + "> is unknown and dropped";
  ledger.alike(Severity::Warning, problem,
               {kept.element->GetLineNum(), kept.subject, problem, "check the spelling"}, 1);
}

void remove(const Kept& parent, XMLElement& child, const Rule* rule, Ledger& ledger) {
  const std::string name = child.Name();
  const std::string owner = parent.element->Name();
  const int line = child.GetLineNum();
  if (rule != nullptr) {
    drop(child, "is a second one; the first is used", ledger);
    ledger.warning({line, parent.subject,
                    "a second <" + name + "> in <" + owner + "> is dropped; the first is used", "keep one"});
  } else if (is_well_known(name)) {
    drop(child, "<" + name + "> is not needed for physics", ledger);
    ledger.alike(Severity::Note, "element " + name,
                 {line, parent.subject, "<" + name + "> is not needed for physics and is dropped", ""});
  } else {
    drop(child, "<" + name + "> in <" + owner + "> is unknown", ledger);
    ledger.alike(Severity::Warning, "element " + owner + ' ' + name,
                 {line, parent.subject, "<" + name + "> in <" + owner + "> is unknown and dropped",
                  "check its spelling and where it stands"},
                 1);
  }
}

}  // namespace

void remove_unknown(XMLElement& robot, Ledger& ledger) {
  std::vector<Kept> open{{&robot, rule_of("", "robot"), subject_of(robot)}};
  while (!open.empty()) {
    const Kept parent = open.back();
    open.pop_back();
    remove_attributes(parent, ledger);
    std::vector<const Rule*> seen;
    for (tinyxml2::XMLNode* node = parent.element->FirstChild(); node != nullptr;) {
      tinyxml2::XMLNode* next = node->NextSibling();
      XMLElement* child = node->ToElement();
      if (child == nullptr) {
        if (node->ToText() != nullptr) {
          ledger.alike(
              Severity::Warning, "text",
              {node->GetLineNum(), parent.subject, "text between the elements is dropped", "remove it"});
        }
        parent.element->DeleteChild(node);
        node = next;
        continue;
      }
      const Rule* rule = rule_of(parent.element->Name(), child->Name());
      const bool again = rule != nullptr && rule->times == Times::Once &&
                         std::find(seen.begin(), seen.end(), rule) != seen.end();
      if (rule == nullptr || again) {
        remove(parent, *child, rule, ledger);
      } else {
        seen.push_back(rule);
        open.push_back({child, rule, parent.rule->parent.empty() ? subject_of(*child) : parent.subject});
      }
      node = next;
    }
  }
}

}  // namespace pantin::urdf_loader
