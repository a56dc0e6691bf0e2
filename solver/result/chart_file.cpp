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

void write_drawing(const fs::path& file, const std::function<std::string()>& draw) {
  std::string drawing;
  try {
    drawing = draw();
  } catch (const FileError& error) {
    fs::remove(file);
    return tell_once(error.what());
  }
  write_text_whole(file, drawing);
}

}  // namespace

void hear_of_missing_charts(std::function<void(const std::string&)> hears) {
  hearer() = std::move(hears);
}

void write_chart(const fs::path& file, const Chart& chart) {
  write_drawing(file, [&] { return to_svg(chart); });
}

void write_chart_page(const fs::path& file, const std::string& title, const std::vector<Chart>& charts) {
  write_drawing(file, [&] { return to_html(title, charts); });
}

}  // namespace weaveform
