// weaveform chart FILE...: columns of delimited files over one another as SVG or HTML, e.g. measured over predicted
// loads.
#include "core/chart/chart.hpp"

#include <fmt/core.h>

#include <cstddef>
#include <filesystem>
#include <iterator>
#include <memory>

#include "app/commands/commands.hpp"
#include "app/stages/output_folder.hpp"
#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/files/text_words.hpp"
#include "core/keys/toml_document.hpp"
#include "fabric/identify/raw_table.hpp"

namespace weaveform {

namespace {

struct ChartArguments {
  std::vector<std::string> files;
  std::string x = "1", y = "2";  // column: heading or number
  std::string title, x_title, y_title;
  std::string output;
  int points = 0;  // so many of the files, from the first, are drawn as points
  bool log_x = false, log_y = false;
  bool force = false;
};

// Before any file is read: a chart of another kind under this name would open in nothing.
bool is_page(const std::filesystem::path& output) {
  const std::string ending = lower(output.extension().string());
  if (ending == ".html" || ending == ".htm") return true;
  if (ending == ".svg") return false;
  throw InputError(
      fmt::format("{}: a chart is written as .svg or .html; give --output one of these endings", output.string()));
}

void draw(const ChartArguments& arguments) {
  const std::filesystem::path output = arguments.output;
  const bool page = is_page(output);
  const auto scale = [](bool logarithmic) { return logarithmic ? AxisScale::logarithmic : AxisScale::linear; };
  Chart chart;
  chart.title = arguments.title;
  chart.x = {.title = arguments.x_title.empty() ? arguments.x : arguments.x_title, .scale = scale(arguments.log_x)};
  chart.y = {.title = arguments.y_title.empty() ? arguments.y : arguments.y_title, .scale = scale(arguments.log_y)};
  for (const auto& file : arguments.files) {
    const auto table = identify::read_raw_table(read_text_file(file), file, {});
    ChartSeries series;
    series.label = std::filesystem::path(file).stem().string();
    series.x = identify::numbers_of(table, identify::column_of(table, arguments.x, "--x"));
    series.y = identify::numbers_of(table, identify::column_of(table, arguments.y, "--y"));
    const auto index = std::ssize(chart.series);
    if (index < arguments.points) series.mark = ChartMark::points;
    if (index >= chart_colours) series.mark = ChartMark::dashed;
    chart.series.push_back(std::move(series));
  }
  // The chart is all that is asked for, so that no node is an error here; and an older chart must not pass for this
  // one.
  require_writable(output, {arguments.files.begin(), arguments.files.end()}, arguments.force);
  std::filesystem::remove(output);
  write_text_whole(output, page ? to_html(chart.title, {chart}) : to_svg(chart));
}

}  // namespace

void add_chart_command(CLI::App& program) {
  auto* command = program.add_subcommand("chart", "Draw columns of tables over one another (SVG, HTML), by node");
  const auto arguments = std::make_shared<ChartArguments>();
  command->add_option("FILE", arguments->files, "Tables: CSV, or columns between blanks; each is a series, in order")
      ->required();
  command->add_option("-o,--output", arguments->output, "The chart; a web page when it ends in .html")
      ->type_name("FILE.svg")
      ->required();
  command->add_option("--x", arguments->x, "Column along x: a heading, or its number from 1 (default 1)");
  command->add_option("--y", arguments->y, "Column along y (default 2)");
  command->add_option("--title", arguments->title, "Above the chart");
  command->add_option("--x-title", arguments->x_title, "Below the x axis, with its unit");
  command->add_option("--y-title", arguments->y_title, "Beside the y axis, with its unit");
  command->add_option("--points", arguments->points, "Draw that many files, from the first, as points");
  command->add_flag("--log-x", arguments->log_x, "Logarithmic x axis");
  command->add_flag("--log-y", arguments->log_y, "Logarithmic y axis");
  add_force_argument(*command, arguments->force);
  command->callback([arguments] { draw(*arguments); });
}

}  // namespace weaveform
