#include "app/stages/specimen_trials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/resolve/resolve.hpp"
#include "mesher/scene/reader.hpp"
#include "post/trust/inertia.hpp"
#include "solver/analysis/loading.hpp"
#include "solver/analysis/steered.hpp"
#include "solver/element/yarn_law.hpp"
#include "solver/result/fields.hpp"

namespace weaveform {
namespace {

using identify::SimulatedLoad;
using identify::SimulatedTest;
using identify::StressWeight;
using identify::TrialMesh;
using identify::TriedFabric;

constexpr std::array automatic_coarsenings = {4.0, 2.0, 1.0, 0.5, 0.25};
constexpr double enough_cells = 200.0, enough_cells_of_frame = 16.0;  // a frame's field is even
constexpr double least_coarse_cells = 45.0;
constexpr double inertia_allowed = 0.01;  // of the loads
constexpr int most_runs_for_duration = 3;
constexpr int history_rows = 400;  // of history: two or more in a window of one degree
constexpr int classes = 64;        // of strain, that weights are sorted into

// Travels, loads and, of each cell and yarn, what its energy hangs on; one entry a row of history.
struct Track {
  std::vector<double> travel, load;         // mm, N
  std::vector<std::vector<double>> sine;    // 1; |sin gamma| of each cell
  std::vector<std::vector<double>> strain;  // 1; of each yarn, where it is asked for
  std::vector<double> middle;               // rad; mean |angle| of the cells in the specimen's middle
};

double width_of(const SimulatedTest& test) {
  if (const auto* rectangle = std::get_if<BiasRectangle>(&test.specimen)) return rectangle->width;
  return std::get<ShearFrame>(test.specimen).fabric_length;
}

double flat_area(const SimulatedTest& test) {
  if (const auto* rectangle = std::get_if<BiasRectangle>(&test.specimen)) return rectangle->width * rectangle->length;
  return std::pow(width_of(test), 2);
}

std::array<double, 2> coarsening_of(const SimulatedTest& test, const Card& card,
                                    const std::optional<std::array<double, 2>>& asked) {
  if (asked) return *asked;
  const double cell = card.yarn[0].interval * card.yarn[1].interval;
  const double wanted = std::holds_alternative<ShearFrame>(test.specimen) ? enough_cells_of_frame : enough_cells;
  const auto enough =
      std::find_if(automatic_coarsenings.begin(), automatic_coarsenings.end() - 1,
                   [&](double coarsening) { return flat_area(test) >= wanted * cell * coarsening * coarsening; });
  return {*enough, *enough};
}

// Of the coarse mesh's cells, over the fine one's: as much as leaves a mesh.
double coarser_by(const SimulatedTest& test, const Card& card, const std::array<double, 2>& fine) {
  const double cell = card.yarn[0].interval * card.yarn[1].interval * fine[0] * fine[1];
  for (const double times : {2.0, 1.5})
    if (flat_area(test) >= least_coarse_cells * cell * times * times) return times;
  return 1.0;
}

std::string scene_text(const SimulatedTest& test, const std::array<double, 2>& coarsening) {
  const double travel = test.window.back()[1];
  if (const auto* rectangle = std::get_if<BiasRectangle>(&test.specimen))
    return fmt::format(
        "[blank]\nsize = [{}, {}]\nyarn_angle = 45.0\ncoarsening = [{}, {}]\n[[grip]]\nname = \"bottom\"\nedge = "
        "\"bottom\"\n"
        "travel = 0.0\n[[grip]]\nname = \"top\"\nedge = \"top\"\ntravel = {}\n[output]\nframes = 1\nhistory = {}\n",
        rectangle->width, rectangle->length, coarsening[0], coarsening[1], travel, history_rows);
  const auto& frame = std::get<ShearFrame>(test.specimen);
  return fmt::format(
      "[blank]\nsize = [{0}, {0}]\nyarn_angle = 0\norientation = 45\ncoarsening = [{1}, {2}]\n[model]\nyarn_law = "
      "\"linear\"\n"
      "yarn_stiffness_scale = 10.0\n[frame]\nlength = {3}\nrigid = true\ntravel = {4}\n[output]\nframes = 1\n"
      "history = {5}\n",
      frame.fabric_length, coarsening[0], coarsening[1], frame.frame_length, travel, history_rows);
}

// Cells in the middle: within an eighth of the free length of a bias extension, or a quarter of a frame's fabric.
std::vector<int> middle_cells(const SimulatedTest& test, const Mesh& mesh) {
  const auto* rectangle = std::get_if<BiasRectangle>(&test.specimen);
  const double reach = rectangle != nullptr ? rectangle->free_length() / 8.0 : width_of(test) / 4.0;
  std::vector<int> cells;
  int nearest = 0;
  double least = HUGE_VAL;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const Vec3 at = cell_centre(mesh.cells, cell, mesh.flat_positions());
    const double away = std::hypot(at[0], at[1]);
    if (away <= reach) cells.push_back(cell);
    if (away < least) least = away, nearest = cell;
  }
  if (cells.empty()) cells.push_back(nearest);
  return cells;
}

void record(const Steered& run, const World& world, const std::vector<int>& middle, bool with_yarns, Track& track) {
  const Resolved& model = run.model();
  const Fields fields =
      compute_fields(model.mesh, model.card, model.scene.model, world.time(), world.ply(0).whole_positions());
  std::vector<double> sine;
  for (const double angle : fields.shear_angle) sine.push_back(std::abs(std::sin(angle)));
  track.sine.push_back(std::move(sine));
  if (with_yarns) track.strain.push_back(fields.yarn_strain);
  double sum = 0.0;
  for (const int cell : middle) sum += std::abs(fields.shear_angle[static_cast<std::size_t>(cell)]);
  track.middle.push_back(sum / static_cast<double>(middle.size()));
}

// Steps to the end, and what is there at each row of the history.
Track tracked(Steered& run, const SimulatedTest& test, bool with_yarns) {
  Track track;
  const auto middle = middle_cells(test, run.model().mesh);
  while (!run.ended()) {
    run.step();
    if (run.history().row.size() > track.middle.size()) record(run, run.world(), middle, with_yarns, track);
  }
  const History& history = run.history();
  if (std::holds_alternative<ShearFrame>(test.specimen)) {
    track.travel = history.values("crosshead.displacement_mm");
    track.load = history.values("crosshead.force_N");
    return track;
  }
  track.travel = history.values("top.displacement_mm");
  track.load = history.values("top.force_N");
  const auto other = history.values("bottom.force_N");
  for (std::size_t i = 0; i < other.size(); ++i) track.load[i] = 0.5 * (track.load[i] + other[i]);
  return track;
}

// A place between two rows: (1 - share) of row - 1 and share of row.
struct Between {
  std::size_t row = 1;
  double share = 0.0;
  [[nodiscard]] double of(const std::vector<double>& values) const {
    return values[row - 1] + share * (values[row] - values[row - 1]);
  }
};

Between place_at(const std::vector<double>& travel, double at) {
  const auto after = std::upper_bound(travel.begin() + 1, travel.end() - 1, at);
  const auto row = static_cast<std::size_t>(after - travel.begin());
  const double way = travel[row] - travel[row - 1];
  return {row, way > 0.0 ? std::clamp((at - travel[row - 1]) / way, 0.0, 1.0) : 0.0};
}

// Weights in classes of strain; each goes to the two classes around it, so that sum and first moment are kept.
class WeightClasses {
public:
  explicit WeightClasses(double greatest) : width_(greatest / (classes - 1)), weight_(classes, 0.0) {}
  void add(double strain, double weight) {
    const auto below = std::min(static_cast<std::size_t>(strain / width_), weight_.size() - 2);
    const double share = strain / width_ - static_cast<double>(below);
    weight_[below] += (1.0 - share) * weight;
    weight_[below + 1] += share * weight;
  }
  [[nodiscard]] std::vector<StressWeight> weights() const {
    std::vector<StressWeight> all;
    for (std::size_t i = 0; i < weight_.size(); ++i)
      if (weight_[i] != 0.0) all.push_back({static_cast<double>(i) * width_, weight_[i]});
    return all;
  }

private:
  double width_;
  std::vector<double> weight_;
};

double greatest_strain_of(const Track& track) {
  double sine = 1e-6;
  for (const auto& row : track.sine) sine = std::max(sine, *std::max_element(row.begin(), row.end()));
  return std::atanh(std::min(sine, 1.0 - 1e-9));
}

// mm^2; V_c d|s_c|/dx at the cell's strain halfway, V_c = area t, of constant thickness with another cos gamma.
std::vector<StressWeight> stress_weights(const Resolved& model, const Track& track, const Between& from,
                                         const Between& to, double way, double greatest) {
  WeightClasses sorted(greatest);
  const bool constant = model.scene.model.thickness == Thickness::constant;
  for (std::size_t cell = 0; cell < track.sine.front().size(); ++cell) {
    const auto sine_at = [&](const Between& at) {
      const double below = track.sine[at.row - 1][cell];
      return below + at.share * (track.sine[at.row][cell] - below);
    };
    const double first = sine_at(from), last = sine_at(to), half = 0.5 * (first + last);
    const double volume =
        model.mesh.cells.area[cell] * model.mesh.thickness * (constant ? std::sqrt(1.0 - half * half) : 1.0);
    sorted.add(std::atanh(std::min(half, 1.0 - 1e-9)), volume * (last - first) / way);
  }
  return sorted.weights();
}

// mJ at each row: stored by the yarns with the laws of `card`, sum of A0 (L0 + jaw) integral of s de.
std::vector<double> yarn_energies(const Resolved& model, const Card& card, const Track& track) {
  const auto laws = yarn_laws(card, model.scene.model);
  const MeshYarns& yarns = model.mesh.yarns;
  std::vector<double> energies;
  for (const auto& strain : track.strain) {
    double sum = 0.0;
    for (std::size_t yarn = 0; yarn < strain.size(); ++yarn)
      sum += yarns.section[yarn] * yarns.softening[yarn] * (yarns.rest_length[yarn] + yarns.jaw[yarn]) *
             laws[static_cast<std::size_t>(yarns.family[yarn])].energy(strain[yarn]);
    energies.push_back(sum);
  }
  return energies;
}

std::vector<double> work_of(const Track& track) {
  std::vector<double> work = {0.0};
  for (std::size_t i = 1; i < track.travel.size(); ++i)
    work.push_back(work.back() + 0.5 * (track.load[i] + track.load[i - 1]) * (track.travel[i] - track.travel[i - 1]));
  return work;
}

std::vector<SimulatedLoad> loads_of(const Resolved& model, const Track& track, const SimulatedTest& test,
                                    const TriedFabric& fabric) {
  const double greatest = greatest_strain_of(track);
  const auto work = work_of(track);
  std::array<std::vector<double>, 2> stored;
  for (std::size_t i = 0; fabric.decrimped && i < 2; ++i)
    stored[i] = yarn_energies(model, (*fabric.decrimped)[i], track);
  std::vector<SimulatedLoad> loads;
  for (const auto& window : test.window) {
    const Between from = place_at(track.travel, window[0]), to = place_at(track.travel, window[1]);
    const double way = window[1] - window[0];
    const auto rise = [&](const std::vector<double>& values) { return (to.of(values) - from.of(values)) / way; };
    SimulatedLoad load;
    load.load = rise(work);
    load.angle = place_at(track.travel, 0.5 * (window[0] + window[1])).of(track.middle);
    load.weight = stress_weights(model, track, from, to, way, greatest);
    if (fabric.decrimped) load.decrimping = (rise(stored[1]) - rise(stored[0])) / (2.0 * fabric.step);
    loads.push_back(std::move(load));
  }
  return loads;
}

}  // namespace

SpecimenTrials::SpecimenTrials(const identify::FitSpec& spec) : file_(spec.file), how_(spec.simulation) {
  const bool frame = spec.shear.from != identify::ShearSource::bias_extension && !spec.shear_frame.empty();
  SimulatedTest test{.number = 0, .specimen = BiasRectangle{100.0, 200.0}, .window = {{0.0, 10.0}}};
  if (frame) test.specimen = ShearFrame{200.0, 140.0};
  const Scene scene = scene_of(test, {1.0, 1.0});  // only for its complaints
  if (how_.decrimping && scene.model.yarn_law != YarnLaw::card)
    throw InputError(
        fmt::format("{}: 'decrimping' is sought of yarns that do not decrimp; leave model.yarn_law out of "
                    "'settings' of [simulation]",
                    file_));
}

Scene SpecimenTrials::scene_of(const SimulatedTest& test, const std::array<double, 2>& coarsening) const {
  return read_scene_text(scene_text(test, coarsening), file_ + " (the simulated test)", how_.settings);
}

identify::SimulatedCurve SpecimenTrials::run(const SimulatedTest& test, const TriedFabric& fabric, TrialMesh mesh) {
  identify::SimulatedCurve curve;
  curve.coarsening = coarsening_of(test, fabric.card, how_.coarsening);
  const double coarser = coarser_by(test, fabric.card, curve.coarsening);
  if (mesh == TrialMesh::coarse)
    for (double& coarsening : curve.coarsening) coarsening *= coarser;
  Scene scene = scene_of(test, curve.coarsening);
  const bool chosen_by_hand = scene.analysis.duration || scene.analysis.loading_speed;
  const auto known = duration_.find(test.number);
  if (known != duration_.end()) scene.analysis.duration = known->second;
  for (;;) {
    const Resolved model = resolve_around(scene, fabric.card, build_mesh(scene, fabric.card));
    const Loading loading = choose_loading(model);
    Steered steered(model, 1);
    const Track track = tracked(steered, test, fabric.decrimped.has_value());
    ++curve.runs;
    curve.cells = model.mesh.cells.size();
    curve.duration = loading.duration;
    curve.inertia = std::abs(inertia_share(model.scene, steered.history(), loading.damping).share);
    const bool slow = chosen_by_hand || known != duration_.end() || curve.inertia <= inertia_allowed ||
                      curve.runs == most_runs_for_duration;
    if (slow) {
      if (!chosen_by_hand) duration_[test.number] = loading.duration;
      curve.at = loads_of(model, track, test, fabric);
      return curve;
    }
    scene.analysis.duration = loading.duration * std::sqrt(curve.inertia / (0.8 * inertia_allowed));
  }
}

}  // namespace weaveform
