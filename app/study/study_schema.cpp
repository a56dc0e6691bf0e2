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
      key<&StudyHead::repeats>({.name = "repeats",
                                .unit = "1",
                                .limits = between(1, 1000),
                                .doc = "runs of each case; the median of their times is its time. The rest is the same "
                                       "bits each time"}),
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
      key<&ConvergenceSpec::finer>({.name = "finer", .doc = "which values of the key are finer"}),
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
           .doc = "what errors are relative to: the limit that [convergence] finds; the case that "
                  "[work_precision.case] picks; the numbers or other measures (closed forms) of "
                  "[work_precision.value]"}),
      key<&WorkPrecisionSpec::absolute>({.name = "absolute",
                                         .doc = "measures whose error is told in their own unit (angles), not "
                                                "relative; without a unit at the end of their name "
                                                "they are pure numbers (errors themselves) and told in %"}),
      key<&WorkPrecisionSpec::within>(
          {.name = "within",
           .unit = "1",
           .limits = above(0, 1),
           .doc = "errors for which the cheapest case is told, of relative ones and of pure numbers"}),
      key<&WorkPrecisionSpec::within_absolute>(
          {.name = "within_absolute", .limits = above(0), .doc = "the same of `absolute` measures that have a unit"}),
  };
  return keys;
}

const std::vector<Key<BorderSpec>>& border_keys() {
  static const std::vector<Key<BorderSpec>> keys = {
      key<&BorderSpec::key>({.name = "key", .required = true, .doc = "scene key that is bisected"}),
      key<&BorderSpec::holds>({.name = "holds", .required = true, .doc = "its value where the method holds"}),
      key<&BorderSpec::fails>(
          {.name = "fails", .required = true, .doc = "its value where the method fails; greater or smaller"}),
      key<&BorderSpec::tolerance>({.name = "tolerance",
                                   .unit = "1",
                                   .limits = between(1e-4, 1),
                                   .doc = "how near they come: their distance over the greater of both; logarithmic: "
                                          "ln of their ratio"}),
      key<&BorderSpec::scale>(
          {.name = "scale", .doc = "tries their mean, or their geometric mean (when they are decades apart)"}),
  };
  return keys;
}

const std::vector<Key<BorderCondition>>& condition_keys() {
  static const std::vector<Key<BorderCondition>> keys = {
      key<&BorderCondition::measure>({.name = "measure", .doc = "as in `measures`"}),
      key<&BorderCondition::at_most>({.name = "at_most", .doc = "its greatest value"}),
      key<&BorderCondition::at_least>({.name = "at_least", .doc = "its least value"}),
      key<&BorderCondition::within>(
          {.name = "within", .unit = "1", .limits = above(0), .doc = "greatest of abs(measure - of)/abs(of)"}),
      key<&BorderCondition::of>({.name = "of",
                                 .doc =
                                     "a number; another measure of the same case (a closed form); or \"holds\": this "
                                     "measure at the group's `holds` end"}),
      key<&BorderCondition::no_warnings>(
          {.name = "no_warnings", .doc = "the run says nothing against itself (`warnings` of `summary.json`)"}),
  };
  return keys;
}

std::vector<KeyInfo> study_keys() {
  std::vector<KeyInfo> all;
  for (const auto& keys : {describe_keys("", head_keys()), describe_keys("convergence", convergence_keys()),
                           describe_keys("work_precision", work_precision_keys()),
                           describe_keys("border", border_keys()), describe_keys("border.while", condition_keys())})
    all.insert(all.end(), keys.begin(), keys.end());
  return all;
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
         "of the axes, in the order [[case]], [[paired]], [grid], the last varying fastest. A `[[case]]` may also say "
         "`series = \"loading speed\"`: cases of one series have a colour in charts.\n" +
         section("`[convergence]`", "Observed order, limit and error bounds over one of the varied keys.",
                 describe_keys("convergence", convergence_keys())) +
         section("`[work_precision]`", "Charts of time against error.",
                 describe_keys("work_precision", work_precision_keys())) +
         "\n| table | its keys |\n|---|---|\n"
         "| `[work_precision.case]` | varied keys, `series`: values that pick the reference case |\n"
         "| `[work_precision.limit_of]` | the same, to pick the one convergence group whose limit counts for all "
         "cases; left out: each group's own for its levels |\n"
         "| `[work_precision.value]` | measures: a number, or text: another measure of the same case |\n"
         "| `[work_precision.uncertainty]` | measures: how far that number or case may itself be off, in the "
         "measure's unit |\n" +
         section("`[border]`",
                 "Where the method stops to hold, by bisection, apart for every combination of what is varied.",
                 describe_keys("border", border_keys())) +
         section("`[[border.while]]`",
                 "All must be met for a case that is done to hold. None: it is enough to be done (exit code 0).",
                 describe_keys("border.while", condition_keys()));
}

}  // namespace weaveform::study
