// Parts of the comparison against closed forms: rigid fits, monotonic loads, step widths, isolines, settings.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

#include "core/error.hpp"
#include "post/dic/comparison/compare.hpp"
#include "post/dic/comparison/triangulation.hpp"
#include "post/dic/virtual/step_width.hpp"
#include "tests/support/run_command.hpp"

namespace {

using namespace weaveform;
using namespace weaveform::dic;

TEST(RigidFit, RecoversAMotionAndAveragesMarks) {
  const std::vector<Vec2> from = {{0.0, 0.0}, {100.0, 0.0}, {100.0, 50.0}, {-20.0, 70.0}};
  RigidMotion truth;
  truth.angle = 2.5;
  truth.shift = {-13.0, 400.0};
  std::vector<Vec2> to;
  for (const Vec2& p : from) to.push_back(truth.moved(p));
  const RigidMotion found = rigid_fit(from, to);
  EXPECT_NEAR(found.angle, truth.angle, 1e-14);
  EXPECT_NEAR(found.shift[0], truth.shift[0], 1e-12);
  EXPECT_NEAR(found.shift[1], truth.shift[1], 1e-12);
}

TEST(Monotonic, IsTheNearestRisingSequence) {
  EXPECT_EQ(made_monotonic({1.0, 2.0, 3.0}), (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(made_monotonic({1.0, 4.0, 2.0, 3.0, 9.0}), (std::vector<double>{1.0, 3.0, 3.0, 3.0, 9.0}));
  EXPECT_EQ(made_monotonic({3.0, 2.0, 1.0}), (std::vector<double>{2.0, 2.0, 2.0}));
}

TEST(StepWidth, OfARampIsEightTenths) {
  std::vector<double> s, up, down, flat;
  for (int i = 0; i <= 400; ++i) {
    s.push_back(0.1 * i);
    const double way = std::clamp((s.back() - 15.0) / 10.0, 0.0, 1.0);
    up.push_back(0.2 + 0.3 * way);
    down.push_back(0.5 - 0.3 * way);
    flat.push_back(0.2);
  }
  EXPECT_NEAR(step_width(s, up), 8.0, 1e-9);
  EXPECT_NEAR(step_width(s, down), 8.0, 1e-9);
  EXPECT_TRUE(std::isnan(step_width(s, flat)));
}

std::vector<Vec2> square_grid(int side) {
  std::vector<Vec2> points;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) points.push_back({static_cast<double>(i), static_cast<double>(j)});
  return points;
}

TEST(Isolines, OfAPlaneAreStraightAndWhole) {
  const auto points = square_grid(11);
  const auto triangles = triangulate(points, 1.6);
  EXPECT_EQ(triangles.size(), 200U);
  std::vector<double> value;
  for (const Vec2& p : points) value.push_back(2.0 * p[0] + p[1] - 15.0);  // -15 to 15
  const auto lines = isolines(points, triangles, value, 4.0);
  std::multiset<double> levels;
  for (const Isoline& line : lines) {
    levels.insert(line.level);
    for (const Vec3& p : line.point) EXPECT_NEAR(2.0 * p[0] + p[1] - 15.0, line.level, 1e-12);
    // A whole line runs from edge to edge of the square.
    for (const Vec3& end : {line.point.front(), line.point.back()})
      EXPECT_NEAR(std::min({end[0], end[1], 10.0 - end[0], 10.0 - end[1]}), 0.0, 1e-12);
  }
  EXPECT_EQ(levels, (std::multiset<double>{-12.0, -8.0, -4.0, 4.0, 8.0, 12.0}));
}

TEST(Isolines, HolesInTheMeasurementStayHoles) {
  std::vector<Vec2> points;
  for (const Vec2& p : square_grid(21))
    if (std::hypot(p[0] - 10.0, p[1] - 10.0) > 4.0) points.push_back(p);
  for (const auto& triangle : triangulate(points, 2.3)) {
    Vec2 middle = {0.0, 0.0};
    for (const int corner : triangle)
      for (std::size_t k = 0; k < 2; ++k) middle[k] += points[corner][k] / 3.0;
    EXPECT_GT(std::hypot(middle[0] - 10.0, middle[1] - 10.0), 3.0);
  }
}

TEST(FieldAt, PlaneFieldIsExactInsideAndNothingOutside) {
  const auto points = square_grid(8);
  std::vector<double> value;
  for (const Vec2& p : points) value.push_back(3.0 * p[0] - p[1]);
  const FieldAt at(points, 1.0);
  EXPECT_NEAR(at({3.3, 4.7}, value), 3.0 * 3.3 - 4.7, 1e-12);
  EXPECT_TRUE(std::isnan(at({9.5, 4.0}, value)));
}

class SettingsFile : public testing::Test {
protected:
  std::string complaints(const std::string& text, const std::vector<std::string>& overrides = {}) {
    test::write_text(text, file());
    try {
      (void)read_settings(file(), overrides);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  [[nodiscard]] std::string file() const { return (folder_.path() / "dic.toml").string(); }

private:
  test::TemporaryFolder folder_;
};

TEST_F(SettingsFile, MistakesHaveTheirPlaceAndTheNearestName) {
  const std::string told = complaints(
      "[instrument]\nfacet_sise = 3\nwindow = 4\n\n[registration]\nmethod = \"marks\"\n\n[measurement]\nx = \"a\"\n\n"
      "[[line]]\nname = \"l\"\nfrom = [1, 1]\nto = [1, 1]\n\n[camera]\n");
  for (const char* words :
       {"dic.toml:2:1: unknown key 'facet_sise' in [instrument]; did you mean 'facet_size'?",
        "dic.toml:3:10: 'window' is 4", "'marks' has 0 measured", "dic.toml:9:5: 'x' is only used with format",
        "are the same point", "unknown table 'camera'"})
    EXPECT_NE(told.find(words), std::string::npos) << words << "\n" << told;
}

TEST_F(SettingsFile, OverridesReplaceValuesAndComplainByName) {
  test::write_text("[instrument]\nfacet_size = 3\n", file());
  const Settings settings = read_settings(file(), {"instrument.facet_size=4.5", "measurement.y_axis=up"});
  EXPECT_EQ(settings.instrument.facet_size.value(), 4.5);
  EXPECT_EQ(settings.measurement.y_axis, dic::YAxis::up);
  EXPECT_NE(complaints("", {"instrument.facet=4"}).find("--set instrument.facet: unknown key"), std::string::npos);
  EXPECT_NE(complaints("", {"instrment.facet=4"}).find("did you mean 'instrument'"), std::string::npos);
  EXPECT_NE(complaints("", {"facet"}).find("must be TABLE.KEY=VALUE"), std::string::npos);
}

TEST_F(SettingsFile, ColumnsNeedTheirMap) {
  EXPECT_NE(complaints("[measurement]\nformat = \"columns\"\nx = \"a\"\ny = \"b\"\nu = \"c\"\n").find("needs 'v'"),
            std::string::npos);
}

TEST(SettingsReference, IsTheOneTheProgramPrints) {
  EXPECT_EQ(test::read_text(std::filesystem::path(WEAVEFORM_SOURCE_DIR) / "docs" / "dic_settings.md"),
            settings_reference_markdown())
      << "docs/dic_settings.md is generated: weaveform post compare --keys > docs/dic_settings.md";
}

}  // namespace
