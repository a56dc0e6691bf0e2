// The whole identification: raw tests in, material card and everything said about it out. Nothing is written here.
#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/chart/chart.hpp"
#include "fabric/identify/bending_fit.hpp"
#include "fabric/identify/fit_spec.hpp"
#include "fabric/identify/shear_fit.hpp"
#include "fabric/identify/simulated_fit.hpp"
#include "fabric/identify/tension_fit.hpp"

namespace weaveform::identify {

struct Identification {
  FitSpec spec;
  std::vector<YarnFit> yarns;  // one for each [[tensile]]
  std::array<std::optional<std::size_t>, 2>
      yarn;                               // which of them is the warp's and the weft's; none: kept from the base
  std::optional<ShearFit> frame, bias;    // by the closed forms
  std::optional<SimulatedFit> simulated;  // of the same tests as closed_form(), where [shear] asks for it
  std::vector<BendingFit> bends;          // one for each kind of test and direction
  std::array<std::optional<std::size_t>, 2>
      bending;  // which of them makes the card's (bending_of); none: kept from the base
  Card card;
  std::string card_text;                 // the card as a file, checked by reading it back
  std::vector<std::string> assumptions;  // what was not measured, in sentences
  std::vector<std::string> warnings;
  bool replaces_other = false;  // the card that is replaced holds what this fit does not give: it is worth keeping
  // The shear fit that made the card's law; null when the base card's was kept.
  [[nodiscard]] const ShearFit* shear() const;
  // The closed form's fit of the tests that made it.
  [[nodiscard]] const ShearFit* closed_form() const;
  [[nodiscard]] bool shear_from_frame() const;
  // Whether a fit of `bends` is in the card.
  [[nodiscard]] bool makes_bending(std::size_t fit) const;
};

// `replaced` is the text of the card `file` that the new one will overwrite, whose parts that nothing here measures are
// carried over (carried_parts.hpp); "" for none. Throws InputError: whatever is wrong in the fit file or in a test
// file, all test files at once; FileError. `simulation` is needed where [shear] has method = "simulation", and what it
// throws goes through.
[[nodiscard]] Identification identify(const FitSpec& spec, const std::string& replaced = "",
                                      const std::string& file = "card.toml", const Simulation& simulation = {});

// A file of the answer, to be written under its name: a text or a chart.
struct OutputFile {
  std::string name;
  std::string text = {};
  std::optional<Chart> chart = {};
};

// card.toml, report.md, report.json, and for each kind of test a table (.csv) and, where it has a curve, a chart (.svg)
// of data, fit and band.
[[nodiscard]] std::vector<OutputFile> output_files(const Identification& found);

// The report's first section: the parameters with their intervals, as Markdown.
[[nodiscard]] std::string summary_markdown(const Identification& found);

// report.json, as a document.
[[nodiscard]] nlohmann::ordered_json fit_json(const Identification& found);

}  // namespace weaveform::identify
