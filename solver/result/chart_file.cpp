#include "solver/result/chart_file.hpp"

#include <cstddef>
#include <functional>
#include <mutex>
#include <utility>

#include "core/error.hpp"
#include "core/files/files.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

// None at first.
std::function<void(const std::string&)>& hearer() {
  static std::function<void(const std::string&)> hears;
  return hears;
}

void tell_once(const std::string& reason) {
  static std::once_flag told;
  if (hearer()) std::call_once(told, [&] { hearer()(reason + "; the charts are left out"); });
}

}  // namespace

void hear_of_missing_charts(std::function<void(const std::string&)> hears) {
  hearer() = std::move(hears);
}

void write_chart(const fs::path& file, const Chart& chart) {
  write_charts({{file, chart}});
}

void write_charts(const std::vector<std::pair<fs::path, Chart>>& charts) {
  std::vector<Chart> wanted;
  for (const auto& named : charts) wanted.push_back(named.second);
  std::vector<std::string> drawn;
  try {
    drawn = to_svgs(wanted);
  } catch (const FileError& error) {
    for (const auto& named : charts) fs::remove(named.first);
    return tell_once(error.what());
  }
  for (std::size_t i = 0; i < charts.size(); ++i) write_text_whole(charts[i].first, drawn[i]);
}

}  // namespace weaveform
