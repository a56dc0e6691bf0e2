// The lattice fitted to the ends of the held edges: the deforming zone of a bias extension is as wide as Eq. 14 has it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "mesher/lattice/fit.hpp"
#include "tests/unit/mesher/lattice/lattice_zoo.hpp"

namespace weaveform {
namespace {

using namespace lattice_zoo;

// Phases are kept to 2^-32 of a spacing, two of them to a distance.
constexpr double phase_grain = 1e-9;  // spacings
// How far the weights of tips and of the asked spacing may move a line off an end that bounds (fit.hpp).
constexpr double claimed = 0.0025;  // spacings

// Position (mm) of a place in the blank's frame across the lines of a family.
double across(const Animal& a, Family family, const std::array<double, 2>& place) {
  const auto other = direction(a.scene, family == Family::warp ? Family::weft : Family::warp);
  return other[0] * place[0] + other[1] * place[1];
}

double spacing_of_lines(const Mesh& mesh, Family family) {
  return mesh.spacing[family == Family::warp ? 1 : 0];
}

// Positions across of the family's lines that a grip holds at one end.
std::vector<double> held_lines(const Animal& a, const Mesh& mesh, Family family, const std::string& grip) {
  const auto set = std::find_if(mesh.sets.begin(), mesh.sets.end(), [&](const auto& s) { return s.name == grip; });
  std::vector<double> lines;
  for (int e = 0; e < mesh.yarn_count(); ++e)
    for (const int n : mesh.yarns.node[e])
      if (mesh.yarns.family[e] == family && std::binary_search(set->node.begin(), set->node.end(), n))
        lines.push_back(across(a, family, in_blank(mesh, n)));
  std::sort(lines.begin(), lines.end());
  return lines;
}

// Distance (mm) between the last line of one grip and the last of the other, where they face each other.
double free_width(const Animal& a, const Mesh& mesh, Family family) {
  const auto bottom = held_lines(a, mesh, family, "bottom");
  const auto top = held_lines(a, mesh, family, "top");
  return std::max(top.front() - bottom.back(), bottom.front() - top.back());
}

double zone_width(const Animal& a) {
  return (a.scene.blank.size[1] - a.scene.blank.size[0]) / std::sqrt(2.0);  // (L - W) / sqrt(2) of Eq. 14
}

double asked_spacing(const Animal& a, Family family) {
  const auto f = static_cast<std::size_t>(family);
  return a.scene.blank.coarsening[f] * a.card.yarn[f].interval;
}

// Some spacing within 15 % of the asked one goes a whole number of times into the width.
bool in_reach(double width, double asked) {
  return std::floor(width / (0.85 * asked)) >= std::ceil(width / (1.15 * asked));
}

// Distance of a position to the nearest line of the family, in spacings; the lines are known by any of their nodes.
double off_lines(const Animal& a, const Mesh& mesh, Family family, double position) {
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0; n < mesh.node_count(); ++n) {
    if (mesh.nodes.crossing[n][0] < 0) continue;
    const double number = (position - across(a, family, in_blank(mesh, n))) / spacing_of_lines(mesh, family);
    least = std::min(least, std::abs(number - std::round(number)));
  }
  return least;
}

TEST(LatticeFit, TheFreeWidthOfABiasExtensionIsThatOfEquation14) {
  for (const auto& card : {plain_weave(), twill()}) {
    for (const double ratio : {1.5, 1.7, 1.85, 2.0, 2.3, 2.5, 3.0}) {
      for (const double coarsening : {4.0, 2.0, 1.0, 0.5}) {
        const Animal a = bias_extension(card, 115.0, ratio * 115.0, coarsening);
        const Mesh mesh = build_mesh(a.scene, a.card);
        for (const Family family : {Family::warp, Family::weft}) {
          const double h = spacing_of_lines(mesh, family);
          const bool exact = in_reach(zone_width(a), asked_spacing(a, family));
          // In reach: what fit.hpp claims at either border. Out of reach: half a spacing, by the rule of who is held.
          EXPECT_NEAR(free_width(a, mesh, family), zone_width(a), 2.0 * (exact ? claimed : 0.5) * h) << a.name;
          EXPECT_NEAR(h / asked_spacing(a, family), 1.0, 0.15 + 1e-12) << a.name;
        }
      }
    }
  }
}

// Whole-number sizes of bias extensions: 2 : 1, where the zone is as wide as the tips lie apart, and 5 : 2.
TEST(LatticeFit, TheFreeWidthIsExactWhereTipsCanBeMetToo) {
  for (const auto& size : std::vector<std::array<double, 2>>{{115.0, 230.0}, {100.0, 250.0}, {150.0, 300.0}}) {
    for (const double coarsening : {4.0, 2.0, 1.0, 0.5}) {
      const Animal a = bias_extension(plain_weave(), size[0], size[1], coarsening);
      const Mesh mesh = build_mesh(a.scene, a.card);
      for (const Family family : {Family::warp, Family::weft})
        EXPECT_NEAR(free_width(a, mesh, family), zone_width(a), phase_grain * mesh.spacing[0]) << a.name;
    }
  }
}

TEST(LatticeFit, LinesPassThroughTheEndsThatBoundAZoneAtAnyAngle) {
  for (const double angle : {20.0, 30.0, 60.0, -45.0, 135.0}) {
    for (const double coarsening : {4.0, 1.0}) {
      const Animal a = bias_extension(plain_weave(), 115.0, 230.0, coarsening, angle);
      const Mesh mesh = build_mesh(a.scene, a.card);
      for (const Family family : {Family::warp, Family::weft}) {
        // Of two neighbouring corners one is outermost across the lines, a tip; the other bounds.
        const double first = across(a, family, {-57.5, -115.0});
        const double second = across(a, family, {57.5, -115.0});
        const double bound = std::abs(first) < std::abs(second) ? first : second;
        if (!in_reach(2.0 * std::abs(bound), asked_spacing(a, family))) continue;
        EXPECT_LE(off_lines(a, mesh, family, bound), claimed) << a.name;
        EXPECT_LE(off_lines(a, mesh, family, -bound), claimed) << a.name;
      }
    }
  }
}

// Sum over the held ends as fit.hpp has it, worked out here anew; tips are the blank's outermost corners.
double misfit(const lattice::Outline& outline, const lattice::GripRegions& grips, std::size_t axis, double spacing,
              double phase) {
  const auto box = lattice::bounding_box(outline);
  double sum = 0.0;
  for (const auto& region : grips.region) {
    for (const auto& end : region.end) {
      const bool tip = end[axis] < box.low[axis] + 1e-6 || end[axis] > box.high[axis] - 1e-6;
      const double off = std::remainder(end[axis] - phase * spacing, spacing) / spacing;
      sum += (tip ? lattice::tip_weight : 1.0) * off * off;
    }
  }
  return sum;
}

TEST(LatticeFit, IsNeverWorseThanNoFitAndStaysNearTheAskedSpacing) {
  for (double angle = -90.0; angle <= 90.0; angle += 7.5) {
    for (const double length : {60.0, 130.0, 173.0, 230.0, 411.0}) {
      const lattice::Turn yarns = lattice::turn_by_degrees(angle);
      const lattice::Outline outline = lattice::rectangle_outline({115.0, length}, yarns);
      Scene scene;
      scene.grip = {grip_on("bottom"), grip_on("right")};
      std::vector<std::string> complaints;
      const auto grips = lattice::grip_regions(scene, outline, yarns, 1e-6, complaints);
      const Vec2 asked = {9.8, 5.3};
      const auto fitted = lattice::fit_lines(outline, grips, asked);
      for (std::size_t axis = 0; axis < 2; ++axis) {
        EXPECT_LE(misfit(outline, grips, axis, fitted.spacing[axis], fitted.phase[1 - axis]),
                  misfit(outline, grips, axis, asked[axis], 0.0) + phase_grain)
            << angle << " deg, length " << length;
        EXPECT_NEAR(fitted.spacing[axis] / asked[axis], 1.0, 0.15 + 1e-12);
      }
    }
  }
}

TEST(LatticeFit, WithoutGripsOrWithAPlaceOfTheUsersOwnTheLatticeIsAsAsked) {
  const Animal gripped = bias_extension(twill(), 115.0, 211.0, 2.0);
  Animal loose = gripped;
  loose.scene.grip.clear();
  Animal unfitted = gripped;
  unfitted.scene.blank.fit = LineFit::none;
  Animal shifted = gripped;
  shifted.scene.blank.phase = {0.25, 0.0};
  for (const auto& a : {loose, unfitted, shifted}) {
    const Mesh mesh = build_mesh(a.scene, a.card);
    for (const Family family : {Family::warp, Family::weft}) {
      const double h = asked_spacing(a, family);
      EXPECT_EQ(spacing_of_lines(mesh, family), h);
      const double phase = a.scene.blank.phase[static_cast<std::size_t>(family)];
      EXPECT_LE(off_lines(a, mesh, family, phase * h), 1e-12);  // rounding of positions, in spacings
    }
  }
  const Mesh fitted = build_mesh(gripped.scene, gripped.card);
  EXPECT_NE(fitted.spacing[0], asked_spacing(gripped, Family::weft));  // else the above would prove nothing
}

// Where the lines fall at random, the free width is right on average: the line half a spacing beyond the edge's end is
// as likely held as the one half a spacing inside is the last. Held edges alone would make it one spacing too wide.
TEST(LatticeFit, UnfittedLinesLeaveTheFreeWidthUnbiased) {
  constexpr int phases = 40;
  for (const double angle : {45.0, 35.0, -50.0}) {
    double sum = 0.0;
    double h = 0.0;
    Animal a = bias_extension(plain_weave(), 115.0, 230.0, 2.0, angle);
    const double left = std::abs(across(a, Family::warp, {-57.5, -115.0}));
    const double right = std::abs(across(a, Family::warp, {57.5, -115.0}));
    for (int k = 0; k < phases; ++k) {
      a.scene.blank.phase = {(k + 0.5) / phases, 0.31};
      const Mesh mesh = build_mesh(a.scene, a.card);
      h = spacing_of_lines(mesh, Family::warp);
      const double width = free_width(a, mesh, Family::warp);
      EXPECT_NEAR(width, 2.0 * std::min(left, right), h * (1.0 + 1e-6)) << angle << " deg, phase " << k;
      sum += width;
    }
    // The phases are 1/40 of a spacing apart, which bounds the error of the mean at either border.
    EXPECT_NEAR(sum / phases, 2.0 * std::min(left, right), 2.0 * h / phases) << angle;
  }
}

TEST(LatticeFit, ASymmetricTestGetsASymmetricMesh) {
  for (const double length : {172.5, 184.0, 195.5, 230.0, 287.5}) {
    const Animal a = bias_extension(plain_weave(), 115.0, length, 4.0);
    const Mesh mesh = build_mesh(a.scene, a.card);
    std::vector<std::array<double, 2>> place;
    for (int n = 0; n < mesh.node_count(); ++n) place.push_back(in_blank(mesh, n));
    for (const auto& p : place) {
      const bool has_twin = std::any_of(place.begin(), place.end(), [&](const auto& q) {
        return std::hypot(p[0] + q[0], p[1] + q[1]) < 1e-6 * mesh.spacing[0];
      });
      EXPECT_TRUE(has_twin) << a.name << " node at " << p[0] << ", " << p[1];
    }
    EXPECT_EQ(held_lines(a, mesh, Family::warp, "bottom").size(), held_lines(a, mesh, Family::warp, "top").size());
  }
}

// A strip clamped by a box ends on the outline at the box's border, not at the blank's corner.
TEST(LatticeFit, LinesPassThroughTheEndsOfAClampedStrip) {
  Animal a = bias_extension(plain_weave(), 115.0, 260.0, 2.0);
  a.scene.grip[0].edge.reset();
  a.scene.grip[0].box = std::array<double, 4>{-60.0, -140.0, 60.0, -115.0};  // 15 mm of the blank's lower end
  a.scene.grip[1].edge.reset();
  a.scene.grip[1].box = std::array<double, 4>{-60.0, 115.0, 60.0, 140.0};
  const Mesh mesh = build_mesh(a.scene, a.card);
  for (const Family family : {Family::warp, Family::weft}) {
    const double left = across(a, family, {-57.5, -115.0});
    const double right = across(a, family, {57.5, -115.0});
    const double bound = std::abs(left) < std::abs(right) ? left : right;
    EXPECT_LE(off_lines(a, mesh, family, bound), claimed);
    EXPECT_NEAR(free_width(a, mesh, family), 2.0 * std::abs(bound), 2.0 * claimed * mesh.spacing[0]);
  }
}

// Unturned, the lines run along the held edges and the blank comes to whole cells.
TEST(LatticeFit, AnUnturnedBlankIsStretchedToWholeCells) {
  Animal a = animal(plain_weave(), 0.0, {10.4, 6.3}, {1.0, 1.0}, {0.0, 0.0}, true);
  const Mesh mesh = build_mesh(a.scene, a.card);
  EXPECT_EQ(mesh.lattice_size, (std::array<int, 2>{11, 7}));
  EXPECT_EQ(mesh.cells.size(), 60);
  EXPECT_NEAR(mesh.spacing[0], a.scene.blank.size[0] / 10.0, 1e-9);
  EXPECT_NEAR(mesh.spacing[1], a.scene.blank.size[1] / 6.0, 1e-9);
}

}  // namespace
}  // namespace weaveform
