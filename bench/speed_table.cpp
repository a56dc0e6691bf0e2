// `./dev bench --speed` writes docs/speed.md: rates of the analysis beside those of a plain loop (plain_loop.hpp), all
// measured in one run and in turn, so that a machine that grows slower slows all of them; medians over the rounds.
//
//   usage: weaveform_speed_table FILE.md [ROUNDS]
//          weaveform_speed_table --rates            of the cases for the table of instruction sets, for the program itself
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "bench/machine_peak.hpp"
#include "bench/plain_loop.hpp"
#include "bench/rippled_lattice.hpp"
#include "bench/step_costs.hpp"
#include "core/files/files.hpp"
#include "core/guard/run_program.hpp"
#include "core/version/version.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/scene/reader.hpp"
#include "solver/solve.hpp"

namespace {

using namespace weaveform;

constexpr double window = 0.25;  // s; of one measurement of a lattice
constexpr double step = 1e-7;    // s; well below the stable step

// Seconds and cell-steps of one measurement.
struct Measured {
  double seconds = 0.0, cell_steps = 0.0;
  long steps = 0;
};

struct Case {
  std::string name;
  int cells = 0;
  bool whole = false;  // a scene from its start to its end, whose steps and seconds are told
  std::function<Measured(int threads)> run;
  std::vector<double> rate[2] = {};  // M cell-steps/s; one thread, two
  std::vector<double> seconds[2] = {};
  long steps = 0;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

// The same lattice for one thread and for two.
struct Lattice {
  Team one{1}, two{2};
  RippledLattice of[2];

  Lattice(int cells, double yarn_angle, const ModelSpec& model, Precision precision, double height)
      : of{{cells, yarn_angle, model, one, precision, height}, {cells, yarn_angle, model, two, precision, height}} {
    for (auto& lattice : of) {
      (void)lattice.ply->renew_stable_step();
      lattice.ply->compute_forces(step);
    }
  }

  Measured run(int threads) {
    using Clock = std::chrono::steady_clock;
    Measured measured;
    for (const auto begin = Clock::now(); measured.seconds < window;
         measured.seconds = std::chrono::duration<double>(Clock::now() - begin).count())
      for (int k = 0; k < 4; ++k, ++measured.steps) of[threads - 1].make_step(step);
    measured.cell_steps = static_cast<double>(measured.steps) * of[0].mesh.cells.size();
    return measured;
  }
};

Case lattice_case(const std::string& name, int cells, double angle, const ModelSpec& model = {},
                  Precision precision = Precision::double_precision, double height = 0.3) {
  const auto lattice = std::make_shared<Lattice>(cells, angle, model, precision, height);
  return {.name = name, .cells = lattice->of[0].mesh.cells.size(), .run = [lattice](int t) { return lattice->run(t); }};
}

// An example's whole solve in memory, without frames; the cells counted are those that symmetry leaves to solve.
Case scene_case(const std::string& name, const std::string& example, std::vector<std::string> overrides) {
  overrides.emplace_back("output.frames=0");
  const auto scene = std::make_shared<Scene>(
      read_scene(std::string(WEAVEFORM_SOURCE_DIR) + "/examples/" + example + ".toml", overrides));
  const auto card = std::make_shared<Card>(load_card(scene->fabric.material, scene->file));
  const auto mesh = std::make_shared<Mesh>(build_mesh(*scene, *card));
  Case result{.name = name, .whole = true, .run = [=](int threads) {
                const SolveResult solved =
                    solve(*mesh, *scene, *card, {}, {.threads = threads, .resume = false, .quiet = true});
                const auto& s = solved.statistics;
                return Measured{s.wall_s, static_cast<double>(s.steps) * s.cells_solved, s.steps};
              }};
  result.cells = mesh->cells.size();
  return result;
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  constexpr Precision single = Precision::single_precision;
  for (const int n : {30, 100, 400, 1000}) {
    cases.push_back(lattice_case(fmt::format("flat {}²", n), n, 0.0));
    cases.push_back(lattice_case(fmt::format("flat {}², single precision", n), n, 0.0, {}, single));
  }
  cases.push_back(lattice_case("flat 100², in its plane", 100, 0.0, {}, Precision::double_precision, 0.0));
  for (const int n : {26, 100}) {
    cases.push_back(lattice_case(fmt::format("cut at 45°, side of {} cells", n), n, 45.0));
    cases.push_back(
        lattice_case(fmt::format("cut at 45°, side of {} cells, single precision", n), n, 45.0, {}, single));
  }
  ModelSpec beams, rotation_free;
  beams.yarn = YarnElement::beam;
  rotation_free.cell = CellElement::rotation_free;
  cases.push_back(lattice_case("flat 100², beams", 100, 0.0, beams));
  cases.push_back(lattice_case("flat 100², rotation-free cells", 100, 0.0, rotation_free));
  cases.push_back(scene_case("bias extension PW, coarsening 1", "bias_extension_pw", {}));
  cases.push_back(scene_case("bias extension PW, coarsening 1, single precision", "bias_extension_pw",
                             {"analysis.precision=single"}));
  cases.push_back(scene_case("hemisphere, fast scene (coarsening 2)", "hemisphere_pw_fast", {}));
  cases.push_back(scene_case("hemisphere, fast scene, coarsening 0.5", "hemisphere_pw_fast",
                             {"blank.coarsening=0.5", "tools.punch.travel=10", "analysis.duration=0.01",
                              "output.history=17"}));  // a sixth of the scene, and of its rows
  cases.push_back(scene_case("hemisphere, plain scene, coarsening 2", "hemisphere_pw",
                             {"blank.coarsening=2", "analysis.duration=0.4",  // as docs/speed.md has it
                              "tools.punch.speed=[[0,0],[0.5,0.15],[0.75,1],[0.9,1],[1,0]]"}));
  return cases;
}

std::string table(const std::vector<Case>& cases, double mark) {
  std::string text =
      "| | cells | 1 thread, M cell-steps/s | to the mark | 2 threads to 1 | steps | solve, s |\n"
      "|---|---:|---:|---:|---:|---:|---:|\n";
  for (const Case& one : cases) {
    const double rate = median(one.rate[0]), both = median(one.rate[1]);
    text += fmt::format("| {} | {} | {:.1f} | {:.2f} | {:.2f} | {} | {} |\n", one.name, one.cells, rate, rate / mark,
                        both / rate, one.whole ? fmt::format("{}", one.steps) : "",
                        one.whole ? fmt::format("{:.3f}, {:.3f}", median(one.seconds[0]), median(one.seconds[1])) : "");
  }
  return text;
}

double rate_of(const std::vector<Case>& cases, const std::string& name) {
  for (const Case& one : cases)
    if (one.name == name) return median(one.rate[0]);
  return 0.0;
}

// What a cell-step needs, what the machine gives at best, and how near the loop comes to it.
std::string limits(const std::vector<Case>& cases) {
  const Operations step_needs = operations_of_a_cell_step();
  const double flops = step_needs.sums + step_needs.products, divisions = step_needs.divisions;
  const double arithmetic = arithmetic_rate(window), division = division_rate(window);
  constexpr long cached = 20'000, large = 20'000'000;  // doubles of an array: in the second cache, in none
  const double from_cache = memory_rate(cached, window), from_memory = memory_rate(large, 4.0 * window);
  const double least = flops / arithmetic + divisions / division;  // ns
  const double small = rate_of(cases, "flat 100²"), big = rate_of(cases, "flat 1000²");
  return fmt::format(
      "A cell-step is {:.0f} sums and products, {:.0f} divisions and {:.0f} choices, counted by running the element "
      "bodies\nwith a number that counts (`bench/counted.hpp`), and moves {:.0f} bytes at least ({:.0f} where forces "
      "and motion are two\npasses). One core of this machine does {:.1f} G sums and products a second in the same "
      "shares, not fused, or {:.2f} G\ndivisions, from registers; and moves {:.1f} GB/s in its second cache, {:.1f} "
      "GB/s in memory.\n\n"
      "| | of the loop, a second | at best | share |\n|---|---:|---:|---:|\n"
      "| flat 100²: arithmetic, divisions apart | {:.1f} G | {:.1f} G | {:.2f} |\n"
      "| flat 100²: time of its arithmetic and divisions | {:.1f} ns a cell-step | {:.1f} ns | {:.2f} |\n"
      "| flat 1000²: bytes | {:.1f} GB | {:.1f} GB | {:.2f} |\n",
      flops, divisions, step_needs.choices, bytes_of_a_cell_step, bytes_in_two_passes, arithmetic, division, from_cache,
      from_memory, 1e-3 * small * flops, arithmetic, 1e-3 * small * flops / arithmetic, 1e3 / small, least,
      least * small * 1e-3, 1e-3 * big * bytes_of_a_cell_step, from_memory,
      1e-3 * big * bytes_of_a_cell_step / from_memory);
}

// Of one thread, M cell-steps/s, median of three: flat 100² in double and in single precision, and 760 cells cut at 45°.
std::vector<double> rates_of_sets() {
  std::vector<double> rates;
  std::vector<Case> cases;
  cases.push_back(lattice_case("flat", 100, 0.0));
  cases.push_back(lattice_case("single", 100, 0.0, {}, Precision::single_precision));
  cases.push_back(lattice_case("cut", 26, 45.0));
  for (const Case& one : cases) {
    std::vector<double> found;
    for (int round = 0; round < 3; ++round) {
      const Measured measured = one.run(1);
      found.push_back(1e-6 * measured.cell_steps / measured.seconds);
    }
    rates.push_back(median(found));
  }
  return rates;
}

// A program has one instruction set for as long as it runs: each is asked of another one.
std::string sets_table(const std::string& self, double mark) {
  std::string text =
      "The same program on processors with less (to the same mark, which is compiled for this one):\n\n"
      "| instruction set | flat 100² | in single precision | cut at 45°, 760 cells |\n|---|---:|---:|---:|\n";
  for (const char* set : {"avx512", "avx2", "sse2"}) {
    const ProgramEnd end = run_program({"env", fmt::format("WEAVEFORM_INSTRUCTIONS={}", set), self, "--rates"}, "",
                                       "rates of an instruction set cannot be measured", "coreutils");
    if (end.exit_code != 0) continue;  // a set that this processor or this build does not have
    text += fmt::format("| {} |", set);
    std::istringstream rates(end.output);
    for (double rate = 0.0; rates >> rate;) text += fmt::format(" {:.2f} |", rate / mark);
    text += "\n";
  }
  return text;
}

int write_table(const std::string& self, const std::filesystem::path& file, int rounds) {
  std::vector<Case> cases = all_cases();
  const std::vector<int> plain_size = {100, 400, 1000};
  std::vector<std::vector<double>> plain(plain_size.size()), plain_single(plain_size.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < plain_size.size(); ++k) {
      plain[k].push_back(plain_loop_rate<double>(plain_size[k], window));
      plain_single[k].push_back(plain_loop_rate<float>(plain_size[k], window));
    }
    for (Case& one : cases)
      for (int t = 0; t < 2; ++t) {
        const Measured found = one.run(t + 1);
        one.rate[t].push_back(1e-6 * found.cell_steps / found.seconds);
        one.seconds[t].push_back(found.seconds);
        if (one.whole) one.steps = found.steps;
      }
    fmt::print(stderr, "round {} of {}\n", round + 1, rounds);
  }
  const double mark = median(plain[0]);
  std::string text = fmt::format(
      "# Rates\n\n"
      "Written by `./dev bench --speed` (medians of {} rounds in turn, one run; {}). A cell-step is one cell, its two\n"
      "yarns and one node in one step. The mark is a plain loop over a structured trellis in double precision at 100²\n"
      "(`bench/plain_loop.cpp`: one card, relaxed floating point, no grips, contact, viscosity, energies or checks).\n"
      "Scenes are whole solves in memory, without frames, and count the cells that symmetry leaves to solve.\n\n"
      "Rates of machines differ and so do those of one machine from hour to hour; ratios within one run are what to "
      "look at.\n\n"
      "| plain loop | double, M cell-steps/s | to the mark | single | to the mark |\n|---|---:|---:|---:|---:|\n",
      rounds, version_line());
  for (std::size_t k = 0; k < plain_size.size(); ++k)
    text += fmt::format("| {}² | {:.1f} | {:.2f} | {:.1f} | {:.2f} |\n", plain_size[k], median(plain[k]),
                        median(plain[k]) / mark, median(plain_single[k]), median(plain_single[k]) / mark);
  text += "\n" + table(cases, mark) + "\n" + sets_table(self, mark) + "\n" + limits(cases);
  write_text_whole(file, text);
  std::fputs(text.c_str(), stdout);
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2) {
    std::fputs("usage: weaveform_speed_table FILE.md [ROUNDS]\n", stderr);
    return 2;
  }
  if (std::string(arguments[1]) == "--rates") {
    for (const double rate : rates_of_sets()) fmt::print("{}\n", rate);
    return 0;
  }
  return write_table(arguments[0], arguments[1], count > 2 ? std::max(1, std::atoi(arguments[2])) : 5);
}
