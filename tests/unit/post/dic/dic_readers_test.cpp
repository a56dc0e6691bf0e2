// Readers of measured point fields: the programs' own samples, and every trap of their conventions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "core/error.hpp"
#include "post/dic/readers/measurement.hpp"
#include "tests/unit/post/dic/dic_reader.hpp"

namespace {

using namespace weaveform;
using namespace weaveform::dic;
using test::says;
using test::write_text;

TEST_F(DicReader, AramisSampleGivesPositionsStageAndMachine) {
  const MeasuredStage stage = sample("aramis_sample.txt", spec);
  EXPECT_EQ(stage.size(), 8U);
  EXPECT_EQ(stage.label, "aramis_sample.txt (Stufe 52)");
  EXPECT_DOUBLE_EQ(stage.reference[0][0], -80.0564567626);
  EXPECT_DOUBLE_EQ(stage.reference[0][1], 84.9779203814);
  EXPECT_DOUBLE_EQ(stage.displacement_field[7][2], -0.158266425132751);
  // Of the two signals of each kind, the header's value elements; the analog inputs only when named.
  EXPECT_DOUBLE_EQ(stage.displacement.value(), -9.17953395844);
  EXPECT_DOUBLE_EQ(stage.force.value(), 14985.6119156);
  EXPECT_EQ(stage.header_facet, 19.0);
  EXPECT_EQ(stage.header_step, 15.0);
  EXPECT_TRUE(noted(stage, "strain columns not used: epsx [%]"));
}

TEST_F(DicReader, AramisSignalsCanBeNamedTurnedAndShifted) {
  spec.displacement_signal = "Verschiebung";
  spec.displacement_factor = -1.0;
  spec.displacement_offset = 0.5;
  spec.force_signal = "Kraft";
  spec.force_factor = 1e-3;
  const MeasuredStage stage = sample("aramis_sample.txt", spec);
  EXPECT_DOUBLE_EQ(stage.displacement.value(), 7.6751708984375 + 0.5);
  EXPECT_DOUBLE_EQ(stage.force.value(), 15.1025390625);
  spec.force_signal = "Krft";
  try {
    (void)sample("aramis_sample.txt", spec);
    FAIL() << "an unknown signal was taken";
  } catch (const InputError& error) {
    EXPECT_TRUE(says(error.what(), "did you mean 'Kraft'")) << error.what();
  }
}

// Semicolons with decimal commas; a missing displacement keeps its place, a missing position does not.
TEST_F(DicReader, AramisDecimalCommasAndMissingPoints) {
  const MeasuredStage stage = read(
      "# ID; x_undef [mm]; y_undef [mm]; z_undef [mm]; u [mm]; v [mm]; w [mm]; epsx [%]\n"
      "1; 0,5; 1,5; 0; 0,25; 0; 0; 12,5\n2; 1,5; 1,5; 0; ; ; ; \n3; 2,5; 1,5; 0; NaN; 0; 0; 1\n4; ; ; ; 1,0; 0; 0; 1\n"
      "5; 0,5; 2,5; 0; 1; 2; 0; 0\n6; 1,5; 2,5; 0; 1; 2; 0; 0\n7; 2,5; 2,5; 0; 1e-1; 2; 0; 0\n");
  EXPECT_EQ(stage.size(), 6U);
  EXPECT_EQ(stage.missing, 3);
  EXPECT_EQ(good(stage), 4);
  EXPECT_EQ(stage.displacement_field[0][0], 0.25);
  EXPECT_FALSE(stage.displacement.has_value());
}

// Strains in % beside a shear in 1 must not change anything: the same file with other strains reads the same.
TEST_F(DicReader, StrainColumnsAreNotLookedAt) {
  const auto text = [](const std::string& strains) {
    std::string rows = "# ID; x_undef [mm]; y_undef [mm]; u [mm]; v [mm]; epsx [%]; epsxy [1]\n";
    for (int i = 0; i < 6; ++i)
      rows +=
          std::to_string(i) + ";" + std::to_string(i % 3) + ";" + std::to_string(i / 3) + ";0.1;0.2;" + strains + "\n";
    return rows;
  };
  const MeasuredStage one = read(text("1.5;0.02")), other = read(text("words;"));
  EXPECT_EQ(one.reference, other.reference);
  EXPECT_EQ(one.displacement_field, other.displacement_field);
  EXPECT_EQ(one.valid, other.valid);
}

TEST_F(DicReader, AramisInMetresAndInches) {
  const auto text = [](const std::string& unit) {
    return "# ID; x_undef [" + unit + "]; y_undef [" + unit + "]; u [" + unit + "]; v [" + unit + "]\n" +
           "1;0;0;0.5;0\n2;1;0;0.5;0\n3;0;1;0.5;0\n4;1;1;0.5;0\n";
  };
  EXPECT_DOUBLE_EQ(read(text("m")).displacement_field[0][0], 500.0);
  EXPECT_DOUBLE_EQ(read(text("in")).reference[3][1], 25.4);
  EXPECT_DOUBLE_EQ(read(text("\xB5m")).reference[3][1], 1e-3);  // Latin-1
  EXPECT_TRUE(says(refusal("# ID;x_undef;y_undef;u;v\n1;0;0;0;0\n"), "is it in mm, m, um, in or pixels?"));
  EXPECT_TRUE(says(refusal("# ID;x_undef [mm];y_undef [mm];u [m];v [m]\n1;0;0;0;0\n"), "differ in their unit"));
  spec.length_unit = dic::MeasuredUnit::mm;
  EXPECT_TRUE(says(refusal(text("in")), "which is right?"));
}

TEST_F(DicReader, DicePixelsNeedTheirSizeAndTurnUp) {
  EXPECT_TRUE(says(
      [&] {
        try {
          (void)sample("dice_full_field.txt", spec);
        } catch (const InputError& error) {
          return std::string(error.what());
        }
        return std::string();
      }(),
      "how many mm is one pixel? set pixel_size"));
  spec.pixel_size = 0.05;
  const MeasuredStage stage = sample("dice_full_field.txt", spec);
  EXPECT_EQ(stage.size(), 40U);
  EXPECT_DOUBLE_EQ(stage.reference[0][0], 46.0 * 0.05);
  EXPECT_DOUBLE_EQ(stage.reference[0][1], -366.0 * 0.05);
  EXPECT_DOUBLE_EQ(stage.displacement_field[0][1], 0.69080 * 0.05);
  EXPECT_EQ(stage.header_facet, 27.0);
  EXPECT_EQ(stage.header_step, 10.0);
  EXPECT_EQ(stage.window.value(), 5);  // 50 px at 10 px of step: -20, -10, 0, 10, 20 and the ends at 25
}

TEST_F(DicReader, DiceWithoutHeaderUsesTheMatchFlag) {
  spec.pixel_size = 1.0;
  const MeasuredStage stage = sample("dice_dogbone.txt", spec);
  EXPECT_EQ(stage.failed, 4);
  EXPECT_EQ(good(stage), static_cast<long>(stage.size()) - 4);
}

// Stereo: MODEL_ columns in a unit the file does not name; the senses of y follow from the image's.
TEST_F(DicReader, DiceStereoAsksForTheUnitAndFindsUp) {
  EXPECT_THROW((void)sample("dice_stereo_3d.txt", spec), InputError);
  spec.length_unit = dic::MeasuredUnit::mm;
  const MeasuredStage stage = sample("dice_stereo_3d.txt", spec);
  EXPECT_EQ(stage.size(), 60U);
  EXPECT_DOUBLE_EQ(stage.reference[0][1], -2.1956);
  EXPECT_DOUBLE_EQ(stage.displacement_field[0][1], -0.025451);
  EXPECT_DOUBLE_EQ(stage.displacement_field[0][2], -0.035206);
  EXPECT_TRUE(noted(stage, "told by COORDINATE_Y"));
}

constexpr const char* dice_rows =
    "COORDINATE_X@COORDINATE_Y@DISPLACEMENT_X@DISPLACEMENT_Y@SIGMA@STATUS_FLAG@MATCH\n"
    "0@0@1@1@0.01@4@0\n10@0@1@1@0.01@4@0\n20@0@1@1@0.01@4@0\n0@10@1@1@0.01@4@0\n10@10@99@99@-1@4@0\n"
    "20@10@99@99@0.01@8@0\n0@20@99@99@0.01@4@-1\n10@20@1@1@0.01@3@0\n";

// The delimiter is the user's: any character can stand there; each of the three flags marks failures.
TEST_F(DicReader, DiceDelimitersAndFlags) {
  spec.pixel_size = 1.0;
  for (const char delimiter : {',', ';', '\t', ' ', '|', ':'}) {
    std::string text = dice_rows;
    std::replace(text.begin(), text.end(), '@', delimiter);
    spec.delimiter = delimiter == '|' || delimiter == ':' ? std::string(1, delimiter) : "auto";
    const MeasuredStage stage = read(text);
    EXPECT_EQ(stage.size(), 8U) << "'" << delimiter << "'";
    EXPECT_EQ(stage.failed, 3) << "'" << delimiter << "'";
    for (std::size_t i = 0; i < stage.size(); ++i)
      EXPECT_EQ(stage.valid[i], stage.displacement_field[i][0] == 1.0) << "'" << delimiter << "' " << i;
  }
}

TEST_F(DicReader, Vic3dQuotedHeadingBelowATitle) {
  const std::string text =
      "\"Test 4\"\n\"Index [1]\";\"X [mm]\";\"Y [mm]\";\"Z [mm]\";\"U [mm]\";\"V [mm]\";\"W [mm]\";\"sigma [pixel]\"\n"
      "0;1,0;2,0;0,5;0,1;0,2;0,3;0,01\n1;2,0;2,0;0,5;0,1;0,2;0,3;0,01\n2;1,0;3,0;0,5;0,1;0,2;0,3;0,01\n"
      "3;2,0;3,0;0,5;0,1;0,2;0,3;0,01\n4;0;0;0;0;0;0;-1\n";
  EXPECT_TRUE(says(refusal(text), "does Y point up or down on the specimen?"));
  spec.y_axis = dic::YAxis::up;
  const MeasuredStage stage = read(text);
  EXPECT_EQ(stage.size(), 4U);  // the failed point's zeros are no position
  EXPECT_EQ(stage.failed, 1);
  EXPECT_EQ(stage.displacement_field[0], (Vec3{0.1, 0.2, 0.3}));
  spec.y_axis = dic::YAxis::down;
  EXPECT_EQ(read(text).displacement_field[0], (Vec3{0.1, -0.2, -0.3}));
}

TEST_F(DicReader, VicPixelColumnTellsWhereUpIs) {
  const auto text = [](int sense) {
    std::string rows = "x,y,X [mm],Y [mm],Z [mm],U [mm],V [mm],W [mm],sigma\n";
    for (int i = 0; i < 9; ++i)
      rows += std::to_string(100 * (i % 3)) + "," + std::to_string(100 * (i / 3)) + "," + std::to_string(i % 3) + "," +
              std::to_string(sense * (i / 3)) + ",0,0.5,0.25,0,0.01\n";
    return rows;
  };
  EXPECT_EQ(read(text(-1)).displacement_field[0][1], 0.25);
  EXPECT_EQ(read(text(+1)).displacement_field[0][1], -0.25);
}

TEST_F(DicReader, Vic2dPixelsAreTheImages) {
  const std::string text =
      "\"x\",\"y\",\"sigma\",\"u\",\"v\",\"exx\"\n0,0,0.01,1,2,9\n7,0,0.01,1,2,9\n0,7,0.01,1,2,9\n7,7,0.01,1,2,9\n7,14,"
      "-1,0,0,0\n";
  EXPECT_TRUE(says(refusal(text), "set pixel_size"));
  spec.pixel_size = 0.5;
  const MeasuredStage stage = read(text);
  EXPECT_EQ(stage.reference[3], (Vec3{3.5, -3.5, 0.0}));
  EXPECT_EQ(stage.displacement_field[0], (Vec3{0.5, -1.0, 0.0}));
  EXPECT_EQ(stage.failed, 1);
}

TEST_F(DicReader, PyvaleDisplacementsAndGradients) {
  spec.pixel_size = 0.1;
  const MeasuredStage subsets = read(
      "subset_x,subset_y,displacement_u,displacement_v,displacement_mag,converged,cost\n"
      "10,20,1,2,2.2,1,0\n20,20,1,2,2.2,1,0\n10,30,1,2,2.2,1,0\n20,30,1,2,2.2,1,0\n30,30,90,2,90,0,0\n");
  EXPECT_EQ(subsets.failed, 1);
  EXPECT_EQ(subsets.reference[0], (Vec3{1.0, -2.0, 0.0}));
  EXPECT_EQ(subsets.displacement_field[0], (Vec3{0.1, -0.2, 0.0}));
  // y down to y up changes the sign of what couples x and y.
  std::string rows = "window_x,window_y,def_grad_00,def_grad_01,def_grad_10,def_grad_11,eps_00,eps_01,eps_10,eps_11\n";
  for (const char* place : {"0,0", "10,0", "0,10", "10,10"}) rows += std::string(place) + ",1.1,0.2,0.3,0.9,7,7,7,7\n";
  const MeasuredStage windows = read(rows);
  EXPECT_EQ(windows.gradient[0], (std::array<double, 4>{1.1, -0.2, -0.3, 0.9}));
  EXPECT_EQ(good(windows), 4);
}

// x, y in pixels, displacements of F = diag(0.98, 1.02) about the middle of n x n points.
struct Field {
  int n = 10;
  double step = 20.0, scale = 1.0, up = -1.0;  // px; mm/px; sense of y against the pixels'
  [[nodiscard]] double x(int i) const { return scale * step * (i - 0.5 * (n - 1)); }
  [[nodiscard]] double y(int j) const { return -up * scale * step * (j - 0.5 * (n - 1)); }
};

std::string stereo_table(const Field& field, int failed = 0) {
  std::string text =
      "x,y,u,v,w,r1r2 ZNCC,r1t1 ZNCC,r1t2 ZNCC,r2_x,r2_y,t1_x,t1_y,t2_x,t2_y,ref_x,ref_y,ref_z,tar_x,tar_y,tar_z,exx,"
      "eyy,ezz,exy,eyz,ezx,subset_rx,subset_ry,\n";
  for (int j = 0; j < field.n; ++j)
    for (int i = 0; i < field.n; ++i) {
      const double x = field.x(i), y = field.y(j);
      const bool bad = j * field.n + i < failed;
      text += fmt::format("{},{},{},{},0.5,0.99,{},0.99,1,1,1,1,1,1,{},{},400,0,0,0,9,9,9,9,9,9,16,16,\n",
                          200 + field.step * i, 200 + field.step * j, bad ? 0.0 : -0.02 * x, bad ? 0.0 : 0.02 * y,
                          bad ? (i % 2 == 0 ? -4 : 0) : 1, x, y);
    }
  return text;
}

TEST_F(DicReader, OpenCorrStereoIsInTheUnitOfItsCalibration) {
  const Field field{.scale = 0.05};
  EXPECT_TRUE(says(refusal(stereo_table(field)), "--set measurement.length_unit=mm"));
  spec.pixel_size = 0.05;  // is of no use here
  EXPECT_TRUE(says(refusal(stereo_table(field)), "column 'ref_x' has no unit"));
  spec.length_unit = dic::MeasuredUnit::px;
  EXPECT_TRUE(says(refusal(stereo_table(field)), "are lengths"));
  spec.length_unit = dic::MeasuredUnit::mm;
  for (const double up : {-1.0, 1.0}) {
    const Field turned{.scale = 0.05, .up = up};
    const MeasuredStage stage = read(stereo_table(turned, 4));
    EXPECT_EQ(stage.failed, 4) << "two codes below zero, two that were never computed";
    EXPECT_TRUE(noted(stage, "failed correlations by: r1r2 ZNCC, r1t1 ZNCC, r1t2 ZNCC"));
    // whatever the sense of the calibration's y, F is diag(0.98, 1.02) with y up and the first row on top
    EXPECT_DOUBLE_EQ(stage.reference[99][0], 4.5);
    EXPECT_DOUBLE_EQ(stage.reference[99][1], -4.5);
    EXPECT_DOUBLE_EQ(stage.displacement_field[99][0], -0.02 * 4.5);
    EXPECT_DOUBLE_EQ(stage.displacement_field[99][1], 0.02 * -4.5);
  }
  spec.length_unit = dic::MeasuredUnit::m;
  EXPECT_DOUBLE_EQ(read(stereo_table(field)).reference[99][0], 4500.0);
}

TEST_F(DicReader, OpenCorrTablesWithoutPlacesAreRefused) {
  const std::string rows = "1,1,-38,-86,398,0.9,0,0,1,1,0,0,0,0,\n";
  EXPECT_TRUE(says(refusal("x,y,u,v,w,r1r2 ZNCC,r1t1 ZNCC,r1t2 ZNCC,r2_x,r2_y,t1_x,t1_y,t2_x,t2_y,\n" + rows + rows),
                   "without ref_x, ref_y, ref_z"));
}

TEST_F(DicReader, OpenCorrPlanarCountsFailuresByZncc) {
  spec.pixel_size = 0.05;
  for (const char* heading : {"x,y,u,v,u0,v0,ZNCC,iteration,convergence,feature,exx,eyy,exy,subset_rx,subset_ry,",
                              "x,y,u,v,u0,v0,zncc,iteration,convergence,feature,exx,eyy,exy,subset_rx,subset_ry,"}) {
    std::string text = fmt::format("{}\n", heading);
    for (int k = 0; k < 25; ++k)
      text += fmt::format("{},{},{},2,0,0,{},3,0.001,9,0,0,0,16,16,\n", 10 * (k % 5), 10 * (k / 5), k < 4 ? 90 : 1,
                          k < 4 ? -4 : 0.98);
    const MeasuredStage stage = read(text);
    EXPECT_EQ(stage.failed, 4) << heading;
    EXPECT_EQ(good(stage), 21) << heading;
    EXPECT_EQ(stage.displacement_field[24], (Vec3{0.05, -0.1, 0.0})) << heading;
    EXPECT_TRUE(noted(stage, "OpenCorr: planar"));
  }
}

// The same columns with a third axis are a volume's, with units a user's own: neither is read as pixels.
TEST_F(DicReader, TablesLikeOpenCorrsAreNotTakenForPixels) {
  spec.pixel_size = 0.05;
  EXPECT_TRUE(says(refusal("x,y,z,u,v,w,ZNCC\n0,0,0,1,2,3,0.9\n1,0,0,1,2,3,0.9\n0,1,0,1,2,3,0.9\n1,1,0,1,2,3,0.9\n"),
                   "which program wrote this?"));
  const std::string lengths =
      "x [mm],y [mm],u [mm],v [mm],ZNCC\n0,0,1,2,0.9\n1,0,1,2,0.9\n0,1,1,2,0.9\n1,1,1,2,-1\n0,2,1,2,0.9\n";
  EXPECT_TRUE(says(refusal(lengths), "point up or down on the specimen?"));
  spec.y_axis = dic::YAxis::up;
  const MeasuredStage stage = read(lengths);
  EXPECT_EQ(stage.displacement_field[0], (Vec3{1.0, 2.0, 0.0}));
  EXPECT_EQ(stage.failed, 1);
}

TEST_F(DicReader, MatchidTablesTellTheSenseOfYByTheirPixels) {
  std::string text =
      "Coordinates.Image X [Pixel],Coordinates.Image Y [Pixel],coor.X [mm],coor.Y [mm],coor.Z [mm],disp.Horizontal "
      "Displacement U [mm],disp.Vertical Displacement V [mm],disp.Out-Of-Plane: W [mm],strain.Strain-global frame: Exx "
      "[ "
      "]\n";
  for (int k = 0; k < 25; ++k)
    text += fmt::format("{},{},{},{},0,0.1,0.2,{},7\n", 10 * (k % 5), 10 * (k / 5), k % 5, k / 5,
                        k == 3 ? "Non un numero reale" : "0.3");
  const MeasuredStage stage = read(text);
  EXPECT_EQ(stage.reference[6], (Vec3{1.0, -1.0, 0.0}));
  EXPECT_EQ(stage.displacement_field[6], (Vec3{0.1, -0.2, -0.3}));
  EXPECT_EQ(good(stage), 24);
  spec.pixel_size = 0.5;
  std::string pixels = "x_pic;y_pic;u;v\n";
  for (int k = 0; k < 9; ++k) pixels += fmt::format("{};{};0,5;1,5\n", 10 * (k % 3), 10 * (k / 3));
  EXPECT_EQ(read(pixels).displacement_field[4], (Vec3{0.25, -0.75, 0.0}));
}

TEST_F(DicReader, TypographicQuotesAndUtf16AreRead) {
  const std::string rows = "\"x\";\"y\";\"u\";\"v\";\"sigma\"\n0;0;1;2;0,1\n7;0;1;2;0,1\n0;7;1;2;0,1\n7;7;1;2;0,1\n";
  spec.pixel_size = 0.5;
  const MeasuredStage plain = read(rows);
  std::string curly, wide("\xFF\xFE");
  bool opens = true;
  for (const char c : rows) {
    wide.push_back(c);
    wide.push_back('\0');
    if (c != '"') {
      curly.push_back(c);
      continue;
    }
    curly.append(opens ? "\xE2\x80\x9C" : "\xE2\x80\x9D");
    opens = !opens;
  }
  for (const auto& text : {curly, wide}) {
    const MeasuredStage stage = read(text);
    EXPECT_EQ(stage.reference, plain.reference);
    EXPECT_EQ(stage.displacement_field, plain.displacement_field);
  }
}

// x, y, u and v without units are the columns of many programs: one that VIC does not write is asked about.
TEST_F(DicReader, UnknownColumnsBesideXyuvAreAskedAbout) {
  const auto rows = [](const std::string& heading, const std::string& cells) {
    std::string text = fmt::format("{}\n", heading);
    for (const char* place : {"0,0", "7,0", "0,7", "7,7"}) text += fmt::format("{},1,2,{}\n", place, cells);
    return text;
  };
  spec.pixel_size = 0.5;
  for (const char* heading : {"x,y,u,v,w", "x,y,u,v,corrcoef", "x,y,u,v,depth"}) {
    const std::string text = refusal(rows(heading, "0.5"));
    EXPECT_TRUE(says(text, "which program wrote this?")) << heading << text;
    EXPECT_TRUE(says(text, "its columns are 'x', 'y', 'u', 'v'")) << text;
    for (const char* key : {"format=columns", "x=NAME_OF_x", "v=NAME_OF_v", "y_axis=", "length_unit="})
      EXPECT_TRUE(says(text, fmt::format("--set measurement.{}", key))) << key;
  }
  EXPECT_EQ(good(read(rows("x,y,u,v,exx", "0.5"))), 4);
  spec.format = dic::MeasurementFormat::vic;
  EXPECT_EQ(good(read(rows("x,y,u,v,depth", "0.5"))), 4);
  spec.format = dic::MeasurementFormat::automatic;
  spec.pixel_size.reset();
  const std::string bare = refusal("x,y,u,v\n0,0,1,2\n7,0,1,2\n0,7,1,2\n7,7,1,2\n");
  EXPECT_TRUE(says(bare, "is it in mm, m, um, in or pixels?")) << bare;
}

TEST_F(DicReader, PyvaleGradientsWithoutAllComponentsAreAnUnknownTable) {
  const std::string text =
      refusal("window_x,window_y,def_grad_00,def_grad_01,other,def_grad_11\n0,0,1,0,0,1\n1,0,1,0,0,1\n");
  EXPECT_TRUE(says(text, "which program wrote this?")) << text;
}

TEST_F(DicReader, AnyTableThroughAMap) {
  spec.format = dic::MeasurementFormat::columns;
  spec.x = "pos x";
  spec.y = "pos y";
  spec.u = "dx";
  spec.v = "dy";
  spec.quality = "corr";
  spec.quality_least = 0.8;
  spec.stage_column = "step";
  const std::string text =
      "corr;pos x [cm];pos y [cm];dx [cm];dy "
      "[cm];step\n0.9;1;1;0.1;0;1\n0.9;2;1;0.1;0;1\n0.9;1;2;0.1;0;1\n0.9;2;2;0.1;0;1\n"
      "0.9;1;1;0.2;0;2\n0.9;2;1;0.2;0;2\n0.9;1;2;0.2;0;2\n0.9;2;2;0.2;0;2\n0.1;3;3;5;5;2\n";
  write_text(text, folder_.path() / "any.csv");
  EXPECT_THROW((void)read_stages(folder_.path() / "any.csv", spec), InputError);  // up or down?
  spec.y_axis = dic::YAxis::up;
  const auto stages = read_stages(folder_.path() / "any.csv", spec);
  ASSERT_EQ(stages.size(), 2U);
  EXPECT_DOUBLE_EQ(stages[1].displacement_field[0][0], 2.0);
  EXPECT_EQ(stages[1].failed, 1);
  EXPECT_EQ(stages[0].failed, 0);
  spec.position = dic::PositionOf::current;
  EXPECT_DOUBLE_EQ(read_stages(folder_.path() / "any.csv", spec)[1].reference[0][0], 8.0);  // 10 - 2 mm
  spec.x = "pos_x";
  EXPECT_THROW((void)read_stages(folder_.path() / "any.csv", spec), InputError);
}

TEST_F(DicReader, ColumnsByNumberNeedNoHeading) {
  spec.format = dic::MeasurementFormat::columns;
  spec.x = "2";
  spec.y = "3";
  spec.u = "4";
  spec.v = "5";
  spec.y_axis = dic::YAxis::up;
  spec.length_unit = dic::MeasuredUnit::mm;
  const MeasuredStage stage = read("1 0 0 0.5 0\n2 1 0 0.5 0\n3 0 1 0.5 0\n4 1 1 0.5 0\n");
  EXPECT_EQ(stage.size(), 4U);
  EXPECT_EQ(stage.displacement_field[3][0], 0.5);
}

TEST_F(DicReader, RefusesWhatCannotBeDecided) {
  EXPECT_TRUE(says(refusal("a,b,c\n1,2,3\n"), "which program wrote this?"));
  // Decimal commas between commas.
  EXPECT_TRUE(
      says(refusal("x_undef [mm],y_undef [mm],u [mm],v [mm]\n1,0,2,0,0,1,0,1\n"), "decimal commas between commas?"));
  // Both signs in one file.
  EXPECT_TRUE(
      says(refusal("x_undef [mm];y_undef [mm];u [mm];v [mm]\n1,5;0;0;0\n1.5;0;0;0\n"), "which is the decimal sign?"));
  // A row cut off, with its line.
  EXPECT_TRUE(says(refusal("x_undef [mm];y_undef [mm];u [mm];v [mm]\n1;0;0;0\n1;0\n"), "stage.csv:3:"));
  EXPECT_TRUE(says(refusal("x_undef [mm];y_undef [mm];u [mm];v [mm]\n1;0;a lot;0\n"), "'a lot' is not a number"));
  EXPECT_TRUE(says(refusal(std::string("x\0y", 3)), "not plain text"));
  EXPECT_TRUE(
      says(refusal("window_x,window_y,x_mm,y_mm,z_mm,def_grad_00,def_grad_01,def_grad_10,def_grad_11,def_grad_20\n"
                   "1,1,1,1,1,1,0,0,1,0\n"),
           "compare pyvale's displacement file"));
}

// Damaged files are read or refused with a reason; nothing else comes out of a reader.
TEST_F(DicReader, DamagedFilesAreReadOrRefused) {
  spec.pixel_size = 0.1;
  spec.length_unit = dic::MeasuredUnit::automatic;
  int refused = 0;
  for (const char* name : {"aramis_sample.txt", "dice_full_field.txt", "dice_dogbone.txt"}) {
    const std::string whole = test::read_text(std::string(WEAVEFORM_SOURCE_DIR) + "/tests/data/dic/" + name);
    std::mt19937 random(5);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    for (int k = 0; k < 150; ++k) {
      std::string text = whole;
      for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
        const std::size_t at = below(text.size());
        switch (below(3)) {
          case 0:
            text[at] = ";,.\n|# -eE019\xFF\""[below(15)];
            break;
          case 1:
            text.erase(at, 1 + below(300));
            break;
          default:
            text.insert(at, text.substr(at, 1 + below(100)));
        }
        if (text.empty()) text = "x";
      }
      write_text(text, folder_.path() / "damaged.txt");
      try {
        for (const MeasuredStage& stage : read_stages(folder_.path() / "damaged.txt", spec)) {
          ASSERT_EQ(stage.valid.size(), stage.reference.size());
          for (std::size_t i = 0; i < stage.size(); ++i)
            if (stage.valid[i]) {
              ASSERT_TRUE(std::isfinite(stage.reference[i][0] + stage.displacement_field[i][1]));
            }
        }
      } catch (const InputError& error) {
        ++refused;
        EXPECT_TRUE(says(error.what(), "damaged.txt")) << error.what();
      }
    }
  }
  EXPECT_GT(refused, 20);
}

TEST_F(DicReader, FoldersAreReadInTheOrderOfTheirNumbers) {
  for (const char* name : {"s_10.txt", "s_2.txt", "s_1.csv", "note.md"}) write_text("x", folder_.path() / name);
  const auto files = measurement_files({folder_.path().string()});
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files[0].filename(), "s_1.csv");
  EXPECT_EQ(files[1].filename(), "s_2.txt");
  EXPECT_EQ(files[2].filename(), "s_10.txt");
  EXPECT_THROW((void)measurement_files({"nowhere"}), FileError);
}

}  // namespace
