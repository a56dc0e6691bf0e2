#include "mesher/drape/regions.hpp"

#include <algorithm>
#include <cstdlib>

namespace weaveform {

std::vector<Region> connected_regions(const std::vector<char>& marked, const std::array<int, 2>& size,
                                      const std::array<int, 2>& centre) {
  std::vector<char> left = marked;
  const auto index = [&](int i, int j) { return static_cast<std::size_t>(j) * size[0] + i; };
  const auto off = [&](const std::array<int, 2>& a) { return std::abs(a[0] - centre[0]) + std::abs(a[1] - centre[1]); };
  std::vector<Region> regions;
  std::vector<std::array<int, 2>> open;
  for (int j = 0; j < size[1]; ++j)
    for (int i = 0; i < size[0]; ++i) {
      if (left[index(i, j)] == 0) continue;
      Region region{{i, j}, 0};
      open.assign(1, {i, j});
      left[index(i, j)] = 0;
      while (!open.empty()) {
        const auto at = open.back();
        open.pop_back();
        ++region.count;
        if (off(at) < off(region.first)) region.first = at;
        for (int b = std::max(0, at[1] - 1); b <= std::min(size[1] - 1, at[1] + 1); ++b)
          for (int a = std::max(0, at[0] - 1); a <= std::min(size[0] - 1, at[0] + 1); ++a) {
            if (left[index(a, b)] == 0) continue;
            left[index(a, b)] = 0;
            open.push_back({a, b});
          }
      }
      regions.push_back(region);
    }
  std::stable_sort(regions.begin(), regions.end(), [](const Region& a, const Region& b) { return a.count > b.count; });
  return regions;
}

}  // namespace weaveform
