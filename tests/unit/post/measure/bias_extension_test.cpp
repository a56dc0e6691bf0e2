#include "post/measure/bias_extension.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/vector/angle.hpp"
#include "post/measure/zones.hpp"
#include "tests/unit/post/measure/ideal_bias.hpp"

namespace weaveform {
namespace {

const std::vector<std::array<double, 2>> sizes = {
    {100.0, 140.0}, {115.0, 230.0}, {100.0, 320.0}};  // mm; L/W 1.4, 2, 3.2

BiasSpecimen specimen_of(const std::array<double, 2>& size) {
  BiasSpecimen specimen;
  specimen.width = size[0];
  specimen.length = size[1];
  return specimen;
}

// t sum_z A_z w(gamma_z) (mJ), w the integral of sigma d(sin gamma) by Simpson's rule; the current thickness rule
// scales it.
double stored_energy(const BiasSpecimen& specimen, const Card& card, Thickness rule, double travel) {
  const auto density = [&](double angle) {
    constexpr int parts = 400;
    double sum = 0.0;
    for (int k = 0; k <= parts; ++k) {
      const double g = angle * k / parts;
      const double ratio = rule == Thickness::constant ? std::cos(g) : 1.0;
      const double weight = k == 0 || k == parts ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
      sum += weight * ratio * shear_stress(card.shear, std::atanh(std::sin(g))) * std::cos(g);
    }
    return sum * angle / (3.0 * parts);
  };
  const ZoneAreas area = zone_areas(specimen);
  const double angle = kinematic_shear_angle(specimen, travel);
  return card.thickness * (area.a * density(angle) + area.b * density(angle / 2.0));
}

TEST(BiasExtension, KinematicAngleIsEquation14WhenTwiceAsLongAsWide) {
  const double width = 115.0;
  const BiasSpecimen specimen = specimen_of({width, 2.0 * width});
  for (double travel = 0.0; travel < 47.0; travel += 1.0) {
    const double equation14 =
        std::numbers::pi / 2.0 - 2.0 * std::acos((width + travel) / (width * std::numbers::sqrt2));
    EXPECT_NEAR(kinematic_shear_angle(specimen, travel), equation14, 1e-14);
  }
  EXPECT_NEAR(kinematic_shear_angle(specimen, 0.0), 0.0, 1e-15);
}

TEST(BiasExtension, KinematicAngleAgreesWithTheMotionItComesFrom) {
  for (const auto& size : sizes) {
    const BiasSpecimen specimen = specimen_of(size);
    Mesh ends;
    ends.nodes.position = {{0.0, -size[1] / 2.0, 0.0}, {0.0, size[1] / 2.0, 0.0}};
    for (const double degrees : {-10.0, 5.0, 30.0, 60.0, 85.0}) {
      const std::vector<Vec3> moved = test::ideal_positions(ends, specimen, degrees * degree);
      const double travel = moved[1][1] - moved[0][1] - size[1];
      EXPECT_NEAR(kinematic_shear_angle(specimen, travel), degrees * degree, 1e-12);
    }
  }
}

TEST(BiasExtension, PastNinetyDegreesThereIsNoIdeal) {
  const BiasSpecimen specimen = specimen_of({100.0, 200.0});
  const double last = (std::numbers::sqrt2 - 1.0) * 100.0;
  EXPECT_FALSE(std::isnan(kinematic_shear_angle(specimen, last - 1e-6)));
  EXPECT_TRUE(std::isnan(kinematic_shear_angle(specimen, last + 1e-6)));
  EXPECT_TRUE(std::isnan(
      inextensible_bias_load(specimen, test::small_card().shear, 0.5, Thickness::constant_volume, last + 1e-6)));
}

TEST(BiasExtension, LoadIsTheDerivativeOfTheStoredEnergy) {
  const Card card = test::small_card();
  for (const auto& size : sizes)
    for (const Thickness rule : {Thickness::constant_volume, Thickness::constant}) {
      const BiasSpecimen specimen = specimen_of(size);
      for (const double part : {0.05, 0.2, 0.35}) {
        const double travel = part * specimen.free_length(), h = 1e-3;
        const double slope =
            (stored_energy(specimen, card, rule, travel + h) - stored_energy(specimen, card, rule, travel - h)) /
            (2.0 * h);
        const double load = inextensible_bias_load(specimen, card.shear, card.thickness, rule, travel);
        // Central difference over 1e-3 mm: relative error near (h/D)^2, some 1e-8, and rounding of 1e-16 D/h.
        EXPECT_NEAR(load / slope, 1.0, 1e-6) << size[1] / size[0] << " " << part;
      }
    }
}

// Normalised shear force of a bias extension, L >= 2W: Cao et al. 2008, Composites A 39 (the benchmark, reference [5]
// of the paper), solved for the load: F (L/W - 1)(cos g/2 - sin g/2) = (2L - 3W) Fsh(g) cos g + W Fsh(g/2) cos(g/2).
TEST(BiasExtension, LoadAgreesWithTheNormalisedShearForce) {
  const Card card = test::small_card();
  const auto normalised = [&](double g) { return card.thickness * shear_stress(card.shear, std::atanh(std::sin(g))); };
  for (const auto& size : {sizes[1], sizes[2]}) {
    const auto [w, l] = size;
    const BiasSpecimen specimen = specimen_of(size);
    for (const double part : {0.05, 0.2, 0.35}) {
      const double travel = part * specimen.free_length();
      const double g = kinematic_shear_angle(specimen, travel);
      const double left = (l / w - 1.0) * (std::cos(g / 2.0) - std::sin(g / 2.0));
      const double right =
          (2.0 * l - 3.0 * w) * normalised(g) * std::cos(g) + w * normalised(g / 2.0) * std::cos(g / 2.0);
      EXPECT_NEAR(inextensible_bias_load(specimen, card.shear, card.thickness, Thickness::constant_volume, travel),
                  right / left, 1e-12 * right / left);
    }
  }
}

TEST(BiasExtension, ZoneAreasFillTheSpecimenAndMatchACountOfPoints) {
  for (const auto& size : sizes) {
    const BiasSpecimen specimen = specimen_of(size);
    const ZoneAreas area = zone_areas(specimen);
    EXPECT_NEAR(area.a + area.b + area.c, size[0] * size[1], 1e-9);
    constexpr int points = 1000;
    std::array<double, 4> counted = {};
    for (int i = 0; i < points; ++i)
      for (int j = 0; j < points; ++j) {
        const double across = ((i + 0.5) / points - 0.5) * size[0], along = ((j + 0.5) / points - 0.5) * size[1];
        counted[static_cast<std::size_t>(zone_of_point(specimen, across, along))] += size[0] * size[1] / 1e6;
      }
    // A boundary of some 5 L is off by at most one of 1000 points across it.
    const double tolerance = 5.0 * size[1] * size[1] / points;
    EXPECT_NEAR(counted[0], area.a, tolerance);
    EXPECT_NEAR(counted[1], area.b, tolerance);
    EXPECT_NEAR(counted[2], area.c, tolerance);
  }
  const ZoneAreas paper = zone_areas(specimen_of({100.0, 200.0}));
  EXPECT_DOUBLE_EQ(paper.a, 5000.0);
  EXPECT_DOUBLE_EQ(paper.b, 10000.0);
  EXPECT_DOUBLE_EQ(paper.c, 5000.0);
}

TEST(Zones, IdealMotionShearsEachZoneByItsOwnAngle) {
  for (const auto& size : sizes) {
    const Scene scene = test::bias_scene(size[0], size[1]);
    const BiasSpecimen specimen = *find_bias_extension(scene);
    const Mesh mesh = test::bias_lattice(size[0], size[1], 4.3);
    const double angle = 40.0 * degree;
    const Fields fields =
        compute_fields(mesh, test::small_card(), {}, 0.0, test::ideal_positions(mesh, specimen, angle));
    const auto by_zone = angles_by_zone(mesh.cells, zones_of_cells(mesh, scene.blank, specimen), fields.shear_angle);
    const std::array<double, 3> expected = {angle, angle / 2.0, 0.0};
    for (std::size_t z = 0; z < 3; ++z) {
      EXPECT_GT(by_zone[z].cells, 20);
      EXPECT_NEAR(by_zone[z].mean, expected[z], 1e-12);
      EXPECT_NEAR(by_zone[z].sd, 0.0, 1e-12);
    }
  }
}

TEST(Zones, FollowTheBlankWhenItIsTurnedAndShifted) {
  Scene scene = test::bias_scene(115.0, 230.0);
  const BiasSpecimen specimen = *find_bias_extension(scene);
  Mesh mesh = test::bias_lattice(115.0, 230.0, 4.3);
  const std::vector<Zone> straight = zones_of_cells(mesh, scene.blank, specimen);
  scene.blank.orientation = 30.0;
  scene.blank.position = {50.0, -20.0, 7.0};
  const double c = std::cos(30.0 * degree), s = std::sin(30.0 * degree);
  for (Vec3& x : mesh.nodes.position) x = {c * x[0] - s * x[1] + 50.0, s * x[0] + c * x[1] - 20.0, 7.0};
  EXPECT_EQ(zones_of_cells(mesh, scene.blank, specimen), straight);
}

TEST(Zones, EmptyZoneHasNoAngle) {
  const Mesh mesh = test::lattice(2, 2, 5.0);
  const auto by_zone = angles_by_zone(mesh.cells, {Zone::a}, {0.2});
  EXPECT_EQ(by_zone[1].cells, 0);
  EXPECT_TRUE(std::isnan(by_zone[1].mean));
  EXPECT_TRUE(std::isnan(by_zone[1].sd));
}

TEST(FindBiasExtension, KnowsTheTestOnEitherAxisAndAtEitherSignOfTheAngle) {
  Scene scene = test::bias_scene(115.0, 230.0);
  for (const double yarn_angle : {45.0, -45.0, 135.0, 225.0}) {
    scene.blank.yarn_angle = yarn_angle;
    EXPECT_TRUE(find_bias_extension(scene).has_value()) << yarn_angle;
  }
  scene.blank.size = {230.0, 115.0};
  EXPECT_FALSE(find_bias_extension(scene).has_value());  // wider than long
  scene.grip[0].edge = BlankEdge::right;
  scene.grip[1].edge = BlankEdge::left;
  const auto specimen = find_bias_extension(scene);
  ASSERT_TRUE(specimen.has_value());
  EXPECT_EQ(specimen->axis, 0);
  EXPECT_EQ(specimen->length, 230.0);
  EXPECT_EQ(specimen->grip, (std::array<std::string, 2>{"upper", "lower"}));
}

TEST(FindBiasExtension, TakesAStackForOneTestWhereAllPliesAreSpecimensOfOneSizeInTheSameGrips) {
  const Scene one = test::bias_scene(115.0, 230.0);
  Scene other = one;
  other.blank.yarn_angle = -45.0;
  EXPECT_TRUE(find_bias_extension({&one, &other}).has_value());
  other.blank.size = {100.0, 230.0};
  EXPECT_FALSE(find_bias_extension({&one, &other}).has_value());
  other = one;
  other.blank.yarn_angle = 0.0;
  EXPECT_FALSE(find_bias_extension({&one, &other}).has_value());
  EXPECT_FALSE(find_bias_extension({&other, &one}).has_value());
  other = one;
  other.grip.pop_back();  // held by one of the two
  EXPECT_FALSE(find_bias_extension({&one, &other}).has_value());
}

TEST(FindBiasExtension, LeavesOtherTestsAlone) {
  const auto changed = [](auto change) {
    Scene scene = test::bias_scene(115.0, 230.0);
    change(scene);
    return find_bias_extension(scene).has_value();
  };
  EXPECT_FALSE(changed([](Scene& s) { s.blank.yarn_angle = 0.0; }));
  EXPECT_FALSE(changed([](Scene& s) { s.blank.shape = BlankShape::disc; }));
  EXPECT_FALSE(changed([](Scene& s) { s.grip.pop_back(); }));
  EXPECT_FALSE(changed([](Scene& s) { s.grip[1].edge = BlankEdge::right; }));
  EXPECT_FALSE(changed([](Scene& s) { s.grip[1].direction = {1.0, 0.0, 0.0}; }));
  EXPECT_FALSE(changed([](Scene& s) { s.grip[1].free = {Component::x}; }));
  EXPECT_TRUE(changed([](Scene& s) { s.grip[1].free = {Component::z}; }));
  EXPECT_TRUE(changed([](Scene& s) { s.grip[1].direction = {0.0, -2.0, 0.0}; }));
}

}  // namespace
}  // namespace weaveform
