#include "post/dic/comparison/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/keys/toml_document.hpp"
#include "core/missing.hpp"
#include "fabric/identify/raw_table.hpp"
#include "fabric/identify/unit.hpp"
#include "post/dic/comparison/output.hpp"
#include "post/dic/virtual/step_width.hpp"

namespace weaveform::dic {
namespace {

namespace fs = std::filesystem;

// Asks for the travel or load of the k-th stage when neither its file nor the settings tell it.
void ask_state(const StagesSpec& spec, std::size_t k, const MeasuredStage& stage, Questions& questions) {
  if (spec.match == MatchBy::frame) return;
  const bool by_force = spec.match == MatchBy::force;
  const auto& list = by_force ? spec.force : spec.displacement;
  if (k < list.size() || (by_force ? stage.force : stage.displacement)) return;
  ask(questions, {fmt::format("{}: at which {} was this stage taken? the file does not tell;", stage.label,
                              by_force ? "load (N)" : "travel of the crosshead (mm)"),
                  by_force ? "stages.force" : "stages.displacement",
                  fmt::format("[{}]", by_force ? "LOAD_OF_EACH_STAGE" : "TRAVEL_OF_EACH_STAGE")});
}

// Which simulated state belongs to the k-th stage.
class StageMatch {
public:
  StageMatch(const Simulation& simulation, const StagesSpec& spec) : simulation_(simulation), spec_(spec) {}

  [[nodiscard]] SimulatedState state(std::size_t k, const MeasuredStage& stage) const {
    if (spec_.match == MatchBy::frame) {
      if (k + 1 >= simulation_.frame_count())
        throw InputError(
            fmt::format("{}: is stage {}, but the simulation has {} frames after the start; set match of "
                        "[stages] to \"displacement\" or \"force\"",
                        stage.label, k + 1, simulation_.frame_count() - 1));
      return simulation_.at_frame(k + 1);
    }
    const bool by_force = spec_.match == MatchBy::force;
    const auto& list = by_force ? spec_.force : spec_.displacement;
    std::optional<double> value = by_force ? stage.force : stage.displacement;
    if (!list.empty()) {
      if (k >= list.size())
        throw InputError(fmt::format("{}: is stage {}, but [stages] lists {} value(s); give one for each stage",
                                     stage.label, k + 1, list.size()));
      value = list[k];
    }
    if (!value) {
      Questions questions;
      ask_state(spec_, k, stage, questions);
      throw_if_asked(questions);
    }
    return by_force ? simulation_.at_force(*value, stage.label) : simulation_.at_travel(*value, stage.label);
  }

  void check_count(std::size_t stages) const {
    for (const auto* list : {&spec_.displacement, &spec_.force})
      if (!list->empty() && list->size() != stages)
        throw InputError(
            fmt::format("[stages] lists {} value(s), but the measurement has {} stage(s); give one for each",
                        list->size(), stages));
  }

private:
  const Simulation& simulation_;
  const StagesSpec& spec_;
};

// The stage the measurement is placed by: the one with the greatest displacement, which the last file is taken to hold
// (its travel is known only with the file, and files are read one at a time).
struct Anchor {
  MeasuredStage stage;
  std::size_t index;
};

Anchor last_stage(const std::vector<fs::path>& files, const Settings& settings) {
  auto stages = read_stages_asking(files.back(), settings.measurement);
  std::size_t before = 0;
  // With a stage column a file holds any number of stages; otherwise one.
  if (!settings.measurement.stage_column.empty())
    for (std::size_t f = 0; f + 1 < files.size(); ++f)
      before += read_stages_asking(files[f], settings.measurement).size();
  else
    before = files.size() - 1;
  return {std::move(stages.back()), before + stages.size() - 1};
}

// What the stage's own file leaves open, then what the comparison needs beside it.
Questions open_questions(const Anchor& anchor, const Settings& settings) {
  Questions questions = anchor.stage.questions;
  ask_instrument(settings.instrument, anchor.stage, questions);
  ask_state(settings.stages, anchor.index, anchor.stage, questions);
  return questions;
}

LineProfile profile_of(const LineSpec& spec, const StageFields& fields, const Instrument& instrument) {
  LineProfile line;
  line.name = spec.name;
  const FieldAt at(fields.points->point, instrument.step);
  const double length = std::hypot(spec.to[0] - spec.from[0], spec.to[1] - spec.from[1]);
  for (int k = 0; k < spec.points; ++k) {
    const double share = static_cast<double>(k) / (spec.points - 1);
    const Vec2 place = {spec.from[0] + share * (spec.to[0] - spec.from[0]),
                        spec.from[1] + share * (spec.to[1] - spec.from[1])};
    line.distance.push_back(share * length);
    line.place.push_back(place);
    line.measured.push_back(at(place, fields.measured));
    line.levelled.push_back(at(place, fields.levelled));
    line.raw.push_back(at(place, fields.raw));
  }
  line.measured_width = step_width(line.distance, line.measured);
  line.levelled_width = step_width(line.distance, line.levelled);
  line.raw_width = step_width(line.distance, line.raw);
  return line;
}

struct MeasuredLoad {
  std::vector<double> travel, force;  // mm, N; travel rising
};

MeasuredLoad read_load(const LoadSpec& spec, const std::string& settings_file) {
  const fs::path file = fs::path(settings_file).parent_path() / spec.file;
  const auto table = identify::read_raw_table(read_text_file(file), file.string(), {});
  auto travel =
      identify::numbers_of(table, identify::column_of(table, spec.displacement_column, "displacement_column"));
  auto force = identify::numbers_of(table, identify::column_of(table, spec.force_column, "force_column"));
  const double travel_factor = identify::unit_factor(identify::Quantity::length, spec.displacement_unit);
  const double force_factor = identify::unit_factor(identify::Quantity::force, spec.force_unit);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < travel.size(); ++i)
    if (std::isfinite(travel[i]) && std::isfinite(force[i])) order.push_back(i);
  if (order.size() < 2) throw InputError(fmt::format("{}: has fewer than two rows of numbers", file.string()));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return travel[a] < travel[b]; });
  MeasuredLoad load;
  for (const std::size_t i : order) {
    load.travel.push_back(travel_factor * travel[i]);
    load.force.push_back(force_factor * force[i]);
  }
  return load;
}

// Both curves at the simulation's rows.
LoadCurve overlay(const Simulation& simulation, const MeasuredLoad& measured) {
  LoadCurve curve;
  curve.measured_end = measured.travel.back();
  double product = 0.0, square = 0.0, sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < simulation.travel().size(); ++i) {
    const double travel = simulation.travel()[i], simulated = simulation.force()[i];
    const bool covered = travel >= measured.travel.front() && travel <= measured.travel.back();
    const double force = covered ? interpolated(measured.travel, measured.force, travel) : missing;
    curve.travel.push_back(travel);
    curve.simulated.push_back(simulated);
    curve.measured.push_back(force);
    if (!covered) continue;
    product += force * simulated;
    square += simulated * simulated;
    sum += (force - simulated) * (force - simulated);
    ++count;
  }
  curve.rms = count > 0 ? std::sqrt(sum / count) : missing;
  curve.ratio = product / square;
  return curve;
}

class Run {
public:
  Run(const fs::path& result, const std::vector<std::string>& measurement, const Settings& settings,
      const fs::path& output)
      : settings_(settings),
        output_(output),
        simulation_(result, settings.stages.grip, settings.instrument.ply),
        match_(simulation_, settings.stages),
        files_(measurement_files(measurement)),
        yarns_(yarn_directions(simulation_.scene().blank)) {
    comparison_.result = result;
    for (const auto& file : files_) comparison_.files.push_back(file.string());
    comparison_.grip = simulation_.grip();
    comparison_.ply = simulation_.ply();
    comparison_.coverage = settings.comparison.coverage;
    comparison_.symmetry = settings.comparison.symmetry;
  }

  Comparison run() {
    if (!settings_.load.file.empty()) load_ = read_load(settings_.load, settings_.file);
    if (settings_.measurement.stage_column.empty()) match_.check_count(files_.size());
    {
      const Anchor anchor = last_stage(files_, settings_);
      throw_if_asked(open_questions(anchor, settings_));
      match_.check_count(anchor.index + 1);
      comparison_.instrument = settle_instrument(settings_.instrument, anchor.stage);
      comparison_.placement = place(anchor.stage, simulation_, match_.state(anchor.index, anchor.stage),
                                    settings_.registration, comparison_.instrument.facet_size);
      last_ = anchor.index;
    }
    remove_files(output_, comparison_files());
    std::size_t k = 0;
    for (const auto& file : files_)
      for (const MeasuredStage& stage : read_stages(file, settings_.measurement)) one_stage(k++, stage);
    if (load_) comparison_.load = overlay(simulation_, *load_);
    write_report(comparison_, output_);
    return std::move(comparison_);
  }

private:
  void one_stage(std::size_t k, const MeasuredStage& stage) {
    const SimulatedState state = match_.state(k, stage);
    const Placement& placement = comparison_.placement;
    RigidMotion current = placement.current;
    if (settings_.registration.motion == SpecimenMotion::free && stage.gradient.empty())
      current = follow(stage, simulation_, state, placement.reference, settings_.registration.reject);
    auto points = make_points(stage, placement.reference, simulation_, comparison_.instrument, points_);
    if (points != points_) triangles_.clear();
    points_ = points;
    StageFields fields = compare_stage(stage, current, points_, simulation_, state, comparison_.instrument);
    average_mirror_images(settings_.comparison.symmetry, simulation_.scene().blank, comparison_.instrument, fields);

    ComparedStage compared;
    compared.label = stage.label;
    compared.travel = state.travel;
    compared.simulated_force = state.force;
    compared.measured_force = stage.force;
    if (k < settings_.stages.force.size()) compared.measured_force = settings_.stages.force[k];
    if (!compared.measured_force && load_ && state.travel <= load_->travel.back() &&
        state.travel >= load_->travel.front())
      compared.measured_force = interpolated(load_->travel, load_->force, state.travel);
    compared.points = static_cast<int>(stage.size());
    compared.missing = stage.missing;
    compared.failed = stage.failed;
    compared.displacement_uncertainty = fields.displacement_uncertainty;
    compared.estimated = fields.estimated;
    compared.current = current;
    compared.notes = stage.notes;
    std::vector<int> every(stage.size());
    std::iota(every.begin(), every.end(), 0);
    compared.all = field_statistics("all", fields, every, comparison_.coverage, yarns_);
    if (compared.all.points == 0)
      throw InputError(
          fmt::format("{}: no point could be compared: does the measurement lie on the blank? see the "
                      "placement, or give marks or axes in [registration]",
                      stage.label));
    const Zones zones = zones_of_points(simulation_.scene(), settings_.zone, points_->point);
    for (std::size_t z = 0; z < zones.name.size(); ++z)
      compared.zone.push_back(field_statistics(zones.name[z], fields, zones.point[z], comparison_.coverage, yarns_));
    for (const LineSpec& line : settings_.line)
      compared.line.push_back(profile_of(line, fields, comparison_.instrument));
    compared.verdict = judge(compared.all, compared.zone);
    write_fields(k, fields);
    comparison_.stage.push_back(std::move(compared));
  }

  void write_fields(std::size_t k, const StageFields& fields) {
    const FieldsWritten which = settings_.comparison.fields;
    if (which == FieldsWritten::none || (which == FieldsWritten::last && k != last_)) return;
    // A diagonal of the grid with one point missing.
    if (triangles_.empty()) triangles_ = triangulate(points_->point, 2.3 * comparison_.instrument.step);
    const fs::path stem = output_ / file_name::stage_fields / fmt::format("stage_{:03}", k + 1);
    write_points_csv(fields, comparison_.coverage, stem.string() + ".csv");
    write_points_vtu(fields, triangles_, comparison_.coverage, stem.string() + ".vtu");
    write_isolines(fields, triangles_, settings_.comparison.contour_step, stem.string() + "_isolines.vtp");
  }

  const Settings& settings_;
  fs::path output_;
  Simulation simulation_;
  StageMatch match_;
  std::vector<fs::path> files_;
  YarnDirections yarns_;
  Comparison comparison_;
  std::optional<MeasuredLoad> load_;
  std::shared_ptr<const PointSet> points_;
  std::vector<std::array<int, 3>> triangles_;
  std::size_t last_ = 0;
};

}  // namespace

FileNames comparison_files() {
  return joined({{file_name::comparison, file_name::stage_table, file_name::line_table, file_name::load_table,
                  file_name::load_chart, file_name::angle_chart},
                 below(file_name::stage_fields, {"stage_###.csv", "stage_###.vtu", "stage_###_isolines.vtp"})});
}

Questions questions_of(const std::vector<std::string>& measurement, const Settings& settings) {
  return open_questions(last_stage(measurement_files(measurement), settings), settings);
}

Comparison compare(const fs::path& result, const std::vector<std::string>& measurement, const Settings& settings,
                   const fs::path& output) {
  return Run(result, measurement, settings, output).run();
}

}  // namespace weaveform::dic
