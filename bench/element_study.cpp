// The elements that bend, against closed forms and against each other: `./dev charts` writes into the given folder
//   closed_forms.csv  every case of tests/support/bending_cases.hpp: error and order at each fineness
//   time.csv          wall time per step, stable step and wall time per simulated second of the heavy strip
//   error.svg, time.svg  error of the strip's tip and of the plate's twist over cells, and over that time
// and prints the table of docs/elements.md.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "core/chart/chart.hpp"
#include "core/files/files.hpp"
#include "mesher/lattice/build.hpp"
#include "solver/result/chart_file.hpp"
#include "solver/solve.hpp"
#include "tests/support/bending_cases.hpp"

namespace {

using namespace weaveform;
using test::Bender;

struct Line {
  std::string name, bender;
  std::vector<int> cells;
  std::vector<double> error;
  // Of the last doubling.
  [[nodiscard]] double order() const { return std::log2(error[error.size() - 2] / error.back()); }
};

std::vector<Line> measure_errors() {
  std::vector<Line> lines;
  for (const auto& of_case : test::bending_cases())
    for (const Bender bender : of_case.benders) {
      Line line{of_case.name, name_of(bender), {}, {}};
      for (int cells = bender == Bender::yarn ? 12 : 6; cells <= (bender == Bender::yarn ? 48 : 24); cells *= 2) {
        line.cells.push_back(cells);
        line.error.push_back(of_case.run(bender, cells).error);
      }
      lines.push_back(line);
    }
  return lines;
}

std::string error_table(const std::vector<Line>& lines) {
  std::string text = "| case | element | 6 cells | 12 | 24 | 48 | order |\n|---|---|---:|---:|---:|---:|---:|\n";
  for (const auto& line : lines) {
    text += fmt::format("| {} | {} |", line.name, line.bender);
    for (const int cells : {6, 12, 24, 48}) {
      const auto found = std::find(line.cells.begin(), line.cells.end(), cells);
      text += found == line.cells.end() ? " |" : fmt::format(" {:.1e} |", line.error[found - line.cells.begin()]);
    }
    text += line.error.back() < 1e-5 ? " exact |\n"
            : line.order() > 0.0     ? fmt::format(" {:.2f} |\n", line.order())
                                     : " none |\n";
  }
  return text;
}

std::string error_csv(const std::vector<Line>& lines) {
  std::string text = "case,element,cells,error\n";
  for (const auto& line : lines)
    for (std::size_t k = 0; k < line.cells.size(); ++k)
      text += fmt::format("\"{}\",{},{},{:.4e}\n", line.name, line.bender, line.cells[k], line.error[k]);
  return text;
}

struct Cost {
  std::string element;
  int along = 0, cells = 0;
  double step = 0.0, wall_per_step = 0.0;  // s
  [[nodiscard]] double wall_per_second() const { return wall_per_step / step; }
};

// The strip of the heavy elastica as the program runs it, on one thread.
class StripRun {
public:
  StripRun(const std::string& element, int along) {
    const double length = 24 * card_.yarn[0].interval, k = 24.0 / along;
    scene_.blank.size = {length, 0.5 * length};
    scene_.blank.yarn_angle = 0.0;
    scene_.blank.coarsening = {k, k};
    if (const auto yarn = choice_named<YarnElement>(element)) scene_.model.yarn = *yarn;
    if (const auto cell = choice_named<CellElement>(element)) scene_.model.cell = *cell;
    GripSpec clamp;
    clamp.name = "clamp";
    clamp.edge = BlankEdge::left;
    scene_.grip.push_back(clamp);
    scene_.analysis.gravity = {0.0, 0.0, -9810.0};
    scene_.analysis.energy_limit = 1.0;  // too short for a balance
    scene_.output = {.frames = 0, .history = 1};
    mesh_ = build_mesh(scene_, card_);
    cost = {element, along, mesh_.cells.size(), run(1e-6).step_s, std::numeric_limits<double>::infinity()};
  }
  // Keeps the least time of all calls: a shared machine only ever adds to it.
  void measure() {
    const auto statistics = run(std::max(2000.0, 1e6 / cost.cells) * cost.step);
    cost.wall_per_step = std::min(cost.wall_per_step, statistics.wall_s / static_cast<double>(statistics.steps));
  }
  Cost cost;

private:
  SolveStatistics run(double duration) {
    scene_.analysis.duration = duration;
    return solve(mesh_, scene_, card_, {}, {.threads = 1, .resume = false, .quiet = true}).statistics;
  }
  Card card_ = load_card("twintex-pw");
  Scene scene_;
  Mesh mesh_;
};

// In turns, so that what else the machine does meets all elements alike.
std::vector<Cost> measure_costs() {
  std::vector<Cost> costs;
  for (const int along : {6, 12, 24, 48, 96}) {
    std::vector<StripRun> runs;
    for (const std::string element : {"membrane", "beam", "rotation-free", "shell"}) runs.emplace_back(element, along);
    for (int turn = 0; turn < 12; ++turn)
      for (auto& run : runs) run.measure();
    for (const auto& run : runs) costs.push_back(run.cost);
  }
  return costs;
}

std::string cost_csv(const std::vector<Cost>& costs) {
  std::string text = "element,cells_along,cells,stable_step_s,wall_per_step_us,wall_per_simulated_s\n";
  for (const auto& c : costs)
    text += fmt::format("{},{},{},{:.4g},{:.3f},{:.3f}\n", c.element, c.along, c.cells, c.step, 1e6 * c.wall_per_step,
                        c.wall_per_second());
  return text;
}

const Line& line_of(const std::vector<Line>& lines, const std::string& name, const std::string& bender) {
  return *std::find_if(lines.begin(), lines.end(),
                       [&](const Line& line) { return line.name.starts_with(name) && line.bender == bender; });
}

std::vector<double> as_numbers(const std::vector<int>& values) {
  return {values.begin(), values.end()};
}

Chart error_chart(const std::vector<Line>& lines) {
  Chart chart;
  chart.title = "Error against cells: tip of a heavy strip, twist of a square plate";
  chart.x = {.title = "cells along the strip or plate", .scale = AxisScale::logarithmic};
  chart.y = {.title = "relative error", .scale = AxisScale::logarithmic};
  const auto add = [&](const std::string& name, const std::string& bender, const std::string& label, ChartMark mark,
                       int colour) {
    const Line& line = line_of(lines, name, bender);
    chart.series.push_back({label, as_numbers(line.cells), line.error, mark, colour});
  };
  add("own weight, large", "rotation-free", "tip, rotation-free (and beam)", ChartMark::line, 0);
  add("own weight, large", "shell", "tip, shell", ChartMark::line, 1);
  add("twist by corners", "rotation-free", "twist, rotation-free", ChartMark::dashed, 0);
  add("twist by corners", "shell", "twist, shell with its edge's shear", ChartMark::dashed, 1);
  return chart;
}

Chart time_chart(const std::vector<Line>& lines, const std::vector<Cost>& costs) {
  Chart chart;
  chart.title = "Error of the heavy strip's tip against time";
  chart.x = {.title = "wall time per simulated second (s), one thread", .scale = AxisScale::logarithmic};
  chart.y = {.title = "error of the tip's place / length", .scale = AxisScale::logarithmic};
  for (const std::string element : {"beam", "rotation-free", "shell"}) {
    const Line& line = line_of(lines, "own weight, large", element);
    ChartSeries series;
    series.label = element;
    for (const auto& cost : costs)
      for (std::size_t k = 0; k < line.cells.size(); ++k) {
        if (cost.element != element || cost.along != line.cells[k]) continue;
        series.x.push_back(cost.wall_per_second());
        series.y.push_back(line.error[k]);
      }
    chart.series.push_back(series);
  }
  return chart;
}

}  // namespace

int main(int count, char** arguments) {
  const std::filesystem::path folder = count > 1 ? arguments[1] : "docs/elements";
  const auto lines = measure_errors();
  const auto costs = measure_costs();
  std::filesystem::create_directories(folder);
  write_text_whole(folder / "closed_forms.csv", error_csv(lines));
  write_text_whole(folder / "time.csv", cost_csv(costs));
  write_charts({{folder / "error.svg", error_chart(lines)}, {folder / "time.svg", time_chart(lines, costs)}});
  fmt::print("{}\n{}", error_table(lines), cost_csv(costs));
}
