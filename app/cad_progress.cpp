#include "app/cad_progress.hpp"

#include <chrono>
#include <filesystem>
#include <memory>

#include "core/log/progress.hpp"
#include "mesher/tools/gmsh_session.hpp"

namespace weaveform {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds patience{1};  // most parts take less, and are not worth a word

struct Reading {
  Clock::time_point begun;
  std::unique_ptr<Progress> bar;
  bool shown = false;
};

void tell(Reading& reading, const std::filesystem::path& file, double fraction) {
  if (!reading.bar)
    reading = {Clock::now(), std::make_unique<Progress>("triangles of " + file.filename().string(), false), false};
  const bool done = fraction >= 1.0;
  if (!done && Clock::now() - reading.begun > patience) {
    reading.bar->update(fraction, "");
    reading.shown = true;
  }
  if (!done) return;
  if (reading.shown) reading.bar->finish("");
  reading = {};
}

}  // namespace

void show_cad_progress(bool shown) {
  if (!shown) return watch_cad_reading({});
  const auto reading = std::make_shared<Reading>();
  watch_cad_reading([reading](const std::filesystem::path& file, double fraction) { tell(*reading, file, fraction); });
}

}  // namespace weaveform
