// What the scene graph costs, on one thread: full and partial updates beside memcpy of the same bytes, a
// packed-array registry and OpenSceneGraph; idle updates; a million nodes side by side and one below the
// other, moved and destroyed; bytes a node. Interleaved in one run, least of several repeats.
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>

#include <pantin/scenegraph/scene.hpp>

#include "bench/race.hpp"
#include "scenegraph_registry.hpp"
#ifdef PANTIN_BENCH_OSG
#include "peers/scenegraph_osg.hpp"
#endif

namespace pantin::bench {
namespace {

constexpr char kOurs[] = "Pantin";
constexpr char kMemcpy[] = "memcpy of the local matrices";

/// A crowd in a Scene, and the id of each of its nodes.
struct OurScene {
  Scene scene;
  std::vector<NodeId> ids{};

  OurScene(const Crowd& crowd, InstructionSet set) : scene{set} {
    scene.reserve(crowd.parents.size());
    ids.push_back(scene.root());
    for (std::size_t i = 1; i < crowd.parents.size(); ++i)
      ids.push_back(scene.create(ids[crowd.parents[i]], "", crowd.locals[i].affine()));
    scene.compact();
    scene.update();
  }
  [[nodiscard]] const Matrix34& world(std::size_t node) const {
    return scene.worlds()[scene.index_of(ids[node])];
  }
};

/// What changes in one frame: some nodes get new local matrices. Two of them, taken in turn.
struct Edits {
  std::vector<std::uint32_t> nodes{};
  std::vector<NodeId> ids{};
  std::array<std::vector<Matrix34>, 2> locals{};

  Edits(std::vector<std::uint32_t> chosen, const OurScene& ours) : nodes{std::move(chosen)} {
    std::mt19937_64 random{2};
    for (const std::uint32_t node : nodes) {
      ids.push_back(ours.ids[node]);
      for (std::vector<Matrix34>& some : locals) some.push_back(random_pose(random));
    }
  }
  [[nodiscard]] const std::vector<Matrix34>& of(int repeat) const { return locals[std::size_t(repeat) % 2]; }
};

double difference(const Matrix34& a, const Matrix34& b) {
  double greatest = 0;
  for (std::size_t i = 0; i < 12; ++i) greatest = std::max(greatest, std::abs(a.m[i] - b.m[i]));
  return greatest;
}

/// All who hold one crowd.
struct Field {
  const Crowd& crowd;
  MultiplyFunction* const multiply{sweep_kernel(InstructionSet::Best).multiply};
  OurScene ours{crowd, InstructionSet::Best};
  OurScene baseline{crowd, InstructionSet::Baseline};
  Registry<Pools::Single> single{crowd, &multiply_by_eigen};
  Registry<Pools::Group> group{crowd, multiply};
  Registry<Pools::Group> ordered{crowd, multiply};
#ifdef PANTIN_BENCH_OSG
  OsgScene osg{crowd};
#endif

  /// One frame of each: the edits, and an update.
  std::vector<Contender> contenders(const Edits& edits) {
    const auto frame = [&edits](OurScene& own) {
      return [&edits, &own](int k) {
        own.scene.set_locals(edits.ids, edits.of(k));
        own.scene.update();
      };
    };
    const auto by_tags = [&edits](auto& registry) {
      return [&edits, &registry](int k) {
        registry.set_locals(edits.nodes, edits.of(k));
        registry.update_by_tags();
      };
    };
    return {
        {kOurs, frame(ours)},
        {"Pantin, baseline instructions", frame(baseline)},
        {"registry by tags, Eigen", by_tags(single)},
        {"registry by tags, our kernel", by_tags(group)},
        {"registry in order, our kernel",
         [&](int k) {
           ordered.set_locals(edits.nodes, edits.of(k));
           ordered.update_in_order();
         }},
#ifdef PANTIN_BENCH_OSG
        {"OpenSceneGraph",
         [&](int k) {
           osg.set_locals(edits.nodes, edits.of(k));
           osg.update();
         }},
#endif
    };
  }

  /// That all computed the same.
  void compare() const {
    double greatest = 0;
    for (std::uint32_t i = 0; i < crowd.parents.size(); ++i) {
      const Matrix34 mine = ours.world(i);
      for (const Matrix34& other : {baseline.world(i), single.world(i), group.world(i), ordered.world(i)})
        greatest = std::max(greatest, difference(mine, other));
#ifdef PANTIN_BENCH_OSG
      greatest = std::max(greatest, difference(mine, osg.world(i)));
#endif
    }
    std::printf("(greatest difference between any two: %.1e)\n", greatest);
  }
};

void bench_full_sweep(const Crowd& crowd, const char* title, int repeats) {
  Field field{crowd};
  std::vector<Matrix34> from = crowd.locals;
  std::vector<Matrix34> to = crowd.locals;
  const Edits root{{0}, field.ours};
  std::vector<Contender> contenders = field.contenders(root);
  contenders.push_back({kMemcpy, [&](int) {
                          std::memcpy(to.data(), from.data(), to.size() * sizeof(Matrix34));
                          // or the copy, which nobody reads, would be left out
                          asm volatile("" ::"r"(to.data()) : "memory");
                        }});
  race(contenders, repeats);
  print_rows(title, contenders, kMemcpy);
  field.compare();
}

void bench_edits(Field& field, std::vector<std::uint32_t> nodes, const char* title) {
  const Edits edits{std::move(nodes), field.ours};
  std::vector<Contender> contenders = field.contenders(edits);
  race(contenders, 30, 10);
  print_rows(title, contenders, kOurs);
  field.compare();
}

/// 1 % of 1,000 characters, and 1 % of their nodes wherever they are.
void bench_small_changes() {
  const Crowd crowd = make_crowd(1000);
  Field field{crowd};
  std::mt19937_64 random{3};
  std::vector<std::uint32_t> tops(1000), all(crowd.parents.size() - 1);
  for (std::uint32_t c = 0; c < 1000; ++c) tops[c] = 1 + c * kCharacterNodes;
  std::iota(all.begin(), all.end(), 1U);
  std::shuffle(tops.begin(), tops.end(), random);
  std::shuffle(all.begin(), all.end(), random);
  tops.resize(10);
  all.resize(600);
  bench_edits(field, tops, "1000 x 60: 10 characters moved");
  bench_edits(field, all, "1000 x 60: 600 nodes moved");
}

void bench_idle() {
  for (const std::uint32_t characters : {1U, 1000U, 16'667U}) {
    const Crowd crowd = make_crowd(characters);
    OurScene ours{crowd, InstructionSet::Best};
    constexpr int kUpdates = 100'000;
    std::vector<Contender> contenders{{kOurs, [&](int) {
                                         for (int k = 0; k < kUpdates; ++k) {
                                           ours.scene.update();
                                           asm volatile("" ::: "memory");
                                         }
                                       }}};
    race(contenders, 20);
    std::printf("nothing changed, %zu nodes: %.2f ns an update\n", ours.scene.size(),
                1e9 * contenders[0].best / kUpdates);
  }
}

enum class Shape { Fan, Chain };

/// Moved between two parents and back into order by the update, then destroyed with the scene.
void bench_million(Shape shape) {
  std::array<double, 4> best{};
  best.fill(std::numeric_limits<double>::infinity());
  for (int repeat = 0; repeat < 5; ++repeat) {
    std::array<double, 5> at{cpu_seconds()};
    std::optional<Scene> scene{std::in_place};
    const NodeId a = scene->create(scene->root(), "a");
    const NodeId b = scene->create(scene->root(), "b");
    const NodeId top = scene->create(a, "top");
    NodeId last = top;
    for (int k = 0; k < 1'000'000; ++k) last = scene->create(shape == Shape::Fan ? top : last, "node");
    scene->update();
    at[1] = cpu_seconds();
    scene->set_parent(top, b, Keep::World);
    at[2] = cpu_seconds();
    scene->update();
    at[3] = cpu_seconds();
    scene.reset();
    at[4] = cpu_seconds();
    for (std::size_t k = 0; k < 4; ++k) best[k] = std::min(best[k], at[k + 1] - at[k]);
  }
  std::printf("million-%s: built %.0f ms, re-parented %.1f ms, updated %.1f ms, destroyed %.1f ms\n",
              shape == Shape::Fan ? "wide fan" : "deep chain", 1e3 * best[0], 1e3 * best[1], 1e3 * best[2],
              1e3 * best[3]);
}

void print_memory(const Crowd& crowd) {
  OurScene ours{crowd, InstructionSet::Best};
  for (std::size_t i = 1; i < ours.ids.size(); ++i)
    ours.scene.rename(ours.ids[i], "character/node " + std::to_string(i));
  const auto each = [&](std::size_t bytes) { return double(bytes) / double(ours.scene.size()); };
  const SceneMemory before = ours.scene.memory();
  for (const NodeId id : ours.ids)
    if (id != ours.scene.root())
      ours.scene.set_link(id, {.kind = LinkKind::Ball, .value = zero_value(LinkKind::Ball)});
  const SceneMemory after = ours.scene.memory();
  std::printf(
      "bytes a node, %zu nodes after compaction: matrices %.1f + topology %.1f + ids %.1f = %.1f; names of "
      "20 "
      "letters %.1f; a link on each %.1f\n",
      ours.scene.size(), each(before.matrices), each(before.topology), each(before.ids),
      each(before.matrices + before.topology + before.ids), each(before.names), each(after.links));
}

int run() {
  std::printf("instructions: best is %s; built with%s\n",
              std::string{to_string(Scene{}.instruction_set())}.c_str(), PANTIN_BENCH_FLAGS);
#ifndef PANTIN_BENCH_OSG
  std::printf(
      "OpenSceneGraph: SKIPPED, not found when this was configured (Debian: libopenscenegraph-dev)\n");
#endif
  std::printf("| %-34s | %-32s | %12s | %8s |\n|---|---|---|---|\n", "case", "who", "time [us]", "ratio");
  const Crowd million = make_crowd(16'667);
  bench_full_sweep(million, "1,000,021 nodes: all swept", 15);
  bench_full_sweep(make_crowd(1000), "60,001 nodes: all swept", 50);
  bench_small_changes();
  bench_idle();
  bench_million(Shape::Fan);
  bench_million(Shape::Chain);
  print_memory(million);
  return 0;
}

}  // namespace
}  // namespace pantin::bench

int main() { return pantin::bench::run(); }
