#include <pantin/bridge/derive_mass.hpp>

#include <Eigen/LU>
#include <cmath>
#include <cstdio>

namespace pantin {
namespace {

constexpr double kLeastThickness =
    1e-3;  // of a bounding box, against its longest edge: flat meshes have no volume

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// Solid geometry in S at its real volume under M_BS: mass in B.
MassProperties placed(const Affine& M_BS, const Shape& shape, double density) {
  return mapped(M_BS, mass_of(shape, density * std::abs(M_BS.linear().determinant())));
}

std::optional<Shape> bounding_box(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vector3& vertex : mesh.vertices) box.extend(vertex);
  if (box.isEmpty() || !box.sizes().allFinite() || !(box.sizes().maxCoeff() > 0)) return std::nullopt;
  const Vector3 size = box.sizes().cwiseMax(kLeastThickness * box.sizes().maxCoeff());
  return Shape{BoxShape{size}, Pose{.p = box.center()}};
}

/// What the geometry of nodes adds up to.
struct Geometry {
  std::vector<MassProperties> parts{};
  std::size_t shapes{0}, meshes{0}, boxes{0}, unusable{0};

  void add(const RigidFollower& at, const NodeBody& body, double density) {
    for (const Shape& shape : body.shapes) {
      if (problem_with(shape)) {
        ++unusable;
        continue;
      }
      parts.push_back(placed(at.M_BD, shape, density)), ++shapes;
    }
    if (!body.shapes.empty()) return;
    for (const ModelMesh& mesh : body.meshes) {
      if (!mesh.mesh) continue;
      const Affine M_BS = at.M_BD * mesh.M_NS;
      if (!closedness_problem(*mesh.mesh)) {
        parts.push_back(placed(M_BS, Shape{MeshShape{mesh.mesh}, Pose{}}, density)), ++meshes;
      } else if (const std::optional<Shape> box = bounding_box(*mesh.mesh)) {
        parts.push_back(placed(M_BS, *box, density)), ++boxes;
      }
    }
  }
  [[nodiscard]] std::string text() const {
    std::string out;
    const auto say = [&out](std::size_t count, const char* what) {
      if (count == 0) return;
      out += (out.empty() ? "" : ", ") + std::to_string(count) + " " + what;
    };
    say(shapes, "shape(s)");
    say(meshes, "closed mesh(es)");
    say(boxes, "bounding box(es) of meshes that are not closed");
    say(unusable, "shape(s) of impossible size left out");
    return out;
  }
};

class Derivation {
 public:
  Derivation(const MassSources& from, NodeId node, const Affine& M_BN, double density)
      : from_{from}, node_{node}, density_{density}, followers_{rigid_followers(from, node, M_BN)} {}

  DerivedMass result() && {
    const NodeBody* own = body(node_);
    if (own != nullptr && own->mass) {
      declared(*own->mass);
    } else if (const Geometry geometry = own_and_undeclared(); !geometry.parts.empty()) {
      parts_.push_back(combined(geometry.parts));
      out_.known = true;
      say("declares no mass; " + number(parts_.back().mass) + " kg were derived from " + geometry.text() +
              " at " + number(density_) + " kg/m^3",
          "declare a mass to use another");
    }
    add_followers();
    out_.mass = combined(parts_);
    return std::move(out_);
  }

 private:
  [[nodiscard]] const NodeBody* body(NodeId id) const {
    const auto found = from_.node_bodies.find(id);
    return found == from_.node_bodies.end() ? nullptr : &found->second;
  }

  /// Geometry of the node, and of unbound nodes below that declare no mass.
  [[nodiscard]] Geometry own_and_undeclared() const {
    Geometry geometry;
    for (const RigidFollower& at : followers_) {
      const NodeBody* known = body(at.node);
      if (known != nullptr && (at.node == node_ || !known->mass)) geometry.add(at, *known, density_);
    }
    return geometry;
  }

  void declared(const MassProperties& mass) {
    out_.known = true;
    MassProperties in_B = mapped(followers_.front().M_BD, mass);
    if (mass.mass > 0 && mass.I_BBcm_B.isZero(0)) {
      const Geometry geometry = own_and_undeclared();
      const MassProperties shaped = combined(geometry.parts);
      if (shaped.mass > 0) {
        in_B.I_BBcm_B = shaped.I_BBcm_B * (mass.mass / shaped.mass);
        if (mass.p_BBcm.isZero(0)) in_B.p_BBcm = shaped.p_BBcm;
        say("declares " + number(mass.mass) + " kg but no inertia; its shape was taken from " +
                geometry.text(),
            "declare an inertia to use another");
      } else {
        out_.no_inertia = true;
      }
    }
    parts_.push_back(in_B);
  }

  void add_followers() {
    std::string names;
    double sum = 0;
    for (std::size_t k = 1; k < followers_.size(); ++k) {
      const NodeBody* known = body(followers_[k].node);
      if (known == nullptr || !known->mass || !(known->mass->mass > 0)) continue;
      parts_.push_back(mapped(followers_[k].M_BD, *known->mass));
      sum += known->mass->mass;
      names += (names.empty() ? "'" : ", '") + from_.scene.name(followers_[k].node) + "'";
      out_.known = true;
    }
    if (sum > 0) {
      say("carries " + number(sum) + " kg of nodes below that have no body of their own: " + names,
          "hand them over too to make them bodies");
    }
  }

  void say(std::string problem, std::string remedy) {
    out_.notes.push_back({Severity::Note, from_.scene.path(node_), "node '" + from_.scene.name(node_) + "'",
                          std::move(problem), std::move(remedy)});
  }

  const MassSources& from_;
  NodeId node_;
  double density_;
  std::vector<RigidFollower> followers_;
  std::vector<MassProperties> parts_{};
  DerivedMass out_{};
};

}  // namespace

std::vector<RigidFollower> rigid_followers(const MassSources& from, NodeId node, const Affine& M_BN) {
  std::vector<RigidFollower> found{{node, M_BN}};
  for (std::size_t k = 0; k < found.size(); ++k) {
    for (const NodeId child : from.scene.children(found[k].node)) {
      if (!from.is_bound(child)) found.push_back({child, found[k].M_BD * from.scene.local(child)});
    }
  }
  return found;
}

MassProperties mapped(const Affine& M_BN, const MassProperties& mass) {
  MassProperties in_B = deformed(M_BN.linear(), mass);
  in_B.p_BBcm += M_BN.translation();
  return in_B;
}

DerivedMass derive_mass(const MassSources& sources, NodeId node, const Affine& M_BN, double density) {
  return Derivation{sources, node, M_BN, density}.result();
}

}  // namespace pantin
