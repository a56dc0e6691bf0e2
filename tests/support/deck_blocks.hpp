// Decks of other codes read back by keyword and column, without the writers' help.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace weaveform::test {

// Lines after a line that begins with `mark`; comment lines are left out.
struct DeckBlock {
  std::string keyword;
  std::vector<std::string> line;
  [[nodiscard]] bool is(const std::string& word) const { return keyword.rfind(word, 0) == 0; }
  [[nodiscard]] int id() const { return std::stoi(keyword.substr(keyword.rfind('/') + 1)); }  // of OpenRadioss
};
inline std::vector<DeckBlock> deck_blocks(const std::string& text, char mark, char comment) {
  std::vector<DeckBlock> blocks;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line[0] == comment) continue;
    if (!line.empty() && line[0] == mark)
      blocks.push_back({line, {}});
    else if (blocks.empty())
      ADD_FAILURE() << "data before any keyword: " << line;
    else
      blocks.back().line.push_back(line);
  }
  return blocks;
}

inline double deck_real(const std::string& line, std::size_t from, std::size_t width) {
  EXPECT_GE(line.size(), from + 1) << line;
  if (line.size() < from + 1) return 0.0;
  const std::string text = line.substr(from, width);
  std::size_t used = 0;
  const double value = std::stod(text, &used);
  EXPECT_EQ(text.find_first_not_of(' ', used), std::string::npos) << "'" << text << "' in " << line;
  return value;
}
inline long deck_whole(const std::string& line, std::size_t from, std::size_t width) {
  return std::lround(deck_real(line, from, width));
}

// Straight lines between points, and on beyond the ends.
struct DeckCurve {
  std::vector<std::array<double, 2>> point;
  [[nodiscard]] double at(double x) const {
    std::size_t k = 1;
    while (k + 1 < point.size() && point[k][0] < x) ++k;
    const auto &a = point[k - 1], &b = point[k];
    return a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
  }
};
inline DeckCurve deck_curve(const std::vector<std::string>& lines, std::size_t first) {
  DeckCurve curve;
  for (std::size_t k = first; k < lines.size(); ++k)
    curve.point.push_back({deck_real(lines[k], 0, 20), deck_real(lines[k], 20, 20)});
  EXPECT_TRUE(std::is_sorted(curve.point.begin(), curve.point.end())) << "abscissae rise";
  return curve;
}

}  // namespace weaveform::test
