#include "app/study/snakemake.hpp"

#include <fmt/format.h>

#include <set>
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

// Where a place of a TOML document is in its text; columns count characters of UTF-8, from 1.
std::size_t offset_of(const std::string& text, const toml::source_position& place) {
  std::size_t at = 0;
  for (toml::source_index line = 1; line < place.line; ++line) at = text.find('\n', at) + 1;
  for (toml::source_index column = 1; column < place.column; ++column) {
    ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U) ++at;
  }
  return at;
}

// The study file with its scene beside it; word for word, as the order of its axes is that of the table's columns.
std::string moved_study(const Study& study) {
  std::string text = read_text_file(study.file);
  const toml::table root = parse_toml(text, study.file.string());
  const toml::source_region& scene = root.get("scene")->source();
  const std::size_t begin = offset_of(text, scene.begin), end = offset_of(text, scene.end);
  return text.replace(begin, end - begin, "\"scene.toml\"");
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
