#include "app/study/snakemake.hpp"

#include <fmt/format.h>

#include <set>
#include <sstream>
#include <string>

#include "app/study/runner.hpp"
#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/keys/toml_document.hpp"
#include "mesher/scene/reader.hpp"

namespace weaveform::study {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view mark = "# Written by weaveform";

void write_ours(const fs::path& file, const std::string& text) {
  if (fs::exists(file) && !read_text_file(file).starts_with(mark))
    throw InputError(
        fmt::format("{}: not written by weaveform and would be lost; choose another --output folder", file.string()));
  write_text_whole(file, fmt::format("{}.\n{}", mark, text));
}

// The study file with its scene beside it.
std::string moved_study(const Study& study) {
  toml::table root = parse_toml(read_text_file(study.file), study.file.string());
  root.insert_or_assign("scene", "scene.toml");
  std::ostringstream text;
  text << root << "\n";
  return text.str();
}

std::string moved_scene(const Study& study) {
  std::vector<std::string> overrides;
  for (const Setting& setting : study.set) overrides.push_back(setting.override_text());
  return scene_to_toml(with_absolute_paths(read_scene(scene_path(study), overrides)));
}

// A case that fails is a result: its exit code is written and the others go on. Only an interrupted one is left to be
// run again.
constexpr const char* rules = R"(
weaveform = config.get("weaveform", "weaveform")  # the program: --config weaveform=/path/to/weaveform


rule all:
    input:
        "study.csv",


rule solve:
    input:
        "cases/{case}.toml",
    output:
        "cases/{case}.exit",
    log:
        "cases/{case}.log",
    threads: THREADS
    shell:
        "code=0; {weaveform:q} run {input:q} --output cases/{wildcards.case} --threads {threads} --quiet 2> {log:q} || code=$?; "
        "test $code -ne 130; echo $code > {output:q}"


rule table:
    input:
        expand("cases/{case}.exit", case=cases),
    output:
        "study.csv",
    shell:
        "{weaveform:q} study study.toml --output . --collect --quiet"
)";

std::string snakefile(const Study& study, const std::vector<Case>& cases) {
  std::string text =
      "# Runs every case of the study: snakemake --directory DIR --snakefile DIR/Snakefile --cores N, DIR being this "
      "folder.\n\n"
      "cases = [\n";
  std::set<std::string> names;
  for (const Case& one : cases)
    if (names.insert(one.name).second) text += fmt::format("    \"{}\",  # {}\n", one.name, describe(one));
  std::string body = rules;
  const std::string word = "THREADS";
  body.replace(body.find(word), word.size(), std::to_string(study.head.threads));
  return text + "]\n" + body;
}

}  // namespace

void export_snakemake(const Study& study, const std::vector<Case>& cases, const fs::path& directory) {
  if (study.border)
    throw InputError(
        fmt::format("{}: a study with [border] is no workflow: which cases it has depends on their results; "
                    "run it with 'weaveform study' itself",
                    study.file.string()));
  if (study.head.repeats > 1)
    throw InputError(fmt::format("{}: a workflow runs each case once; leave 'repeats' out to export the study",
                                 study.file.string()));
  const std::string study_text = moved_study(study), scene_text = moved_scene(study);
  write_ours(directory / "study.toml", study_text);
  write_ours(directory / "scene.toml", scene_text);
  write_ours(directory / "Snakefile", snakefile(study, cases));
  for (const Case& one : cases) write_case(one, directory);
}

}  // namespace weaveform::study
