#include "app/study/study_schema.hpp"

namespace weaveform::study {

const std::vector<Key<StudyHead>>& head_keys() {
  static const std::vector<Key<StudyHead>> keys = {
      key<&StudyHead::scene>(
          {.name = "scene", .required = true, .doc = "scene file that is varied, relative to the study file"}),
      key<&StudyHead::measures>(
          {.name = "measures",
           .doc = "columns of `study.csv`: a number of `summary.json` by its path (`grips.top.force_N`, `wall_s`), or "
                  "`last(COLUMN)`, `max(COLUMN)`, `min(COLUMN)` of `history.csv`; left out: `max_shear_angle_deg` and "
                  "the last force of each grip, frame and tool"}),
      key<&StudyHead::threads>({.name = "threads",
                                .unit = "1",
                                .limits = between(1, 1024),
                                .doc = "of each case; the results are the same bits with any number"}),
  };
  return keys;
}

const std::vector<Key<ConvergenceSpec>>& convergence_keys() {
  static const std::vector<Key<ConvergenceSpec>> keys = {
      key<&ConvergenceSpec::key>({.name = "key",
                                  .required = true,
                                  .doc = "varied scene key that refines; of `blank.coarsening` the spacing of the mesh "
                                         "as it was built counts, of any other key its number"}),
      key<&ConvergenceSpec::measures>({.name = "measures", .doc = "that converge; left out: all of the study"}),
      key<&ConvergenceSpec::finer>(
          {.name = "finer", .allowed = {"smaller", "larger"}, .doc = "which values of the key are finer"}),
      key<&ConvergenceSpec::tolerance>({.name = "tolerance",
                                        .unit = "1",
                                        .limits = above(0, 1),
                                        .doc = "relative error within which the cheapest level is sought"}),
      key<&ConvergenceSpec::greatest_order>({.name = "greatest_order",
                                             .unit = "1",
                                             .limits = between(0.5, 10),
                                             .doc = "of the scheme; a greater observed order is taken for chance"}),
  };
  return keys;
}

const std::vector<Key<WorkPrecisionSpec>>& work_precision_keys() {
  static const std::vector<Key<WorkPrecisionSpec>> keys = {
      key<&WorkPrecisionSpec::measures>(
          {.name = "measures", .doc = "one chart each; left out: all of [convergence], or of the study"}),
      key<&WorkPrecisionSpec::reference>(
          {.name = "reference",
           .allowed = {"limit", "case"},
           .doc = "what errors are relative to: the limit that [convergence] finds, or the case that "
                  "[work_precision.case] picks by its varied keys"}),
  };
  return keys;
}

std::string study_reference_markdown() {
  const auto section = [](const char* title, const char* doc, const std::vector<KeyInfo>& keys) {
    return std::string("\n### ") + title + "\n\n" + doc + "\n\n" + markdown_table(keys);
  };
  return section("The study", "Before the first table of the file.", describe_keys("", head_keys())) +
         "\n### `[set]`, `[grid]`, `[[paired]]`, `[[case]]`\n\nTheir keys are the scene's, as `--set` takes them "
         "(`blank.coarsening`, `grip.top.travel`).\n\n"
         "| table | its values | cases |\n|---|---|---|\n"
         "| `[set]` | one each | the same in every case |\n"
         "| `[grid]` | a list each | every combination of all lists |\n"
         "| `[[paired]]` | lists of one length | first values together, second values together, ... |\n"
         "| `[[case]]` | one each | one for each table |\n\n"
         "Each list of `[grid]`, each `[[paired]]` and all `[[case]]` together are an axis; the cases are the product "
         "of "
         "the axes, in the order [[case]], [[paired]], [grid], the last varying fastest.\n" +
         section("`[convergence]`", "Observed order, limit and error bounds over one of the varied keys.",
                 describe_keys("convergence", convergence_keys())) +
         section("`[work_precision]`", "Charts of time against error.",
                 describe_keys("work_precision", work_precision_keys())) +
         "\n`[work_precision.case]` picks the reference case by values of varied keys.\n";
}

}  // namespace weaveform::study
