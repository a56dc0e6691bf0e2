// Tables of slip and of compaction between plies: as measured, and what is said of those that are none.
#include "mesher/resolve/stack_laws.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace weaveform {
namespace {

using Table = std::vector<std::array<double, 2>>;

std::string complaint(Table (*read)(const std::string&, const std::string&), const std::string& text) {
  try {
    (void)read(text, "law.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(StackLaws, ASlipLawIsReadWithOrWithoutHeading) {
  const Table law = {{0.0, 0.01}, {0.5, 0.02}};
  EXPECT_EQ(read_shear_law("0,0.01\n0.5,0.02\n", "law.csv"), law);
  EXPECT_EQ(read_shear_law("# measured\nslip_mm,tau_MPa\n0,0.01\n0.5,0.02\n", "law.csv"), law);
}

TEST(StackLaws, AThicknessUnderPressureIsAnApproach) {
  const Table by_thickness = read_compaction("thickness_mm,pressure_MPa\n0.5,0\n0.4,0.1\n0.375,0.4\n", "law.csv");
  ASSERT_EQ(by_thickness.size(), 3U);
  EXPECT_DOUBLE_EQ(by_thickness[2][0], 0.125);
  EXPECT_EQ(by_thickness[2][1], 0.4);
  EXPECT_EQ(read_compaction("approach_mm,pressure_MPa\n0,0\n0.1,0.1\n", "law.csv"), (Table{{0.0, 0.0}, {0.1, 0.1}}));
}

TEST(StackLaws, WhatIsNoLawIsRefusedWithItsPlace) {
  EXPECT_EQ(complaint(read_shear_law, "0,0.01\n0.5,0.02\n0.4,0.03\n"),
            "law.csv:3: the slip is 0.4 after 0.5; it must rise from row to row");
  EXPECT_EQ(complaint(read_shear_law, "0,0.01\n0.5,-0.02\n"),
            "law.csv:2: the shear stress is -0.02 MPa; it must be 0 or more");
  EXPECT_EQ(complaint(read_shear_law, "0,0.01\n0.5,x\n"),
            "law.csv:2:5: 'x' is no number; each row is slip (mm), shear stress (MPa)");
  EXPECT_EQ(complaint(read_shear_law, "0,0.01,3\n"), "law.csv:1: 3 numbers; each row is slip (mm), shear stress (MPa)");
  EXPECT_EQ(complaint(read_shear_law, "0,0.01\n"), "law.csv: has fewer than two rows of slip (mm), shear stress (MPa)");
  EXPECT_EQ(
      complaint(read_compaction, "0,0\n0.1,0.1\n"),
      "law.csv: its first line must be approach_mm,pressure_MPa or thickness_mm,pressure_MPa, and say which it is");
  EXPECT_EQ(complaint(read_compaction, "thickness_mm,pressure_MPa\n0.4,0\n0.5,1\n"),
            "law.csv:3: the thickness lost is -0.1 after 0; it must rise from row to row");
}

}  // namespace
}  // namespace weaveform
