#include "solver/result/chart_file.hpp"

#include <functional>
#include <mutex>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/log/say.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

// Even of a quiet run: files that were asked for are missing.
void say_once(const std::string& reason) {
  static std::once_flag said;
  std::call_once(said, [&] { say("warning: " + reason + "; the charts are left out"); });
}

void write_drawing(const fs::path& file, const std::function<std::string()>& draw) {
  std::string drawing;
  try {
    drawing = draw();
  } catch (const FileError& error) {
    fs::remove(file);
    return say_once(error.what());
  }
  write_text_whole(file, drawing);
}

}  // namespace

void write_chart(const fs::path& file, const Chart& chart) {
  write_drawing(file, [&] { return to_svg(chart); });
}

void write_chart_page(const fs::path& file, const std::string& title, const std::vector<Chart>& charts) {
  write_drawing(file, [&] { return to_html(title, charts); });
}

}  // namespace weaveform
