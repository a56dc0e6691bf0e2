#include "solver/bending/friction_state.hpp"

namespace weaveform {
namespace {

constexpr Bounds share_bounds = {.least = -1.001, .greatest = 1.001};  // with what rounding leaves

YarnFriction of_yarn(const BendingFriction& out, const BendingFriction& in) {
  const double rise = out.moment > 0.0 ? out.rise : in.moment > 0.0 ? in.rise : 1.0;
  return {.out = out.moment, .in = in.moment, .rise = rise};
}

}  // namespace

double stiffest_friction(const BendingFriction& friction) {
  return friction.moment > 0.0 ? 2.0 * friction.moment / friction.rise : 0.0;
}

FrictionColumns::FrictionColumns(int bends) {
  for (auto* field : {&phi, &curvature})
    for (auto& family : *field)
      for (auto& part : family) part.assign(bends, 0.0);
}

BendFrictionView FrictionColumns::at(std::size_t offset) {
  BendFrictionView state{};
  for (int f = 0; f < 2; ++f)
    for (int part = 0; part < 2; ++part) {
      state.phi[f][part] = phi[f][part].data() + offset;
      state.curvature[f][part] = curvature[f][part].data() + offset;
    }
  return state;
}

void FrictionColumns::archive(Archive& archive) {
  for (int f = 0; f < 2; ++f)
    for (int part = 0; part < 2; ++part) {
      archive.numbers("a share of friction in bending", phi[f][part], share_bounds);
      archive.numbers("a curvature", curvature[f][part]);
    }
}

bool FrictionLaws::any() const {
  for (const auto& law : yarn)
    if (law.out > 0.0 || law.in > 0.0) return true;
  return false;
}

std::array<std::vector<double>, 2> FrictionLaws::stored(const std::array<const std::vector<double>*, 2>& yarns,
                                                        const FrictionColumns& columns) const {
  std::array<std::vector<double>, 2> result;
  for (int f = 0; f < 2; ++f)
    for (std::size_t k = 0; k < yarns[f]->size(); ++k) {
      const double out = columns.phi[f][0][k], in = columns.phi[f][1][k];
      result[f].push_back((*yarns[f])[k] * 0.5 * yarn[f].rise * (yarn[f].out * out * out + yarn[f].in * in * in));
    }
  return result;
}

FrictionLaws friction_laws(const Flexure& flexure) {
  FrictionLaws laws;
  for (int f = 0; f < 2; ++f) laws.yarn[f] = of_yarn(flexure.friction_out_of_plane[f], flexure.friction_in_plane[f]);
  return laws;
}

FrictionOfBends::FrictionOfBends(const FrictionLaws& the_laws, int lattice_nodes, int row_count, int loose_bends)
    : laws(the_laws),
      rows(lattice_nodes),
      loose(loose_bends),
      lost(lattice_nodes, 0.0),
      lost_loose(loose_bends, 0.0),
      lost_of_row(row_count, 0.0) {}

double FrictionOfBends::lost_so_far() const {
  double sum = lost_by_loose;
  for (const double row : lost_of_row) sum += row;
  return sum;
}

void FrictionOfBends::archive(Archive& archive) {
  archive.flag("whether friction in bending began", begun);
  rows.archive(archive);
  loose.archive(archive);
  archive.numbers("a row's friction in bending", lost_of_row);
  archive.number("the loose bends' friction", lost_by_loose);
}

}  // namespace weaveform
