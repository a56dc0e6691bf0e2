// Linked into the unit tests of the build with sanitizers: what divides by zero, overflows or has no value stops the test
// there. Not in the suites named below, for one of two reasons.
#include <gtest/gtest.h>

#include <cfenv>
#include <regex>
#include <string>

namespace {

// Not a number is an answer there: of a chart's gap, an angle past its end, a facet that is no place, a question that no
// point meets, text that is no number.
constexpr const char* of_no_value =
    "Chart|Trellis|VtuGrid|Stl|StrangersCad|OnTheMesh|DicReader|BiasExtension|Summary|PostProcess|Border|Accuracy";
// The inner loops compute both sides of a choice in every lane, and rows are padded with elements of no size
// (cmake/inner_loop.cmake).
constexpr const char* of_the_inner_loops = "Shell|MirrorPlanes|Frames|ContactState|.*/BendingOf|.*/ShellOf";

class FloatingPointTraps : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo& test) override {
    static const std::regex exempt(std::string(of_no_value) + "|" + of_the_inner_loops);
    std::feclearexcept(FE_ALL_EXCEPT);
    if (!std::regex_match(test.test_suite_name(), exempt)) feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
  }
  void OnTestEnd(const testing::TestInfo& /*test*/) override { fedisableexcept(FE_ALL_EXCEPT); }
};

[[maybe_unused]] const bool is_listening = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new FloatingPointTraps);
  return true;
}();

}  // namespace
