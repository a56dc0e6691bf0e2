// Length, height and area of waves on fabric whose shape is known.
#include "post/forming/waves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/post/forming/forming_shapes.hpp"

namespace weaveform {
namespace {

using std::numbers::pi;

constexpr double extent = 240.0;  // mm

Mesh square(double spacing) {
  return test::centred_lattice(static_cast<int>(std::lround(extent / spacing)) + 1, spacing);
}

Waves waves_of(const Mesh& mesh, const std::vector<Vec3>& position) {
  return find_waves(mesh, out_of_plane_curvatures(mesh, position));
}

// z = a sin(2 pi x'/l + phase), x' at `angle` (rad) from the warp.
Waves sinusoid(double spacing, double amplitude, double wavelength, double angle = 0.0, double phase = 0.3) {
  const Mesh mesh = square(spacing);
  return waves_of(mesh, test::moved(mesh, [&](const Vec3& x) {
                    const double along = x[0] * std::cos(angle) + x[1] * std::sin(angle);
                    return Vec3{x[0], x[1], amplitude * std::sin(2.0 * pi * along / wavelength + phase)};
                  }));
}

// Heights of nodes of a sinusoid turn in proportion to themselves, so that inflections are where chords cross zero: half
// a cell off at most, and right in the mean. Two waves and more.
TEST(Waves, ASinusoidHasItsLengthOnAnyMesh) {
  for (const double cells : {3.0, 4.3, 6.0, 11.7, 24.0}) {
    const double spacing = 4.0, wavelength = cells * spacing;
    const Waves found = sinusoid(spacing, 0.03 * wavelength, wavelength);
    // chords are longer than their flat yarns' by slopes of 0.19: curvature a little less, zeros the same
    EXPECT_NEAR(found.yarn[0].wavelength / wavelength, 1.0, cells < 5.0 ? 0.12 : 0.03) << cells;
    EXPECT_NEAR(found.yarn[0].cells, cells, 0.12 * cells);
    EXPECT_EQ(found.yarn[1].half_waves, 0) << "along the crests";
  }
}

// The highest node: at least cos(pi/n) of the crest.
TEST(Waves, ASinusoidHasTheHeightOfItsHighestNodes) {
  for (const double cells : {4.3, 8.0, 16.0}) {
    const double spacing = 4.0, amplitude = 0.02 * cells * spacing;
    const WaveMeasure found = sinusoid(spacing, amplitude, cells * spacing).all;
    // the line between inflections, not the plane: they are off it by the square of half a cell
    EXPECT_LT(found.greatest_amplitude, 1.05 * amplitude) << cells;
    EXPECT_GT(found.amplitude, 0.95 * std::cos(pi / cells) * amplitude) << cells;
  }
}

TEST(Waves, ObliqueWavesAreLongerAlongBothYarns) {
  for (const double angle : {30.0, 45.0}) {
    const Waves found = sinusoid(3.0, 2.0, 36.0, angle * pi / 180.0);
    EXPECT_NEAR(found.yarn[0].wavelength, 36.0 / std::cos(angle * pi / 180.0), 0.04 * 36.0);
    EXPECT_NEAR(found.yarn[1].wavelength, 36.0 / std::sin(angle * pi / 180.0), 0.04 * 72.0);
  }
}

// Twice as long a wave on half the sheet: half waves weigh by height times area, a half wave of the long ones twice.
TEST(Waves, TheMedianIsThatOfTheHighAndTheWide) {
  const Mesh mesh = square(3.0);
  const auto both = [&](double low, double high) {
    return waves_of(
        mesh, test::moved(mesh, [&](const Vec3& x) {
          return Vec3{x[0], x[1],
                      x[1] < 0.0 ? low * std::sin(2.0 * pi * x[0] / 24.0) : high * std::sin(2.0 * pi * x[0] / 48.0)};
        }));
  };
  EXPECT_NEAR(both(1.0, 3.0).yarn[0].wavelength, 48.0, 1.0);
  EXPECT_NEAR(both(3.0, 0.6).yarn[0].wavelength, 24.0, 1.0);
}

TEST(Waves, ZigzagsAreTwoCellsLongAndTheMeshs) {
  const double spacing = 4.0;
  const Mesh mesh = square(spacing);
  Waves found = waves_of(mesh, test::moved(mesh, [&](const Vec3& x) {
                           const auto column = static_cast<int>(std::lround((x[0] + 0.5 * extent) / spacing));
                           return Vec3{x[0], x[1], column % 2 == 0 ? 0.6 : -0.6};
                         }));
  found.bends = true;
  EXPECT_NEAR(found.yarn[0].wavelength, 2.0 * spacing, 1e-6);
  EXPECT_NEAR(found.all.cells, 2.0, 1e-6);
  // 0.6 mm on chords of 4.18 mm: the turn is twice atan(0.3), a little less than its tangent
  EXPECT_NEAR(found.all.amplitude, 0.6, 0.03);
  EXPECT_EQ(found.are(), WavesOf::mesh);
  EXPECT_EQ(found.unresolved_share, 1.0);
}

TEST(Waves, WhoseTheyAreIsSaidByTheCellsAWave) {
  Waves fine = sinusoid(4.0, 1.0, 4.0 * (least_cells_per_wave + 2.0));
  EXPECT_EQ(fine.are(), WavesOf::mesh) << "nothing gives waves a length in a model that does not bend";
  fine.bends = true;
  EXPECT_EQ(fine.are(), WavesOf::fabric);
  Waves coarse = sinusoid(4.0, 1.0, 4.0 * (least_cells_per_wave - 2.0));
  coarse.bends = true;
  EXPECT_EQ(coarse.are(), WavesOf::mesh);
  EXPECT_EQ(Waves{}.are(), WavesOf::nobody);
}

TEST(Waves, BowlsSpansCurlsAndShallowRipplesAreNone) {
  const Mesh mesh = square(4.0);
  const auto none = [&](const std::function<Vec3(const Vec3&)>& map) {
    return waves_of(mesh, test::moved(mesh, map)).all.half_waves == 0;
  };
  EXPECT_TRUE(none([](const Vec3& x) { return x; }));
  EXPECT_TRUE(none([](const Vec3& x) { return test::on_bowl(x, 150.0); }));
  EXPECT_TRUE(none([](const Vec3& x) { return Vec3{x[0], x[1], 1e-5 * x[0] * x[0] * x[0]}; })) << "an S";
  EXPECT_TRUE(none([](const Vec3& x) {
    return Vec3{x[0], x[1], x[0] > 80.0 ? 0.01 * (x[0] - 80.0) * (x[0] - 80.0) : 0.0};
  })) << "a curled edge";
  // amplitude of a quarter of the thickness of 0.5 mm, where half of it makes a wrinkle
  EXPECT_TRUE(none([](const Vec3& x) { return Vec3{x[0], x[1], 0.125 * std::sin(2.0 * pi * x[0] / 24.0)}; }));
}

// A buckle between stretches that lie on the tool: its crest has feet, and so a length.
TEST(Waves, ALoneBuckleOnAToolHasALength) {
  const Mesh mesh = square(3.0);
  const Wrinkles wrinkles = find_wrinkles(
      mesh,
      test::moved(mesh,
                  [](const Vec3& x) {
                    const double z = std::abs(x[0]) < 30.0 ? 2.0 * (1.0 + std::cos(2.0 * pi * x[0] / 60.0)) : 0.0;
                    return Vec3{x[0], x[1], z};
                  }),
      {test::plane_tool(0.0)});
  const Waves found = find_waves(mesh, wrinkles.excess);
  EXPECT_NEAR(found.yarn[0].wavelength, 60.0, 2.0);
  // the height of the crest over its inflections
  EXPECT_NEAR(found.yarn[0].amplitude, 2.0, 0.1);
  EXPECT_NEAR(found.area_share, 60.0 / extent, 0.03) << "feet are part of it";
}

// The tool's own curvature is no wave, and does not change those on it: here along the circles of a cylinder.
TEST(Waves, OnACurvedToolTheyAreThoseOfTheExcess) {
  const double radius = 120.0, amplitude = 1.2, wavelength = 30.0;
  const Mesh mesh = square(2.5);
  const auto position = test::moved(mesh, [&](const Vec3& x) {
    const double angle = x[0] / radius, r = radius + amplitude * std::sin(2.0 * pi * x[0] / wavelength);
    return Vec3{r * std::sin(angle), x[1], -r * std::cos(angle)};
  });
  PlacedTool roll = test::sphere_tool(radius);
  roll.tool.shape = ToolShape::cylinder;
  roll.place.axis = {0.0, 1.0, 0.0};
  const Waves found = find_waves(mesh, find_wrinkles(mesh, position, {roll}).excess);
  EXPECT_NEAR(found.yarn[0].wavelength, wavelength, 0.05 * wavelength);
  // between 0 and the roll's 1/R nothing counts: of a curvature of 0.053 /mm a sixth is cut off one way
  EXPECT_NEAR(found.yarn[0].amplitude, amplitude, 0.2 * amplitude);
  const auto lying = test::moved(mesh, [&](const Vec3& x) {
    return Vec3{radius * std::sin(x[0] / radius), x[1], -radius * std::cos(x[0] / radius)};
  });
  EXPECT_EQ(find_waves(mesh, find_wrinkles(mesh, lying, {roll}).excess).all.half_waves, 0);
}

// Noise of a tenth of the least wrinkle does not cut waves into pieces.
TEST(Waves, NoiseDoesNotPartThem) {
  const Mesh mesh = square(3.0);
  const auto found = waves_of(
      mesh, test::moved(mesh, [&](const Vec3& x) {
        const auto column = static_cast<int>(std::lround((x[0] + 0.5 * extent) / 3.0));
        return Vec3{x[0], x[1], 2.0 * std::sin(2.0 * pi * x[0] / 60.0 + 0.3) + (column % 2 == 0 ? 0.02 : -0.02)};
      }));
  EXPECT_NEAR(found.yarn[0].wavelength, 60.0, 6.0) << "an inflection may be a cell off";
}

TEST(Waves, CompressedFibreIsCountedByItsLength) {
  const Mesh mesh = square(8.0);
  std::vector<double> strain(static_cast<std::size_t>(mesh.yarn_count()), 0.0);
  EXPECT_EQ(compressed_fibre_share(mesh, strain), 0.0);
  for (int e = 0; e < mesh.yarn_count(); ++e)
    strain[static_cast<std::size_t>(e)] = mesh.yarns.family[e] == Family::warp ? -2.0 * compressed_from : 0.01;
  EXPECT_NEAR(compressed_fibre_share(mesh, strain), 0.5, 1e-12);
  for (double& e : strain) e = -0.5 * compressed_from;
  EXPECT_EQ(compressed_fibre_share(mesh, strain), 0.0) << "noise of slack yarns";
}

}  // namespace
}  // namespace weaveform
