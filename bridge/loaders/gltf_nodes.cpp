#include "gltf_nodes.hpp"

#include <cmath>

#include "gltf_motion.hpp"

namespace pantin::gltf {
namespace {

NodeTransform read_matrix(Report& report, const JsonValue& node, const std::array<double, 16>& m) {
  const JsonValue at = *node.find("matrix");
  for (const std::string_view key : {"translation", "rotation", "scale"})
    if (node.find(key))
      report.refuse(at, "the node has both a matrix and a " + std::string{key}, "keep one of them");
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
    report.refuse(at, "the last row of the matrix is not 0, 0, 0, 1",
                  "write an affine matrix, column after column");
  NodeTransform transform{.by_matrix = true};
  for (std::size_t column = 0; column < 4; ++column)
    for (std::size_t row = 0; row < 3; ++row)
      transform.M_PN(static_cast<int>(row), static_cast<int>(column)) = m[4 * column + row];
  return transform;
}

NodeTransform read_transform(Report& report, const JsonValue& node) {
  if (const auto matrix = numbers<16>(report, node, "matrix")) return read_matrix(report, node, *matrix);
  NodeTransform transform;
  if (const auto t = numbers<3>(report, node, "translation"))
    transform.M_PN.translation() = Vector3{(*t)[0], (*t)[1], (*t)[2]};
  if (const auto q = numbers<4>(report, node, "rotation"))
    transform.rotation = unit_quaternion(report, *node.find("rotation"), *q, kUnitTolerance);
  if (const auto s = numbers<3>(report, node, "scale")) transform.scale = Vector3{(*s)[0], (*s)[1], (*s)[2]};
  transform.M_PN.linear() = transform.rotation.toRotationMatrix() * transform.scale.asDiagonal();
  return transform;
}

}  // namespace

Quaternion unit_quaternion(Report& report, const JsonValue& at, const std::array<double, 4>& xyzw,
                           double tolerance) {
  const Quaternion q{xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
  const double length = q.coeffs().stableNorm();
  if (!(length > 0 && std::isfinite(length)))
    report.refuse(at, "a quaternion is zero or too great to have a direction",
                  "write a unit quaternion x, y, z, w");
  if (std::abs(length - 1) > tolerance)
    report.convert(Severity::Warning, at, "a quaternion is not of unit length: normalised",
                   "write unit quaternions x, y, z, w");
  return Quaternion{Eigen::Vector4d{q.coeffs() / length}};
}

SceneNodes read_nodes(const Document& document, Model& model) {
  Report& report = document.report();
  SceneNodes nodes{.hierarchy = read_hierarchy(document)};
  nodes.transforms.resize(document.count(Collection::Nodes));
  for (std::size_t i = 0; i < nodes.transforms.size(); ++i)
    report.try_part(
        [&] { nodes.transforms[i] = read_transform(report, document.item(Collection::Nodes, i)); });
  for (const std::uint32_t index : nodes.hierarchy.order) {
    report.try_part([&] {
      const JsonValue item = document.item(Collection::Nodes, index);
      report.marks().read(item);
      const std::int32_t parent = nodes.hierarchy.parents[index];
      ModelNode node{.name = std::string{text_or_empty(report, item, "name")}, .place = report.place(item)};
      if (parent >= 0) node.parent = nodes.hierarchy.positions[static_cast<std::size_t>(parent)];
      node.M_PN = nodes.transforms[index].M_PN;
      node.mass = read_motion(report, item);
      static_cast<void>(
          document.referred(item, "mesh", Collection::Meshes));  // wrong also where it is not read
      model.nodes.push_back(std::move(node));
    });
  }
  report.stop_at_errors();
  return nodes;
}

}  // namespace pantin::gltf
