// Random edits, compared with the plainest scene there is.
#include <gtest/gtest.h>

#include <support/random_affine.hpp>
#include <support/reference_scene.hpp>

namespace pantin {
namespace {

/// What the local matrices are, and how exactly worlds must agree.
enum class Matrices {
  Turns,  ///< quarter turns, mirrors and whole-number steps: products are exact in any order, so no bit may
          ///< differ
  Any,    ///< scale, shear and mirror: products of up to 12 agree to round-off, relative to their size
};

/// A signed permutation with a translation by whole numbers.
Affine random_turn(std::mt19937_64& random) {
  Eigen::PermutationMatrix<3> permutation{3};
  permutation.setIdentity();
  for (int i = 2; i > 0; --i)
    permutation.applyTranspositionOnTheRight(i, int(test::pick(random, std::size_t(i) + 1)));
  Affine M = Affine::Identity();
  M.linear() = permutation.toDenseMatrix().cast<double>();
  for (int i = 0; i < 3; ++i) {
    if (test::pick(random, 2) == 0) M.linear().row(i) *= -1;
    M.translation()[i] = double(test::pick(random, 9)) - 4;
  }
  return M;
}

/// The real scene and the plain one, edited alike, and a copy of the worlds that is kept from changed()
/// alone.
class Pair {
 public:
  Pair(std::uint64_t seed, std::size_t most, Matrices matrices)
      : random_{seed}, most_{most}, matrices_{matrices}, plain_{scene_.root()} {
    alive_.push_back(scene_.root());
  }

  void edit() {
    switch (test::pick(random_, 10)) {
      case 0:
      case 1:
      case 2:
      case 3:
        create();
        break;
      case 4:
        remove();
        break;
      case 5:
        move(Keep::Local);
        break;
      case 6:
        move(Keep::World);
        break;
      default:
        set_local();
        break;
    }
  }

  void update() {
    std::vector<Affine> read;
    for (const NodeId id : alive_) read.push_back(scene_.world(id));
    scene_.update();
    mirror_.resize(scene_.worlds().size());
    for (const IndexRange& range : scene_.changed())
      for (std::size_t i = range.begin; i < range.end; ++i) mirror_[i] = scene_.worlds()[i];
    for (std::size_t k = 0; k < alive_.size(); ++k) {
      const std::size_t at = scene_.index_of(alive_[k]);
      ASSERT_EQ(scene_.worlds()[at], Matrix34::from(read[k]));
      ASSERT_EQ(mirror_[at], scene_.worlds()[at]) << "changed() left out a node that did change";
    }
  }

  void compare() const {
    ASSERT_EQ(scene_.size(), plain_.nodes().size());
    ASSERT_EQ(scene_.subtree(scene_.root()), plain_.subtree(plain_.root()));
    for (const auto& [id, node] : plain_.nodes()) {
      ASSERT_TRUE(scene_.contains(id));
      ASSERT_EQ(scene_.order()[scene_.index_of(id)], id);
      ASSERT_EQ(scene_.parent(id), node.parent);
      ASSERT_EQ(scene_.children(id), node.children);
      ASSERT_EQ(scene_.name(id), node.name);
      ASSERT_EQ(scene_.local(id).matrix(), node.M_PN.matrix());
      ASSERT_LE(test::relative_error(scene_.world(id), plain_.world(id)), tolerance());
      if (node.parent) {
        ASSERT_LT(scene_.index_of(node.parent), scene_.index_of(id));
      }
    }
    std::size_t holes = 0;
    for (const NodeId id : scene_.order()) holes += id ? 0 : 1;
    ASSERT_EQ(scene_.order().size() - holes, scene_.size());
    for (const NodeId id : removed_) ASSERT_FALSE(scene_.contains(id));
  }

  void compare_ancestry() {
    for (int k = 0; k < 50; ++k) {
      const NodeId a = any();
      const NodeId b = any();
      ASSERT_EQ(scene_.is_above(a, b), plain_.is_above(a, b));
      ASSERT_EQ(scene_.subtree(a), plain_.subtree(a));
    }
  }

 private:
  [[nodiscard]] double tolerance() const { return matrices_ == Matrices::Turns ? 0 : 1e-11; }
  Affine random_local() {
    return matrices_ == Matrices::Turns ? random_turn(random_) : test::random_affine(random_);
  }
  NodeId any() { return alive_[test::pick(random_, alive_.size())]; }

  void create() {
    if (alive_.size() >= most_) return remove();
    // Often under the newest node, so that there are depths and long runs too.
    const NodeId parent = test::pick(random_, 2) == 0 ? alive_.back() : any();
    const std::string name = "n" + std::to_string(test::pick(random_, 5));
    const Affine M = random_local();
    const NodeId id = scene_.create(parent, name, M);
    plain_.create(id, parent, name, M);
    alive_.push_back(id);
  }

  void remove() {
    const NodeId id = any();
    const std::vector<NodeId> gone = plain_.subtree(id);
    if (id == scene_.root() || gone.size() > 3 + most_ / 100) return;
    scene_.remove(id);
    plain_.remove(id);
    removed_.insert(removed_.end(), gone.begin(), gone.end());
    std::erase_if(alive_, [&](NodeId other) { return !plain_.nodes().contains(other); });
  }

  void move(Keep keep) {
    const NodeId child = any();
    const NodeId parent = any();
    if (plain_.is_above(child, parent)) return;
    const Affine before = plain_.world(child);
    scene_.set_parent(child, parent, keep);
    plain_.set_parent(child, parent);
    if (keep == Keep::Local) return;
    plain_.at(child).M_PN = scene_.local(child);
    ASSERT_LE(test::relative_error(scene_.world(child), before), tolerance());
  }

  void set_local() {
    const NodeId id = any();
    const Affine M = random_local();
    scene_.set_local(id, M);
    plain_.at(id).M_PN = M;
  }

  std::mt19937_64 random_;
  std::size_t most_;
  Matrices matrices_;
  Scene scene_{};
  test::ReferenceScene plain_;
  std::vector<NodeId> alive_{};
  std::vector<NodeId> removed_{};
  std::vector<Matrix34> mirror_{};
};

void play(Pair pair, int edits, int edits_per_update) {
  for (int k = 1; k <= edits; ++k) {
    pair.edit();
    if (k % edits_per_update == 0) pair.update();
    if (k % (3 * edits_per_update) == 0 || k == edits) {
      pair.compare();
      pair.compare_ancestry();
    }
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(RandomEdits, SmallScenesAgreeWithThePlainOne) {
  // A few nodes, so that edits hit the same ones again and again in all orders; checked after every few
  // edits.
  for (std::uint64_t seed = 0; seed < 100 && !HasFatalFailure(); ++seed)
    play(Pair{seed, 12, Matrices::Any}, 150, 2);
}

TEST(RandomEdits, LargeScenesAgreeWithThePlainOne) {
  // Hundreds of nodes and tails, so that updates and edits compact many times.
  for (std::uint64_t seed = 0; seed < 3 && !HasFatalFailure(); ++seed)
    play(Pair{seed, 600, Matrices::Turns}, 6000, 100);
}

TEST(RandomEdits, ManyEditsWithoutUpdateAgreeWithThePlainOne) {
  // Thousands of holes before any update: the edits themselves must compact, which needs more than 1024
  // holes.
  play(Pair{7, 300, Matrices::Turns}, 12'000, 4000);
}

}  // namespace
}  // namespace pantin
