#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <support/expect_contract.hpp>
#include <support/random_affine.hpp>

#include <pantin/scenegraph/link.hpp>

namespace pantin {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr LinkKind kKinds[] = {LinkKind::Fixed,  LinkKind::Pivot,       LinkKind::Slider,
                               LinkKind::Ball,   LinkKind::Cylindrical, LinkKind::Universal,
                               LinkKind::Planar, LinkKind::Screw,       LinkKind::Free};

Link link_of(LinkKind kind) {
  Link link;
  link.kind = kind;
  link.value = zero_value(kind);
  return link;
}

TEST(LinkKind, HasANameAndAValueOfItsSize) {
  // As listed in the header: names as in JSON, numbers per value.
  const char* names[] = {"fixed",     "pivot",  "slider", "ball", "cylindrical",
                         "universal", "planar", "screw",  "free"};
  const int sizes[] = {0, 1, 1, 4, 2, 2, 3, 1, 7}, limits[] = {0, 1, 1, 0, 2, 2, 3, 1, 0};
  for (std::size_t k = 0; k < std::size(kKinds); ++k) {
    EXPECT_EQ(to_string(kKinds[k]), names[k]);
    EXPECT_EQ(value_size(kKinds[k]), sizes[k]);
    EXPECT_EQ(limit_count(kKinds[k]), limits[k]);
    EXPECT_EQ(has_axis(kKinds[k]), limits[k] > 0);
    EXPECT_EQ(has_axis2(kKinds[k]), kKinds[k] == LinkKind::Universal || kKinds[k] == LinkKind::Planar);
    EXPECT_EQ(zero_value(kKinds[k]).size(), sizes[k]);
  }
}

TEST(LinkValue, HoldsItsNumbers) {
  // From one number, a list or a span; equal if count and numbers are.
  const double numbers[] = {1, 2, 3};
  const LinkValue value{std::span<const double>{numbers}};
  EXPECT_EQ(value, (LinkValue{1, 2, 3}));
  EXPECT_NE(value, (LinkValue{1, 2}));
  EXPECT_NE(value, (LinkValue{1, 2, 4}));
  EXPECT_EQ(value[2], 3);
  EXPECT_EQ(value.numbers().size(), 3U);
  EXPECT_EQ(LinkValue{0.5}.size(), 1);
  EXPECT_EQ(LinkValue{}.size(), 0);
  test::expect_contract([] { LinkValue{1, 2, 3, 4, 5, 6, 7, 8}; }, "at most 7 numbers, not 8");
}

TEST(LocalMatrix, IsTheProductOfTheFramesAtZero) {
  // T is the identity at the zero value, whatever the kind and the axis.
  std::mt19937_64 random{20};
  for (const LinkKind kind : kKinds) {
    Link link = link_of(kind);
    link.axis = test::random_vector(random).normalized();
    link.M_PJ = test::random_affine(random);
    link.M_JN = test::random_affine(random);
    EXPECT_LT(test::relative_error(local_matrix(link, link.value), link.M_PJ * link.M_JN), 1e-15);
  }
}

TEST(LocalMatrix, PivotTurnsRightHandedAboutItsAxis) {
  // A quarter turn about z takes x to y; the node sits one metre out on x in J.
  Link link = link_of(LinkKind::Pivot);
  link.M_PJ.translation() = Vector3{0, 0, 5};
  link.M_JN.translation() = Vector3{1, 0, 0};
  const Affine M = local_matrix(link, std::numbers::pi / 2);
  EXPECT_LT((M.translation() - Vector3{0, 1, 5}).norm(), 1e-15);
  EXPECT_LT((M.linear().col(0) - Vector3::UnitY()).norm(), 1e-15);
}

TEST(LocalMatrix, SliderMovesAlongItsAxis) {
  // Axis and distance are in J: a parent frame scaled by 2 doubles what is seen in the parent.
  Link link = link_of(LinkKind::Slider);
  link.axis = Vector3::UnitX();
  link.M_PJ.linear() *= 2;
  EXPECT_LT((local_matrix(link, 0.25).translation() - Vector3{0.5, 0, 0}).norm(), 1e-16);
}

TEST(LocalMatrix, CylindricalTurnsAboutAndMovesAlongItsAxis) {
  // Both keep the axis, so it is a pivot times a slider in either order.
  Link both = link_of(LinkKind::Cylindrical), pivot = link_of(LinkKind::Pivot),
       slider = link_of(LinkKind::Slider);
  both.axis = pivot.axis = slider.axis = Vector3{1, 2, 2} / 3;
  const Affine M = local_matrix(both, {0.7, -1.5});
  EXPECT_LT(test::relative_error(M, local_matrix(pivot, 0.7) * local_matrix(slider, -1.5)), 1e-15);
  EXPECT_LT(test::relative_error(M, local_matrix(slider, -1.5) * local_matrix(pivot, 0.7)), 1e-15);
}

TEST(LocalMatrix, UniversalTurnsAboutTheFirstAxisAndThenTheOneItCarries) {
  // A quarter turn about z carries the second axis from x to y; a quarter turn about y takes z to x.
  const Affine M = local_matrix(link_of(LinkKind::Universal), {std::numbers::pi / 2, std::numbers::pi / 2});
  EXPECT_LT((M.linear().col(0) - Vector3::UnitY()).norm(), 1e-15);
  EXPECT_LT((M.linear().col(2) - Vector3::UnitX()).norm(), 1e-15);
}

TEST(LocalMatrix, PlanarMovesAcrossItsAxis) {
  // With axis x and second axis y the third direction is z; the turn happens where the node has moved to.
  Link link = link_of(LinkKind::Planar);
  link.axis = Vector3::UnitX();
  link.axis2 = Vector3::UnitY();
  const Affine M = local_matrix(link, {2, 3, std::numbers::pi / 2});
  EXPECT_LT((M.translation() - Vector3{0, 2, 3}).norm(), 1e-15);
  EXPECT_LT((M.linear().col(1) - Vector3::UnitZ()).norm(), 1e-15);
}

TEST(LocalMatrix, ScrewMovesByItsPitch) {
  // A right-handed thread of 3 mm a turn moves 3 mm along its axis in one turn.
  Link link = link_of(LinkKind::Screw);
  link.axis = Vector3::UnitY();
  link.pitch = 0.003 / (2 * std::numbers::pi);
  const Affine M = local_matrix(link, 2 * std::numbers::pi);
  EXPECT_LT((M.translation() - Vector3{0, 0.003, 0}).norm(), 1e-17);
  EXPECT_LT((M.linear() - Matrix3::Identity()).norm(), 1e-15);
}

TEST(WithZeroOffset, ShiftsNumbersAndKeepsMatrices) {
  // By definition: the new link at v + offset stands where the old one stands at v; its limits, its mimic and
  // its present value are shifted alike. Frames are sheared, so every factor's place counts.
  std::mt19937_64 random{24};
  for (const LinkKind kind : {LinkKind::Pivot, LinkKind::Slider, LinkKind::Cylindrical, LinkKind::Universal,
                              LinkKind::Planar, LinkKind::Screw}) {
    Link link = link_of(kind);
    link.M_PJ = test::random_affine(random);
    link.M_JN = test::random_affine(random);
    link.pitch = 0.3;
    link.limits = {{{-1, 1}, {-2, 2}, {-3, 3}}};
    if (value_size(kind) == 1) link.mimic = LinkMimic{.source = "leader", .multiplier = 2, .offset = 0.5};
    LinkValue v = link.value, offset = link.value, shifted = link.value;
    for (int i = 0; i < v.size(); ++i) {
      v[i] = test::uniform(random, -2, 2);
      offset[i] = test::uniform(random, -2, 2);
      shifted[i] = v[i] + offset[i];
    }
    const Link moved = with_zero_offset(link, offset);
    EXPECT_LT(test::relative_error(local_matrix(moved, shifted), local_matrix(link, v)), 1e-13)
        << to_string(kind);
    EXPECT_EQ(moved.value, offset);
    for (std::size_t i = 0; i < static_cast<std::size_t>(v.size()); ++i) {
      EXPECT_EQ(moved.limits[i].lower, link.limits[i].lower + offset[static_cast<int>(i)]);
      EXPECT_EQ(moved.limits[i].upper, link.limits[i].upper + offset[static_cast<int>(i)]);
    }
    if (moved.mimic) {
      EXPECT_EQ(moved.mimic->offset, 0.5 + offset[0]);
    }
  }
  test::expect_contract(
      [] {
        static_cast<void>(with_zero_offset(link_of(LinkKind::Ball), {1, 0, 0, 0}));
      },
      "a ball link is counted by a quaternion: change M_PJ or M_JN instead");
  test::expect_contract(
      [] {
        static_cast<void>(with_zero_offset(link_of(LinkKind::Pivot), {1, 0}));
      },
      "offset: a pivot link's value has 1 numbers, not 2");
}

TEST(LocalMatrix, BallAndFreeNormaliseTheirQuaternion) {
  // (2, 0, 0, 2) is a quarter turn about z, as its direction says; free adds its translation.
  const Affine ball = local_matrix(link_of(LinkKind::Ball), {2, 0, 0, 2});
  EXPECT_LT((ball.linear().col(0) - Vector3::UnitY()).norm(), 1e-15);
  const Affine free = local_matrix(link_of(LinkKind::Free), {1, 2, 3, 2, 0, 0, 2});
  EXPECT_LT((free.linear() - ball.linear()).norm(), 1e-15);
  EXPECT_EQ(free.translation(), Vector3(1, 2, 3));
}

TEST(LocalMatrix, RefusesAValueOfAnotherKind) {
  // A pivot has one number, not two.
  test::expect_contract(
      [] {
        static_cast<void>(local_matrix(link_of(LinkKind::Pivot), {1, 2}));
      },
      "a pivot link's value has 1 numbers, not 2");
}

TEST(ProblemWithLink, IsEmptyForGoodLinks) {
  // Every kind at its zero, with limits and mimic where they belong; other kinds do not look at axis and
  // limits.
  for (const LinkKind kind : kKinds) EXPECT_EQ(problem_with(link_of(kind)), "");
  Link pivot = link_of(LinkKind::Pivot);
  pivot.limits[0].lower = -1;
  pivot.limits[0].upper = -1;
  pivot.mimic = LinkMimic{.source = "other", .multiplier = -2};
  EXPECT_EQ(problem_with(pivot), "");
  Link ball = link_of(LinkKind::Ball);
  ball.axis.setZero();
  ball.limits[0].lower = 1;
  ball.limits[0].upper = -1;
  EXPECT_EQ(problem_with(ball), "");
}

TEST(ProblemWithLink, NamesEachFault) {
  // One fault each in an otherwise good link; the text must be the one for that fault.
  const auto text_of = [](LinkKind kind, const auto& spoil) {
    Link link = link_of(kind);
    spoil(link);
    return problem_with(link);
  };
  EXPECT_EQ(text_of(LinkKind::Ball, [](Link& l) { l.value = 0.0; }),
            "a ball link's value has 4 numbers, not 1");
  EXPECT_EQ(text_of(LinkKind::Pivot, [](Link& l) { l.value = kNaN; }),
            "value has a number that is not finite");
  EXPECT_EQ(text_of(LinkKind::Free, [](Link& l) { l.value = {1, 1, 1, 0, 0, 0, 0}; }),
            "value has a quaternion of length 0; the identity is 1, 0, 0, 0");
  EXPECT_EQ(text_of(LinkKind::Fixed, [](Link& l) { l.M_PJ(0, 3) = kNaN; }),
            "M_PJ has an entry that is not finite");
  EXPECT_EQ(text_of(LinkKind::Fixed, [](Link& l) { l.M_JN.linear().col(1).setZero(); }),
            "M_JN is singular; its scale must not be 0 along any axis");
  EXPECT_EQ(text_of(LinkKind::Slider, [](Link& l) { l.M_PJ.linear().col(1) = l.M_PJ.linear().col(0); }),
            "M_PJ is singular; its scale must not be 0 along any axis");
  EXPECT_EQ(text_of(LinkKind::Pivot, [](Link& l) { l.axis *= 2; }),
            "axis has length 2.000000; it must be 1, so normalise it");
  EXPECT_NE(text_of(LinkKind::Pivot, [](Link& l) { l.axis.x() = kNaN; }), "");
  EXPECT_EQ(text_of(LinkKind::Slider, [](Link& l) { l.limits[0].lower = 2, l.limits[0].upper = 1; }),
            "lower limit 2.000000 is above the upper limit 1.000000");
  EXPECT_NE(text_of(LinkKind::Slider, [](Link& l) { l.limits[0].upper = kNaN; }), "");
  EXPECT_EQ(text_of(LinkKind::Ball, [](Link& l) { l.mimic = LinkMimic{.source = "a"}; }),
            "a ball link cannot follow another; only pivots, sliders and screws can");
  EXPECT_EQ(text_of(LinkKind::Cylindrical,
                    [](Link& l) {
                      l.limits[1] = {2, 1};
                    }),
            "lower limit 2.000000 is above the upper limit 1.000000");
  EXPECT_EQ(text_of(LinkKind::Universal, [](Link& l) { l.axis2 *= 2; }),
            "axis2 has length 2.000000; it must be 1, so normalise it");
  EXPECT_EQ(text_of(LinkKind::Planar, [](Link& l) { l.axis2 = l.axis; }),
            "axis2 is not perpendicular to axis; take its part along axis away and normalise it");
  EXPECT_EQ(text_of(LinkKind::Screw, [](Link& l) { l.pitch = kNaN; }),
            "pitch is not finite; it is metres per rad");
  EXPECT_EQ(text_of(LinkKind::Pivot, [](Link& l) { l.mimic = LinkMimic{}; }),
            "mimic names no link to follow");
  EXPECT_EQ(text_of(LinkKind::Pivot, [](Link& l) { l.mimic = LinkMimic{.source = "a", .offset = kNaN}; }),
            "multiplier and offset of mimic must be finite");
}

}  // namespace
}  // namespace pantin
