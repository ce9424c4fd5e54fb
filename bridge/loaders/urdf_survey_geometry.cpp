// The pre-flight over the <geometry> of collisions and visuals. A visual is only drawn: of these, meshes are
// kept, and a bad size is a reason to drop the visual, while a bad collision is an error.
#include <tinyxml2.h>

#include <array>
#include <string_view>

#include <pantin/bridge/loaders/urdf_document.hpp>
#include <pantin/bridge/loaders/urdf_inventory.hpp>
#include <pantin/bridge/loaders/urdf_numbers.hpp>
#include <pantin/bridge/loaders/urdf_survey.hpp>

namespace pantin::urdf_loader {
namespace {

using std::string_view;
using tinyxml2::XMLElement;

/// Where findings about one shape go, and whether it can be used so far.
struct Judge {
  std::string subject;
  bool drawn_only;
  Ledger& ledger;
  bool usable{true};
  std::string why{};  ///< it is not kept

  void refuse(int line, std::string problem, std::string remedy) {
    usable = false;
    why = problem;
    if (drawn_only) {
      ledger.warning({line, subject, std::move(problem) + "; dropped", std::move(remedy)});
    } else {
      ledger.error({line, subject, std::move(problem), std::move(remedy)});
    }
  }
  /// Numbers of one attribute, each of which must satisfy `good`.
  template <std::size_t N, class Good>
  void numbers(XMLElement& shape, const char* name, Good good, const char* rule,
               const char* remedy = "write it in metres") {
    std::array<double, N> values{};
    const std::string what = std::string{name} + " of <" + shape.Name() + ">";
    if (!has_attribute(shape, name)) {
      refuse(shape.GetLineNum(), what + " is missing", remedy);
    } else if (!read_numbers(shape, name, values, subject, ledger)) {
      usable = false;
    } else {
      for (const double value : values) {
        if (good(value)) continue;
        refuse(shape.GetLineNum(), what + " is " + shape.Attribute(name) + ", but must be " + rule, remedy);
        return;
      }
    }
  }
};

/// Checks the shape's numbers; a capsule becomes a cylinder in the XML.
void judge_shape(XMLElement& shape, Judge& judge) {
  const string_view kind = shape.Name();
  const auto positive = [](double x) { return x > 0; };
  if (kind == "box") {
    judge.numbers<3>(shape, "size", positive, "positive");
  } else if (kind == "mesh") {
    const char* file = shape.Attribute("filename");
    if (file == nullptr || *file == '\0') {
      judge.refuse(shape.GetLineNum(), "<mesh> names no file", "write filename=\"...\"");
    }
    if (has_attribute(shape, "scale")) {
      judge.numbers<3>(
          shape, "scale", [](double x) { return x != 0; }, "other than 0",
          "leave scale out, or write scale=\"1 1 1\"");
    }
  } else {
    judge.numbers<1>(shape, "radius", positive, "positive");
    if (kind == "cylinder") judge.numbers<1>(shape, "length", positive, "positive");
    if (kind == "capsule")
      judge.numbers<1>(
          shape, "length", [](double x) { return x >= 0; }, "0 or more");
  }
}

/// The one shape of a <geometry>; null with a finding where there is none. Further ones are removed with a
/// finding.
XMLElement* only_shape(XMLElement& owner, Judge& judge) {
  XMLElement* geometry = owner.FirstChildElement("geometry");
  XMLElement* shape = geometry != nullptr ? geometry->FirstChildElement() : nullptr;
  if (shape == nullptr) {
    judge.why = "has no known geometry";
    judge.ledger.alike(Severity::Warning, "no geometry",
                       {owner.GetLineNum(), judge.subject, "has no known geometry; dropped",
                        "use box, cylinder, sphere, capsule or mesh"});
    return nullptr;
  }
  while (XMLElement* more = shape->NextSiblingElement()) {
    judge.ledger.warning({more->GetLineNum(), judge.subject,
                          std::string{"a second shape, <"} + more->Name() + ">, in one <geometry> is dropped",
                          "write another <" + std::string{owner.Name()} + ">"});
    drop(*more, "is a second shape in one <geometry>", judge.ledger);
  }
  return shape;
}

/// Whether the element stays in the copy for urdfdom.
bool survey_one(XMLElement& owner, Judge& judge, GeometryEntry& entry) {
  check_origin(owner, judge.subject, judge.ledger);
  XMLElement* shape = only_shape(owner, judge);
  if (shape == nullptr) return false;
  judge_shape(*shape, judge);
  if (!judge.usable) return false;
  const string_view kind = shape->Name();
  if (judge.drawn_only && kind != "mesh") {
    judge.why = "is only drawn: not needed for physics";
    judge.ledger.alike(Severity::Note, "visual primitive",
                       {owner.GetLineNum(), judge.subject,
                        "<" + std::string{kind} + "> is only drawn: not needed for physics and dropped", ""});
    return false;
  }
  entry.is_capsule = kind == "capsule";
  if (entry.is_capsule) shape->SetName("cylinder");
  return true;
}

}  // namespace

void survey_geometry(XMLElement& link, bool drawn_only, LinkEntry& entry, Ledger& ledger) {
  const char* tag = drawn_only ? "visual" : "collision";
  for (XMLElement* owner = link.FirstChildElement(tag); owner != nullptr;) {
    XMLElement* next = owner->NextSiblingElement(tag);
    const char* name = owner->Attribute("name");
    GeometryEntry geometry{
        .number = number_of(*owner), .line = owner->GetLineNum(), .name = name != nullptr ? name : ""};
    if (name != nullptr && !drawn_only) {
      ledger.lose({geometry.number, "name", "names of collisions are not kept"});
      ledger.alike(Severity::Note, "collision name",
                   {geometry.line, subject_of(link), "names of collisions are not kept", ""});
    }
    Judge judge{
        .subject = subject_of(link) + ", " + subject_of(*owner), .drawn_only = drawn_only, .ledger = ledger};
    if (survey_one(*owner, judge, geometry)) {
      (drawn_only ? entry.visuals : entry.collisions).push_back(std::move(geometry));
    } else {
      drop(*owner, judge.why, ledger);
    }
    owner = next;
  }
}

}  // namespace pantin::urdf_loader
