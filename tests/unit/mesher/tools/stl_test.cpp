// STL surfaces: what is no place in space is refused by facet, and sizes are compared before anything is made of them.
#include "mesher/tools/stl.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "mesher/tools/triangle_report.hpp"
#include "tests/support/mutations.hpp"

namespace weaveform {
namespace {

std::string facet(const std::string& first) {
  return "facet normal 0 0 1\n outer loop\n  vertex " + first +
         "\n  vertex 10 0 0\n  vertex 0 10 0\n endloop\nendfacet\n";
}

std::string binary(const std::vector<std::array<float, 9>>& facets, std::uint32_t announced) {
  std::string bytes(80, 'b');
  bytes.append(reinterpret_cast<const char*>(&announced), sizeof announced);
  for (const auto& corners : facets) {
    bytes.append(12, '\0');
    bytes.append(reinterpret_cast<const char*>(corners.data()), sizeof corners);
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string stl_complaint(const std::string& bytes) {
  try {
    (void)parse_stl(bytes, "t.stl");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Stl, TextAndBinaryGiveTheSameSurface) {
  const TriangleList text = parse_stl("solid a b\n" + facet("0 0 0") + facet("10 10 0.5") + "endsolid a b\n", "t.stl");
  const TriangleList bytes =
      parse_stl(binary({{0, 0, 0, 10, 0, 0, 0, 10, 0}, {10, 10, 0.5, 10, 0, 0, 0, 10, 0}}, 2), "t.stl");
  EXPECT_EQ(text.point, bytes.point);
  EXPECT_EQ(text.triangle, bytes.triangle);
  EXPECT_EQ(text.point.size(), 4U) << "equal points are one";
  std::string solid = binary({{0, 0, 0, 10, 0, 0, 0, 10, 0}}, 1);
  std::memcpy(solid.data(), "solid ", 6);
  EXPECT_EQ(parse_stl(solid, "t.stl").triangle.size(), 1U) << "many binary files begin with solid";
  EXPECT_EQ(
      stl_complaint("SOLID X\nFACET NORMAL nan nan nan OUTER LOOP VERTEX 0 0 0 VERTEX +1e0 0 0 VERTEX 0 1 0 ENDLOOP "
                    "ENDFACET\nENDSOLID"),
      "");
}

// As old CAD systems, numpy-stl, spreadsheets and people write them.
TEST(Stl, TextIsReadInAnyCaseOfLettersWithWhateverStandsBeforeSolid) {
  const std::string sound = "solid a\n" + facet("0 0 0") + facet("10 10 0.5") + "endsolid a\n";
  const TriangleList wanted = parse_stl(sound, "t.stl");
  std::string upper = sound, tabs = sound, old_mac = sound, apart = sound;
  std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return std::toupper(c); });
  std::replace(tabs.begin(), tabs.end(), ' ', '\t');
  std::replace(old_mac.begin(), old_mac.end(), '\n', '\r');
  for (std::size_t at = 0; (at = apart.find("end", at)) != std::string::npos; at += 4) apart.insert(at + 3, 1, ' ');
  const std::string mark = "\xEF\xBB\xBF", rest = sound.substr(6);
  std::vector<std::string> variants = {upper, tabs, old_mac, apart, sound + "\n# the end\n"};
  for (const std::string& begin : {std::string("Solid "), std::string("solid\t"), mark + "solid ",
                                   mark + "\r\n \r\nSOLID ", std::string("# made by hand\n\n; and looked at\nsolid "),
                                   std::string("\n\n  \tsolid "), std::string("title: a solid part\nsolid ")})
    variants.push_back(begin + rest);
  variants.push_back(sound.substr(0, sound.find("endsolid")) + std::string("ENDSOLID a\n"));
  for (const std::string& variant : variants) {
    ASSERT_EQ(stl_complaint(variant), "") << variant.substr(0, 40);
    EXPECT_EQ(parse_stl(variant, "t.stl").point, wanted.point) << variant.substr(0, 40);
  }
}

TEST(Stl, SizeTellsBinaryFromText) {
  for (const char* begin : {"solid ", "SOLID part\n", "Solid\tx", "# solid\n"}) {
    std::string bytes = binary({{0, 0, 0, 10, 0, 0, 0, 10, 0}, {10, 10, 0.5, 10, 0, 0, 0, 10, 0}}, 2);
    std::memcpy(bytes.data(), begin, std::strlen(begin));
    EXPECT_EQ(parse_stl(bytes, "t.stl").triangle.size(), 2U) << begin;
    EXPECT_NE(stl_complaint(bytes.substr(0, bytes.size() - 20)).find("announces 2 facets"), std::string::npos) << begin;
  }
}

TEST(Stl, CornersThatAreNoPlaceAreRefusedByFacet) {
  for (const char* corner : {"nan 0 0", "0 inf 0", "0 0 -inf", "1e308 0 0", "0 1e999 0", "0 0 1.1e7"}) {
    const std::string line = stl_complaint("solid\n" + facet("0 0 0") + facet(corner) + "endsolid\n");
    EXPECT_NE(line.find("facet 2 has a corner at"), std::string::npos) << corner << ": " << line;
  }
  for (const float x : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 3e38F}) {
    const std::string line = stl_complaint(binary({{0, 0, 0, 10, 0, 0, 0, 10, 0}, {x, 0, 0, 10, 0, 0, 0, 10, 0}}, 2));
    EXPECT_NE(line.find("facet 2 has a corner at"), std::string::npos) << line;
  }
}

TEST(Stl, SizesAreComparedWithTheFile) {
  const std::string line = stl_complaint(binary({{0, 0, 0, 10, 0, 0, 0, 10, 0}}, 4000000000U));
  EXPECT_NE(line.find("announces 4000000000 facets and 50 bytes follow"), std::string::npos) << line;
  EXPECT_NE(stl_complaint(""), "");
  EXPECT_NE(stl_complaint("solid\nendsolid\n").find("no facet"), std::string::npos);
  EXPECT_NE(stl_complaint("solid\n" + facet("0 0 0")).find("no endsolid"), std::string::npos);
  EXPECT_NE(stl_complaint("solid\n" + facet("0 0 0").substr(0, 60)).find("cut short"), std::string::npos);
  EXPECT_NE(stl_complaint("solid\n" + facet("0 0 zero") + "endsolid\n").find("t.stl:4: not an STL surface: 'zero'"),
            std::string::npos);
}

TEST(Stl, DamagedFilesEndInASurfaceOrAnError) {
  const std::string text = "solid a\n" + facet("0 0 0") + facet("10 10 0.5") + "endsolid a\n";
  const std::string bytes = binary({{0, 0, 0, 10, 0, 0, 0, 10, 0}, {10, 10, 0.5, 10, 0, 0, 0, 10, 0}}, 2);
  int read = 0;
  for (const std::string& sound : {text, bytes})
    for (unsigned seed = 0; seed < 3000; ++seed) {
      try {
        const TriangleList list = parse_stl(test::damaged(sound, seed), "t.stl");
        (void)inspect(list);
        (void)turned_alike(list, {0, 0, 1e6});
        ++read;
      } catch (const InputError&) {
      }
    }
  EXPECT_GT(read, 100) << "not all damage is noticed, nor need be";
}

}  // namespace
}  // namespace weaveform
