// The engine's file: how long, at which step, what is written. Cards of free format.
#include <fmt/format.h>

#include "mesher/exchange/openradioss/openradioss.hpp"

namespace weaveform::foreign::radioss {

std::string engine_file(const Deck& deck, const std::string& run_name) {
  const Gathered& model = deck.model;
  const OutputSpec& output = model.scene.output;
  const auto part = [&](int parts) { return fit(model.duration / (parts > 0 ? parts : 1), 20); };
  std::string text = fmt::format("# Written by {}\n", model.written_by);
  text += fmt::format("# Engine file of {}_0000.rad; units mm, s, N, MPa, tonne\n", run_name);
  text += fmt::format("/RUN/{}/1\n{}\n", run_name, fit(model.duration, 20));
  text += "/VERS/2021\n/PRINT/-1000\n";
  // the step of the nodes: springs have none of their own that knows what they are joined to
  text += fmt::format("/DT/NODA\n{} 0\n", fit(model.scene.analysis.step_factor, 20));
  text += fmt::format("/TFILE\n{}\n", part(output.history));
  text += fmt::format("/ANIM/DT\n0 {}\n/ANIM/VECT/DISP\n/ANIM/VECT/VEL\n/ANIM/VECT/CONT\n", part(output.frames));
  text += "/ANIM/SHELL/TENS/STRESS/MEMB\n/ANIM/SHELL/TENS/STRAIN/MEMB\n/ANIM/SPRING/FORC\n";
  return text;
}

}  // namespace weaveform::foreign::radioss
