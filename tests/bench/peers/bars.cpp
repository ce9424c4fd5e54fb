// Pantin beside Pinocchio and MuJoCo at equal error: chains of 5, 20 and 100 rods, planar and bent, 1 s, and
// a free asymmetric top, 10 s. All contenders take turns in this one run, on one thread; processor time,
// least of several runs. Error: the greatest distance of a centre of gravity [m], or the angle of the top's
// attitude [rad], at the end, from gauss16 at 1e-14, which dormand-prince at 1e-13 and the peers confirm.
//
// Usage: pantin_bench_peers [--rows] [PART OF A PROBLEM'S NAME]      --rows prints every run as well
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <optional>

#include "own_contender.hpp"
#include "work_precision.hpp"
#ifdef PANTIN_BENCH_MUJOCO
#include "mujoco_contender.hpp"
#endif
#ifdef PANTIN_BENCH_PINOCCHIO
#include "pinocchio_contenders.hpp"
#include "pinocchio_model.hpp"
#endif

namespace pantin::bench {
namespace {

/// How many times faster than a peer Pantin has to be, at each error of the problem.
struct Bar {
  std::string peer{};
  std::vector<double> ratios{};
};

struct Comparison {
  std::string name{};
  std::vector<double> errors{};
  std::vector<Bar> bars{};
  std::vector<Entry> entries{};  ///< Pantin's solvers first, then peers
  std::vector<Point> reference{};
  double confirmed{0};  ///< difference of the second method
  ErrorOf error_of{};
};

constexpr std::size_t kOwn = 2;
const std::vector<std::string> kPeers{"Pinocchio RK4", "Pinocchio Dormand-Prince 5",
                                      "Pinocchio Fehlberg 7(8)", "MuJoCo RK4"};

double greatest_distance(const std::vector<Point>& a, const std::vector<Point>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double distance = std::hypot(a[i][0] - b[i][0], a[i][1] - b[i][1], a[i][2] - b[i][2]);
    if (!(distance <= most)) most = distance;
  }
  return most;
}

/// Between two attitudes, from the Frobenius norm of the difference of their matrices.
double angle(const std::vector<Point>& a, const std::vector<Point>& b) {
  double squares = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) squares += (a[i][k] - b[i][k]) * (a[i][k] - b[i][k]);
  }
  return 2 * std::asin(std::min(1.0, std::sqrt(squares / 8)));
}

void add(Comparison& comparison, std::unique_ptr<Contender> contender) {
  comparison.entries.push_back({std::move(contender), {}});
}

template <class Problem>
void add_own(Comparison& comparison, const Problem& problem,
             double (*distance)(const std::vector<Point>&, const std::vector<Point>&)) {
  const auto solved = [&](const char* solver, double tolerance) {
    OwnContender<Problem> own{problem, solver};
    own.start(tolerance);
    if (!own.run()) std::printf("%s failed\n", solver);
    return own.points();
  };
  comparison.reference = solved("gauss16", 1e-14);
  comparison.confirmed = distance(comparison.reference, solved("dormand-prince", 1e-13));
  comparison.error_of = [distance, reference = comparison.reference](const std::vector<Point>& points) {
    return distance(points, reference);
  };
  add(comparison, std::make_unique<OwnContender<Problem>>(problem, "gauss8"));
  add(comparison, std::make_unique<OwnContender<Problem>>(problem, "gauss16"));
}

Comparison compare(const Chain& chain) {
  Comparison c;
  c.name = std::to_string(chain.links) + (chain.bent ? " bent" : " planar");
  c.errors = {1e-3, 1e-6, 1e-9};
  c.bars = {
      {kPeers[0], {4, 10, 25}}, {kPeers[1], {3, 4, 4}}, {kPeers[2], {3, 4, 4}}, {kPeers[3], {5, 10, 30}}};
  if (chain.links == 100) c.bars.back().ratios = {30, 60, 150};
  add_own(c, chain, greatest_distance);
#ifdef PANTIN_BENCH_PINOCCHIO
  add(c, make_pinocchio_rk4(chain));
  add(c, make_pinocchio_dormand_prince(chain));
  add(c, make_pinocchio_fehlberg(chain));
#endif
#ifdef PANTIN_BENCH_MUJOCO
  add(c, make_mujoco(chain));
#endif
  return c;
}

Comparison compare(const Top& top) {
  Comparison c;
  c.name = "free top";
  c.errors = {1e-6, 1e-9};
  c.bars = {{kPeers[2], {4, 4}}, {kPeers[3], {20, 20}}};
  add_own(c, top, angle);
#ifdef PANTIN_BENCH_PINOCCHIO
  add(c, make_pinocchio_fehlberg(top));
#endif
#ifdef PANTIN_BENCH_MUJOCO
  add(c, make_mujoco(top));
#endif
  return c;
}

void print_rows(const Comparison& c) {
  for (const Entry& entry : c.entries) {
    for (const Row& row : entry.rows) {
      std::printf("%s, %s, %s: error %.1e, %.4f ms, %ld evaluations\n", c.name.c_str(),
                  entry.contender->name().c_str(), entry.contender->setting(row.number).c_str(), row.error,
                  1e3 * row.seconds, row.evaluations);
    }
  }
}

/// What each contender's best row says of the models being one.
void print_agreement(const Comparison& c) {
  std::printf("%s: dormand-prince at 1e-13 differs by %.1e", c.name.c_str(), c.confirmed);
  for (const Entry& entry : c.entries) {
    double least = std::numeric_limits<double>::infinity();
    for (const Row& row : entry.rows) least = std::min(least, row.error);
    std::printf("; %s comes to %.1e", entry.contender->name().c_str(), least);
  }
  std::printf("\n");
  std::fflush(stdout);
}

const char* sign_of(Known known) {
  return known == Known::Coarsest ? "<" : known == Known::Extrapolated ? "x" : "";
}

/// The time and ratio of a peer beside its bar; nothing where it takes no part.
std::string cell(const Comparison& c, const std::string& peer, std::size_t error, double own) {
  const auto bar = std::find_if(c.bars.begin(), c.bars.end(), [&](const Bar& b) { return b.peer == peer; });
  const auto entry = std::find_if(c.entries.begin() + kOwn, c.entries.end(),
                                  [&](const Entry& e) { return e.contender->name() == peer; });
  if (bar == c.bars.end() || entry == c.entries.end()) return "";
  const Crossing at = time_at(*entry, c.errors[error]);
  const double ratio = at.seconds / own;
  char text[96];
  std::snprintf(text, sizeof text, "%s%.3g ms, %s%.3g of %g", sign_of(at.known), 1e3 * at.seconds,
                ratio < bar->ratios[error] ? "**missed** " : "", ratio, bar->ratios[error]);
  return text;
}

void print_table(const std::vector<Comparison>& comparisons) {
  std::printf("\n| problem | error | Pantin |");
  for (const std::string& peer : kPeers) std::printf(" %s |", peer.c_str());
  std::printf("\n|---|---|---|---|---|---|---|\n");
  for (const Comparison& c : comparisons) {
    for (std::size_t e = 0; e < c.errors.size(); ++e) {
      const Crossing a = time_at(c.entries[0], c.errors[e]), b = time_at(c.entries[1], c.errors[e]);
      const bool first = a.seconds <= b.seconds;
      const Crossing& own = first ? a : b;
      std::printf("| %s | %.0e | %s%.3g ms, %s |", c.name.c_str(), c.errors[e], sign_of(own.known),
                  1e3 * own.seconds, c.entries[first ? 0 : 1].contender->name().c_str());
      for (const std::string& peer : kPeers) std::printf(" %s |", cell(c, peer, e, own.seconds).c_str());
      std::printf("\n");
    }
  }
}

}  // namespace
}  // namespace pantin::bench

int main(int argc, char** argv) {
  using namespace pantin::bench;
  bool rows = false;
  std::string part;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--rows") == 0) rows = true;
    else part = argv[i];
  }
#ifdef PANTIN_BENCH_PINOCCHIO
  std::printf("Pinocchio %s\n", pinocchio_version().c_str());
#endif
#ifdef PANTIN_BENCH_MUJOCO
  std::printf("MuJoCo %s\n", mujoco_version().c_str());
#endif
  std::vector<Comparison> comparisons;
  const auto take = [&](auto problem) {
    Comparison c = compare(problem);
    if (c.name.find(part) == std::string::npos) return;
    scout(c.entries, c.error_of, c.errors.back());
    race(c.entries);
    if (rows) print_rows(c);
    print_agreement(c);
    comparisons.push_back(std::move(c));
  };
  for (const int links : {5, 20, 100}) {
    for (const bool bent : {false, true}) take(Chain{links, bent});
  }
  take(Top{});
  print_table(comparisons);
}
