#include "core/findings.hpp"

#include <gtest/gtest.h>

namespace weaveform {
namespace {

void complain(Findings& found) {
  EXPECT_FALSE(found.attempt([] { throw FileError("a.stl: no such file"); }));
  EXPECT_FALSE(found.attempt([] { throw InputError(std::vector<std::string>{"one", "two"}); }));
  EXPECT_FALSE(found.attempt([] { throw InputError("two"); }));
  EXPECT_TRUE(found.attempt([] {}));
}

TEST(Findings, HoldEveryComplaintOnce) {
  Findings found;
  complain(found);
  try {
    found.throw_if_any();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.complaints(), (std::vector<std::string>{"a.stl: no such file", "one", "two"}));
  }
}

TEST(Findings, OfMissingFilesAloneAreAFileError) {
  Findings found;
  found.attempt([] { throw FileError("a.stl: no such file"); });
  EXPECT_THROW(found.throw_if_any(), FileError);
}

TEST(Findings, LetTheFirstThroughWhenNoMoreAreWanted) {
  Findings found(Findings::Want::first);
  EXPECT_THROW(found.attempt([] { throw PhysicsError("torn"); }), PhysicsError);
  EXPECT_TRUE(found.empty());
  EXPECT_NO_THROW(found.throw_if_any());
}

}  // namespace
}  // namespace weaveform
