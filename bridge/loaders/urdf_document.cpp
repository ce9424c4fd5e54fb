#include <pantin/bridge/loaders/urdf_document.hpp>

#include <tinyxml2.h>

#include <string_view>

#include <pantin/bridge/loaders/urdf_inventory.hpp>
#include <pantin/bridge/loaders/urdf_numbers.hpp>

namespace pantin::urdf_loader {
namespace {

using tinyxml2::XMLElement;

/// Line of the first tag with more attributes than any robot needs; 0 if there is none. tinyxml2 compares
/// each attribute with all before it.
int line_of_crowded_tag(std::string_view text) {
  constexpr int kMost = 1000;
  int line = 1;
  int count = 0;
  bool in_tag = false;
  char quote = 0;
  for (const char c : text) {
    if (c == '\n') ++line;
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '<' || c == '>') {
      in_tag = c == '<';
      count = 0;
    } else if (in_tag && (c == '"' || c == '\'')) {
      quote = c;
      if (++count > kMost) return line;
    }
  }
  return 0;
}

std::string xml_problem(const tinyxml2::XMLDocument& document) {
  switch (document.ErrorID()) {
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "elements are nested more than " + std::to_string(TINYXML2_MAX_ELEMENT_DEPTH) + " deep";
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "is not XML: an element is not closed by its own end tag";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "is not XML: an attribute is malformed or stands twice";
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "is not XML: there is no element";
    case tinyxml2::XML_ERROR_PARSING:
      return "is not XML: an element is not closed, or text stands where none may";
    case tinyxml2::XML_ERROR_PARSING_TEXT:
      return "is not XML: it begins with text, or text does not end";
    case tinyxml2::XML_ERROR_PARSING_COMMENT:
      return "is not XML: a comment does not end";
    default:
      return std::string{"is not XML: "} + document.ErrorName();
  }
}

/// Next element in document order, below or after `element`, within `top`.
const XMLElement* next_in_order(const XMLElement* element, const XMLElement* top) {
  if (const XMLElement* child = element->FirstChildElement()) return child;
  while (element != top) {
    if (const XMLElement* sibling = element->NextSiblingElement()) return sibling;
    element = element->Parent()->ToElement();
  }
  return nullptr;
}

bool has_macros(const XMLElement& robot, Ledger& ledger) {
  for (const XMLElement* e = &robot; e != nullptr; e = next_in_order(e, &robot)) {
    if (!std::string_view{e->Name()}.starts_with("xacro:")) continue;
    ledger.error({e->GetLineNum(), std::string{"element <"} + e->Name() + ">",
                  "xacro macros are not expanded in this file", "expand it first: xacro FILE > robot.urdf"});
    return true;
  }
  return false;
}

void check_version(XMLElement& robot, Ledger& ledger) {
  const char* version = robot.Attribute("version");
  if (version == nullptr) return;
  if (parse_number(version) == 1.0) {
    robot.SetAttribute("version", "1.0");  // urdfdom wants it to the letter
  } else {
    ledger.error({robot.GetLineNum(), "robot", std::string{"version '"} + version + "' of URDF is not known",
                  "only version 1.0 is"});
  }
}

}  // namespace

std::shared_ptr<tinyxml2::XMLDocument> parse_xml(const std::string& text, Ledger& ledger) {
  if (const int line = line_of_crowded_tag(text)) {
    ledger.error(
        {line, "file", "an element has more than 1000 attributes", "check that this is a robot description"});
    return nullptr;
  }
  auto document = std::make_shared<tinyxml2::XMLDocument>();
  if (document->Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    ledger.error({document->ErrorLineNum(), "file", xml_problem(*document), "check the XML near this line"});
    return nullptr;
  }
  return document;
}

XMLElement* find_robot(tinyxml2::XMLDocument& document, Ledger& ledger) {
  XMLElement* robot = document.FirstChildElement("robot");
  if (robot == nullptr) {
    const XMLElement* root = document.RootElement();
    const std::string found =
        root != nullptr ? std::string{"its root is <"} + root->Name() + ">" : "it has no element";
    ledger.error({root != nullptr ? root->GetLineNum() : 0, "file", "has no <robot> element: " + found,
                  "give a robot description (URDF)"});
    return nullptr;
  }
  for (XMLElement* other = document.FirstChildElement(); other != nullptr;) {
    XMLElement* next = other->NextSiblingElement();
    if (other != robot) {
      ledger.warning({other->GetLineNum(), std::string{"element <"} + other->Name() + ">",
                      "stands beside the first <robot> and is dropped", "put one robot in one file"});
      drop(*other, "stands beside the first <robot>", ledger);
    }
    other = next;
  }
  if (has_macros(*robot, ledger)) return nullptr;
  const char* name = robot->Attribute("name");
  if (name == nullptr || *name == '\0') {
    const bool xacro = robot->Attribute("xmlns:xacro") != nullptr;
    ledger.error({robot->GetLineNum(), "robot", "has no name",
                  xacro ? "expand the xacro file that uses this one: xacro FILE > robot.urdf"
                        : "write <robot name=\"...\">"});
  }
  check_version(*robot, ledger);
  return ledger.has_error() ? nullptr : robot;
}

std::string subject_of(const XMLElement& element) {
  const char* name = element.Attribute("name");
  return name != nullptr ? std::string{element.Name()} + " '" + name + '\'' : std::string{element.Name()};
}

std::string print_xml(const XMLElement& robot) {
  tinyxml2::XMLPrinter printer{nullptr, true};
  robot.Accept(&printer);
  return printer.CStr();
}

}  // namespace pantin::urdf_loader
