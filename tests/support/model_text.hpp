#pragma once
// All that a model says, as text in exact digits: two models are the same where their texts are.
#include <iomanip>
#include <sstream>
#include <string>

#include <pantin/bridge/model.hpp>

namespace pantin::test {

class ModelText {
 public:
  explicit ModelText(const Model& model) {
    out_ << std::hexfloat;
    put(model.name, model.format, static_cast<int>(model.up_axis), model.unit_m);
    for (const ModelNode& node : model.nodes) put_node(node);
    for (const Clip& clip : model.clips) {
      put(clip.name, clip.duration);
      for (const Track& track : clip.tracks) {
        put(track.target, static_cast<int>(track.channel), static_cast<int>(track.interpolation));
        for (const double x : track.times) put(x);
        for (const double x : track.values) put(x);
      }
    }
  }
  [[nodiscard]] std::string text() const { return out_.str(); }

 private:
  template <class... Values>
  void put(const Values&... values) {
    ((out_ << values << ' '), ...);
  }
  template <class Derived>
  void put_numbers(const Eigen::MatrixBase<Derived>& matrix) {
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      for (Eigen::Index k = 0; k < matrix.cols(); ++k) put(matrix(i, k));
  }
  void put_mesh(const TriangleMesh& mesh) {
    for (const Vector3& v : mesh.vertices) put_numbers(v);
    for (const auto& [a, b, c] : mesh.triangles) put(a, b, c);
  }

  void put_node(const ModelNode& node) {
    out_ << '\n';
    put(node.name, node.parent);
    put_numbers(node.M_PN.matrix());
    if (node.link) put_link(*node.link);
    if (node.dynamics) put("dynamics", node.dynamics->damping, node.dynamics->friction);
    if (node.mass) {
      put("mass", node.mass->mass);
      put_numbers(node.mass->p_BBcm);
      put_numbers(node.mass->I_BBcm_B);
    }
    for (const Shape& shape : node.shapes) put_shape(shape);
    for (const ModelMesh& mesh : node.meshes) {
      put(mesh.name);
      put_mesh(*mesh.mesh);
      put_numbers(mesh.M_NS.matrix());
    }
  }
  void put_link(const Link& link) {
    put("link", static_cast<int>(link.kind), link.name);
    put_numbers(link.M_PJ.matrix());
    put_numbers(link.M_JN.matrix());
    put_numbers(link.axis);
    put_numbers(link.axis2);
    for (const LinkLimits& limits : link.limits) put(limits.lower, limits.upper);
    if (link.mimic) put("mimic", link.mimic->source, link.mimic->multiplier, link.mimic->offset);
    for (const double x : link.value.numbers()) put(x);
  }
  void put_shape(const Shape& shape) {
    put(kind_of(shape.geometry));
    put_numbers(shape.X_BS.p);
    put_numbers(shape.X_BS.q.coeffs());
    std::visit(
        [this](const auto& s) {
          if constexpr (requires { s.radius; }) put(s.radius);
          if constexpr (requires { s.length; }) put(s.length);
          if constexpr (requires { s.size; }) put_numbers(s.size);
          if constexpr (requires { s.scale; }) put_numbers(s.scale);
          if constexpr (requires { s.mesh; }) put_mesh(*s.mesh);
        },
        shape.geometry);
  }

  std::ostringstream out_{};
};

inline std::string text_of_model(const Model& model) { return ModelText{model}.text(); }

}  // namespace pantin::test
