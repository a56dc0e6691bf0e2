#include "solver/result/chart_file.hpp"

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
  std::string drawing;
  try {
    drawing = to_svg(chart);
  } catch (const FileError& error) {
    fs::remove(file);
    return tell_once(error.what());
  }
  write_text_whole(file, drawing);
}

}  // namespace weaveform
