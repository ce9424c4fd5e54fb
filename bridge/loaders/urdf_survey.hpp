#pragma once
// The pre-flight over a robot's XML: reads names, lines and numbers of every link and joint, reports all that
// is wrong at once, and mends in place what urdfdom would refuse or lose although its meaning is clear.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <pantin/bridge/loaders/urdf_ledger.hpp>

namespace tinyxml2 {
class XMLElement;
}

namespace pantin::urdf_loader {

/// A <collision> or <visual> that was kept; the same order as in urdfdom's model.
struct GeometryEntry {
  std::size_t number{0};  ///< of the element in the inventory
  int line{0};
  std::string name{};      ///< may be empty
  bool is_capsule{false};  ///< urdfdom knows none: it is shown a cylinder of the same radius and length
};

struct LinkEntry {
  std::string name{};
  int line{0};
  std::vector<GeometryEntry> collisions{};
  std::vector<GeometryEntry> visuals{};  ///< meshes only
};

/// What a joint lets its child do, as the file says it.
enum class JointType { Unknown, Revolute, Continuous, Prismatic, Fixed, Floating, Planar };

struct JointEntry {
  std::string name{};
  int line{0};
  JointType type{JointType::Unknown};
  std::string parent{};  ///< names of links; empty where the file does not say
  std::string child{};
  std::string mimic{};  ///< name of the leading joint; empty if none
  int mimic_line{0};
};

/// Links of the tree, parents before children, brothers in the order of the file.
struct TreeEntry {
  std::size_t link{0};      ///< position in Survey::links
  std::int64_t joint{-1};   ///< position in Survey::joints; -1 for the root
  std::int32_t parent{-1};  ///< position in Survey::tree; -1 for the root
};

struct Survey {
  std::string robot{};
  std::vector<LinkEntry> links{};
  std::vector<JointEntry> joints{};
  std::vector<TreeEntry> tree{};  ///< empty where the ledger has an error
};

/// Whether the joint has one axis to move about or along.
[[nodiscard]] bool has_value(JointType type) noexcept;
/// The same, or a plane that an axis stands on.
[[nodiscard]] bool has_axis(JointType type) noexcept;

/// Everything below in turn. The tree is built only where the ledger is free of errors.
[[nodiscard]] Survey survey(tinyxml2::XMLElement& robot, Ledger& ledger);

/// Reads and mends one <link>.
[[nodiscard]] LinkEntry survey_link(tinyxml2::XMLElement& link, Ledger& ledger);
/// Mends a <collision> (`drawn_only` false) or <visual>; what urdfdom must not see is removed from the link.
void survey_geometry(tinyxml2::XMLElement& link, bool drawn_only, LinkEntry& entry, Ledger& ledger);
/// Reads and mends one <joint>.
[[nodiscard]] JointEntry survey_joint(tinyxml2::XMLElement& joint, Ledger& ledger);
/// Reports what is wrong among the mimics: of itself, of nothing, in a circle, of a joint that has no value.
void check_mimics(const Survey& survey, Ledger& ledger);
/// Reports duplicates, missing links, loops, cycles and more than one root; builds Survey::tree where there
/// are none.
void check_graph(Survey& survey, Ledger& ledger);
/// xyz and rpy of the element's <origin>, if it has one.
void check_origin(tinyxml2::XMLElement& element, const std::string& subject, Ledger& ledger);

}  // namespace pantin::urdf_loader
