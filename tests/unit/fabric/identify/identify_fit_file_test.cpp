// Fit files: complaints with places, what the base card completes, the reference in docs/fit.md.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "core/error.hpp"
#include "fabric/identify/fit_spec.hpp"

namespace weaveform::identify {
namespace {

const std::string test_of_yarn =
    "[[tensile]]\nname = 'y'\nfiles = ['y.csv']\ndisplacement_column = '1'\nforce_column = '2'\ngauge_length = 1000\n";

std::string complaint_of(const std::string& text) {
  try {
    (void)read_fit_text(text, "f.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FitFile, IsCompletedByItsBaseCard) {
  const FitSpec spec =
      read_fit_text("name = 'a'\nbase = 'twintex-tw'\n[yarn.weft]\ncrimp = 1.5\n" + test_of_yarn, "f.toml");
  EXPECT_EQ(spec.thickness(), 1.0);
  EXPECT_EQ(spec.yarn[0].interval, 2.44);
  EXPECT_EQ(spec.yarn[0].crimp, 4.4);
  EXPECT_EQ(spec.yarn[1].crimp, 1.5) << "the fit file wins";
}

TEST(FitFile, ASectionAndEq11ReplaceEachOther) {
  const FitSpec spec = read_fit_text(
      "name = 'a'\nbase = 'twintex-pw'\n[yarn]\nfibre_volume_fraction = 0.35\n"
      "fibre_density = 2.5\nmatrix_density = 0.9\n" +
          test_of_yarn,
      "f.toml");
  EXPECT_FALSE(spec.yarn[0].section.has_value());
}

TEST(FitFile, CompressionLawAndModulusReplaceEachOther) {
  const FitSpec spec = read_fit_text(
      "name = 'a'\nbase = 'twintex-pw'\n[yarn]\ncompression = [{ from = 0, coefficients = [90, 10] }]\n[yarn.weft]\n"
      "compression_modulus = 50\n" +
          test_of_yarn,
      "f.toml");
  EXPECT_FALSE(spec.yarn[0].compression_modulus.has_value());
  EXPECT_EQ(spec.yarn[0].compression.size(), 1U);
  EXPECT_EQ(spec.yarn[1].compression_modulus, 50.0);
  EXPECT_TRUE(spec.yarn[1].compression.empty());
}

TEST(FitFile, ComplainsWithPlaceAndNearestName) {
  EXPECT_NE(complaint_of("nmae = 'a'\nbase = 'twintex-pw'\n" + test_of_yarn)
                .find("f.toml:1:1: unknown key 'nmae' in a fit file; did you mean 'name'?"),
            std::string::npos);
  EXPECT_NE(complaint_of("name = 'a'\nbase = 'twintex-pw'\n" + test_of_yarn + "force_unit = 'kn'\n")
                .find("f.toml:9:14: 'force_unit' is 'kn'"),
            std::string::npos);
  EXPECT_NE(complaint_of("name = 'a'\n" + test_of_yarn).find("lacks 'interval' (mm) and no base card gives it"),
            std::string::npos);
  EXPECT_NE(complaint_of("name = 'a'\nbase = 'twintex-wp'\n" + test_of_yarn).find("did you mean 'twintex-pw'?"),
            std::string::npos);
  EXPECT_NE(complaint_of("name = 'a'\nbase = 'twintex-pw'\n").find("names no test"), std::string::npos);
  EXPECT_NE(
      complaint_of("name = 'a'\nbase = 'twintex-pw'\n" + test_of_yarn + test_of_yarn).find("2 [[tensile]] stand for"),
      std::string::npos);
}

TEST(FitFile, GeometryIsAskedForWithItsUnit) {
  const std::string frame =
      "name = 'a'\nbase = 'twintex-pw'\n[[shear_frame]]\nname = 'f'\nfiles = ['f.csv']\n"
      "displacement_column = '1'\nforce_column = '2'\n";
  EXPECT_NE(complaint_of(frame).find("lacks 'frame_length' or 'fabric_length' (mm)"), std::string::npos);
  EXPECT_NE(complaint_of(frame + "frame_length = 120\nfabric_length = 216\n").find("exchange them?"),
            std::string::npos);
  EXPECT_EQ(complaint_of(frame + "frame_length = 216\nfabric_length = 120\n"), "");
  EXPECT_NE(complaint_of(frame + "frame_length = 216\nfabric_length = 120\nangle_column = '3'\n").find("keep one pair"),
            std::string::npos);
}

TEST(FitFile, WhatCannotBeSimulatedIsRefused) {
  const std::string head = "name = 'a'\nbase = 'twintex-pw'\n";
  const std::string simulated = "[shear]\nmethod = 'simulation'\n";
  const std::string bias =
      "[[bias_extension]]\nname = 'b'\nfiles = ['b.csv']\ndisplacement_column = '1'\nforce_column = '2'\nwidth = 100\n"
      "length = 200\n";
  const std::string angles =
      "[[shear_frame]]\nname = 'f'\nfiles = ['f.csv']\nangle_column = '1'\nnormalised_force_column = '2'\n";
  EXPECT_EQ(complaint_of(head + simulated + bias), "");
  EXPECT_EQ(complaint_of(head + simulated + "[simulation]\nsettings = ['model.yarn_law=linear']\n" + bias), "");
  EXPECT_NE(complaint_of(head + "[simulation]\nrounds = 3\n" + bias).find("does nothing unless"), std::string::npos);
  EXPECT_NE(complaint_of(head + simulated + angles).find("needs its 'frame_length'"), std::string::npos);
  EXPECT_NE(complaint_of(head + simulated + "[simulation]\nsettings = ['blank.size=[1,2]']\n" + bias).find("none of"),
            std::string::npos);
  EXPECT_NE(complaint_of(head + simulated + "[simulation]\ndecrimping = true\n[yarn]\ncrimp = 0\n" + bias)
                .find("needs the 'crimp'"),
            std::string::npos);
  const std::string frame = angles + "frame_length = 200\nfabric_length = 120\n";
  EXPECT_NE(complaint_of(head + simulated + "[simulation]\ndecrimping = true\n" + frame + bias)
                .find("cannot be told from a shear frame"),
            std::string::npos);
}

TEST(FitReference, IsTheOneInTheDocs) {
  std::ifstream stream(WEAVEFORM_SOURCE_DIR "/docs/fit.md");
  const std::string docs{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  EXPECT_NE(docs.find(fit_reference_markdown()), std::string::npos)
      << "the tables at the end of docs/fit.md are generated: weaveform fit --keys";
}

}  // namespace
}  // namespace weaveform::identify
