// Linked into the unit tests of the build with sanitizers: what divides by zero, overflows or has no value stops the test
// there. Not in the tests named below, each of which was seen to stop for the reason given.
#include <gtest/gtest.h>

#include <cfenv>
#include <regex>
#include <string>

namespace {

// What is not a number is the matter there, and every comparison with it is a trap: a gap of a chart, a corner that is no
// place, points off the mesh, failed correlations, an ideal past its end, words that are no number.
constexpr const char* of_no_value =
    "Chart.ErrorBarsReachFromLowToHigh|Stl.CornersThatAreNoPlaceAreRefusedByFacet|"
    "OnTheMesh.SamplingCoversTheBlankAndKeepsLinearFields|"
    "DicReader.(DiceWithoutHeaderUsesTheMatchFlag|DiceStereoAsksForTheUnitAndFindsUp|DiceDelimitersAndFlags|"
    "DamagedFilesAreReadOrRefused)|BiasExtension.PastNinetyDegreesThereIsNoIdeal|"
    "Summary.TableMarksAnIdealPastNinetyDegreesAsNone|Border.ConditionsAreAllToBeMet|Accuracy.IsPercentOrAFraction";
// Inside VTK (ranges of arrays, cell data to point data) and Gmsh.
constexpr const char* of_libraries =
    "VtuGrid.WhatFitsTheFormatAndNoMeshIsNamed|StrangersCad.(MeshOptionsOfAScriptChangeNoGeometry|"
    "FacesOfGmshsOwnKernelComeWithinTheToleranceWithAnyMeshOptions)|PostProcess.(IdealRunMeetsTheIdealInEveryZone|"
    "ContoursLieBetweenTheZonesAtMultiplesOfTheStep|RunAgainGivesTheSameFiles)";
// A yarn of no length, whose strain is minus infinity.
constexpr const char* of_no_length = "Frames.EveryArrayIsThereAndHoldsNumbersOnly";

class FloatingPointTraps : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo& test) override {
    static const std::regex exempt(std::string(of_no_value) + "|" + of_libraries + "|" + of_no_length);
    std::feclearexcept(FE_ALL_EXCEPT);
    const std::string name = std::string(test.test_suite_name()) + "." + test.name();
    if (!std::regex_match(name, exempt)) feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
  }
  void OnTestEnd(const testing::TestInfo& /*test*/) override { fedisableexcept(FE_ALL_EXCEPT); }
};

[[maybe_unused]] const bool is_listening = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new FloatingPointTraps);
  return true;
}();

}  // namespace
