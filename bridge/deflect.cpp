// Deflectors from the shapes of nodes. All is judged before any is made.
#include <Eigen/LU>
#include <cmath>

#include <pantin/bridge/bridge_impl.hpp>
#include <pantin/physics/box_mesh.hpp>
#include <pantin/physics/deflectors/box.hpp>
#include <pantin/physics/deflectors/capsule.hpp>
#include <pantin/physics/deflectors/mesh.hpp>
#include <pantin/physics/deflectors/sphere.hpp>

namespace pantin {
namespace {

constexpr double kEven = 1e-9;  // of lengths: what differs by less is rounding

using AnyDeflector = std::variant<SphereDeflector, BoxDeflector, CapsuleDeflector, MeshDeflector>;

/// Factor by which a linear map scales all lengths alike; nothing where it does not.
std::optional<double> even_scale(const Matrix3& L) {
  const Matrix3 squares = L.transpose() * L;
  const double square = squares.trace() / 3;
  if ((squares - square * Matrix3::Identity()).cwiseAbs().maxCoeff() > kEven * square) return std::nullopt;
  return std::sqrt(square);
}

/// The rotation with these orthogonal axes made unit; a mirror is taken out of the first, which changes no
/// solid that is symmetric across it.
Quaternion turned_to(const Matrix3& axes) {
  Matrix3 R = axes.colwise().normalized();
  if (R.determinant() < 0) R.col(0) *= -1;
  return Quaternion{R}.normalized();
}

/// Makes deflectors of shapes, or says why not.
class Maker {
 public:
  Maker(BodyId body, const DeflectSettings& settings) : body_{body}, settings_{settings} {}

  void add(const Shape& shape, const Affine& M_BN) {
    if (const std::optional<SettingsProblem> found = problem_with(shape))
      return fail(found->text, found->remedy);
    if (const auto* compound = std::get_if<CompoundShape>(&shape.geometry)) {
      const Affine M_BC = M_BN * matrix_of(shape.X_BS);
      for (const Shape& part : *compound->parts) add_solid(part, M_BC * matrix_of(part.X_BS));
      return;
    }
    add_solid(shape, M_BN * matrix_of(shape.X_BS));
  }

  std::vector<AnyDeflector> made{};
  std::vector<SettingsProblem> problems{};

 private:
  static Affine matrix_of(const Pose& X) {
    Affine M = Affine::Identity();
    M.linear() = X.rotation();
    M.translation() = X.p;
    return M;
  }
  void fail(std::string text, std::string remedy) {
    problems.push_back({ProblemCode::OutOfRange, std::move(text), std::move(remedy)});
  }
  template <class Settings>
  void keep(Settings deflector) {
    if (const std::optional<SettingsProblem> found = problem_with(deflector)) {
      problems.push_back(*found);
    } else {
      made.push_back(std::move(deflector));
    }
  }
  [[nodiscard]] DeflectorMount at(const Affine& M_BS, const Quaternion& q) const {
    return {body_, {M_BS.translation(), q}};
  }

  void add_solid(const Shape& shape, const Affine& M_BS) {
    if (!(std::abs(M_BS.linear().determinant()) > 0)) {
      return fail("its matrix is singular, so its shapes are flat", "scale it by more than zero");
    }
    const std::optional<double> scale = even_scale(M_BS.linear());
    const std::string kind{kind_of(shape.geometry)};
    if (const auto* sphere = std::get_if<SphereShape>(&shape.geometry); sphere && scale) {
      made.push_back(
          SphereDeflector{at(M_BS, Quaternion::Identity()), *scale * sphere->radius, settings_.surface});
    } else if (const auto* capsule = std::get_if<CapsuleShape>(&shape.geometry); capsule && scale) {
      keep(CapsuleDeflector{at(M_BS, turned_to(M_BS.linear())), *scale * capsule->radius,
                            *scale * capsule->length, settings_.surface});
    } else if (const auto* box = std::get_if<BoxShape>(&shape.geometry)) {
      add_box(*box, M_BS);
    } else if (const auto* mesh = std::get_if<MeshShape>(&shape.geometry)) {
      add_mesh(*mesh, M_BS);
    } else if (const auto* hull = std::get_if<ConvexShape>(&shape.geometry)) {
      add_mesh({hull->hull, hull->scale}, M_BS);
    } else if (kind == "sphere" || kind == "capsule") {
      fail("a " + kind + " that is stretched unevenly has no deflector",
           "scale the node evenly, or give a mesh instead");
    } else {
      fail("a " + kind + " has no deflector", "give boxes, spheres, capsules or a mesh instead");
    }
  }

  void add_box(const BoxShape& box, const Affine& M_BS) {
    const Matrix3 axes = M_BS.linear();
    const Vector3 lengths = axes.colwise().norm();
    const Matrix3 unit = axes * lengths.cwiseInverse().asDiagonal();
    const Matrix3 skew = unit.transpose() * unit - Matrix3::Identity();
    if (skew.cwiseAbs().maxCoeff() <= kEven) {
      keep(BoxDeflector{at(M_BS, turned_to(axes)), lengths.cwiseProduct(box.size), settings_.surface});
      return;
    }
    add_mesh({std::make_shared<const TriangleMesh>(surface_of(box))}, M_BS);
  }

  /// Vertices are moved into the body, so that any matrix will do.
  void add_mesh(const MeshShape& shape, const Affine& M_BS) {
    if (!settings_.index) {
      return fail("a deflector of triangles needs an index of them",
                  "set DeflectSettings::index, to make_fcl_triangle_index of component collision_fcl, say");
    }
    TriangleMesh mesh = *shape.mesh;
    for (Vector3& p : mesh.vertices) p = M_BS * p.cwiseProduct(shape.scale);
    MeshDeflector deflector{.on = {.body = body_}, .surface = settings_.surface};
    deflector.triangles = settings_.index({std::make_shared<const TriangleMesh>(std::move(mesh))});
    keep(std::move(deflector));
  }

  BodyId body_;
  const DeflectSettings& settings_;
};

}  // namespace

Deflected Bridge::deflect(NodeId id, const DeflectSettings& settings) {
  impl_->expect_alive(id, "deflect");
  const Binding* own = impl_->find(id);
  const Binding* carrier = own != nullptr ? own : impl_->bound_above(id);
  // Up to the carrier by local matrices, whose residual is known exactly; without one, in the world.
  Affine M_BN = carrier == nullptr ? impl_->scene.world(id) : Affine::Identity();
  if (carrier != nullptr) {
    for (NodeId at = id; at != carrier->node; at = impl_->scene.parent(at)) {
      M_BN = impl_->scene.local(at) * M_BN;
    }
    M_BN = carrier->M_BN * M_BN;
  }
  Deflected out;
  Maker maker{carrier != nullptr ? carrier->body : BodyId{}, settings};
  const auto is_bound = [this](NodeId node) { return impl_->find(node) != nullptr; };
  if (const auto found = problem_with(settings.surface, "deflector")) {
    out.notes.push_back(impl_->note(Severity::Error, id, found->text, found->remedy));
  }
  for (const RigidFollower& at : rigid_followers({impl_->scene, impl_->node_bodies, is_bound}, id, M_BN)) {
    const NodeBody* body = node_body(at.node);
    if (body == nullptr) continue;
    for (const Shape& shape : body->shapes) maker.add(shape, at.M_BD);
    for (const ModelMesh& mesh : body->meshes) {
      if (body->shapes.empty() && mesh.mesh) maker.add(Shape{MeshShape{mesh.mesh}}, at.M_BD * mesh.M_NS);
    }
    for (const SettingsProblem& found : maker.problems) {
      out.notes.push_back(impl_->note(Severity::Error, at.node, found.text, found.remedy));
    }
    maker.problems.clear();
  }
  if (has_error(out.notes)) return out;
  if (maker.made.empty()) {
    out.notes.push_back(impl_->note(Severity::Warning, id, "has no shapes to turn particles back at",
                                    "give it some by set_node_body"));
  }
  for (const AnyDeflector& deflector : maker.made) {
    out.ids.push_back(
        std::visit([this](const auto& d) { return impl_->physics.deflectors().add(d); }, deflector));
  }
  return out;
}

}  // namespace pantin
