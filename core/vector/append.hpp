// One list behind another.
#pragma once

#include <vector>

namespace weaveform {

template <class Item>
void append(std::vector<Item>& all, const std::vector<Item>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace weaveform
