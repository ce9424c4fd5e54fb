#pragma once
// The XML of a URDF file: parsed within limits, and cleared of what URDF 1.0 does not know or physics does
// not need, each removal with a finding. What is left is the copy that urdfdom gets.
#include <memory>
#include <string>

#include <pantin/bridge/loaders/urdf_ledger.hpp>

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace pantin::urdf_loader {

/// Parses the text; null and an error in the ledger where it is not XML, is nested too deep or has an element
/// with thousands of attributes (both would take quadratic time).
[[nodiscard]] std::shared_ptr<tinyxml2::XMLDocument> parse_xml(const std::string& text, Ledger& ledger);

/// The <robot> element of the document; null and an error where there is none, where it has no name or
/// another version than 1.0, or where macros are left in it.
[[nodiscard]] tinyxml2::XMLElement* find_robot(tinyxml2::XMLDocument& document, Ledger& ledger);

/// Removes every element and attribute that is not in URDF's vocabulary, and repetitions of elements that
/// stand once.
void remove_unknown(tinyxml2::XMLElement& robot, Ledger& ledger);

/// "link 'arm'", "joint 'elbow'": how findings call an element.
[[nodiscard]] std::string subject_of(const tinyxml2::XMLElement& element);

/// The element as text for urdfdom.
[[nodiscard]] std::string print_xml(const tinyxml2::XMLElement& robot);

}  // namespace pantin::urdf_loader
