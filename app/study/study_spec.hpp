// What a study file asks for, as plain data (docs/study.md). The defaults below are the only place where they are
// written; study_schema.cpp names each key, its type and range.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/study/border_spec.hpp"
#include "app/study/choices.hpp"
#include "core/keys/key_info.hpp"
#include "core/keys/toml_document.hpp"

namespace weaveform::study {

// One scene key with the value a case gives it, and where the study file says so.
struct Setting {
  std::string key;               // "grip.top.travel", as in --set
  std::string value;             // TOML on one line
  std::optional<double> number;  // of a value that is a number, or a list of one and the same number
  toml::source_region where = {};
  [[nodiscard]] std::string override_text() const { return key + "=" + value; }
};
using Settings = std::vector<Setting>;

// What sets a case apart: its settings, and the series it belongs to in charts ("": none).
struct Variant {
  Settings settings;
  std::string series = {};
};

// One direction in which the cases differ: its points are taken one at a time, each setting the same keys or fewer.
struct Axis {
  std::vector<Variant> point;
};

struct StudyHead {
  std::string scene;                  // file, relative to the study file
  std::vector<std::string> measures;  // columns of study.csv; empty: the scene's own (measure.hpp)
  int threads = 1;                    // of each case
  int repeats = 1;                    // runs of each case, whose median is its time
};

struct ConvergenceSpec {
  std::string key;
  std::vector<std::string> measures;  // empty: those of the study
  Finer finer = Finer::smaller;       // values of the key
  double tolerance = 0.02;            // relative
  double greatest_order = 2.0;        // of the scheme
};

// What a measure should be: a number, or another measure of the same case.
struct ReferenceValue {
  std::string measure;
  std::optional<double> number;
  std::string other;  // without a number
  toml::source_region where = {};
};

struct WorkPrecisionSpec {
  std::vector<std::string> measures;  // empty: those of the study
  // limit: Richardson's, of [convergence]; one_case: that of [work_precision.case]; value: [work_precision.value]
  ErrorReference reference = ErrorReference::limit;
  std::vector<std::string> absolute = {};                 // measures whose error is absolute, in their own unit
  std::vector<double> within = {0.05, 0.02, 0.01};        // errors for which the cheapest case is told: relative,
  std::vector<double> within_absolute = {2.0, 1.0, 0.5};  // and of absolute measures in their unit
};

// [work_precision.*]
struct WorkPrecisionTables {
  Variant reference_case;                   // values that pick one case
  std::optional<Variant> limit_of;          // values that pick one convergence group for all cases
  std::vector<ReferenceValue> value;        // of reference = "value"
  std::vector<ReferenceValue> uncertainty;  // numbers, in the measure's unit
};

struct Study {
  std::filesystem::path file;
  StudyHead head;
  Settings set;            // of every case
  std::vector<Axis> axes;  // the cases are the product of all axes, the last varying fastest
  std::optional<ConvergenceSpec> convergence;
  std::optional<WorkPrecisionSpec> work_precision;
  WorkPrecisionTables reference;
  std::optional<BorderSpec> border;
  toml::source_region measures_at = {}, convergence_at = {}, work_precision_at = {}, repeats_at = {};
};

// Reads a study file. Throws InputError with every complaint at once, each "file:line:column: ...", and FileError.
[[nodiscard]] Study read_study(const std::filesystem::path& file);
[[nodiscard]] Study read_study_text(const std::string& text, const std::filesystem::path& name);

// The scene file, found beside the study file.
[[nodiscard]] std::filesystem::path scene_path(const Study& study);

// Keys that differ between cases, in the order of the axes; the key of [border] last.
[[nodiscard]] std::vector<std::string> varied_keys(const Study& study);

// Every key of a study file (docs/study.md).
[[nodiscard]] std::string study_reference_markdown();
// The keys of its own tables among them.
[[nodiscard]] std::vector<KeyInfo> study_keys();

}  // namespace weaveform::study
