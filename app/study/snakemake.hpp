// A study as a Snakemake workflow (https://snakemake.github.io): the same cases, run by `weaveform run`, on whatever
// machine or queue Snakemake is told of; collected into the same study.csv by `weaveform study --collect`.
#pragma once

#include <filesystem>
#include <vector>

#include "app/study/cases.hpp"

namespace weaveform::study {

// Writes DIR/Snakefile, the scenes of the cases (DIR/cases/NAME.toml), and what `--collect` needs there: DIR/study.toml
// and DIR/scene.toml, so that the folder can be copied to another machine (cards and shapes in files of their own stay
// where they are, by absolute path). Files of that name that Weaveform did not write are an InputError, and so is
// a study with [border] (its cases depend on results) or `repeats`. Throws FileError.
void export_snakemake(const Study& study, const std::vector<Case>& cases, const std::filesystem::path& directory);

}  // namespace weaveform::study
