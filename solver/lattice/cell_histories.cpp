#include "solver/lattice/cell_histories.hpp"

#include "solver/element/sheared_start.hpp"

namespace weaveform {
namespace {

CellHistories with_directions(const PackedMesh& packed, const State& start) {
  CellHistories histories;
  histories.lattice.allocate(packed.lattice_nodes());
  histories.listed.allocate(packed.loose_cells.size());
  for (int c = 0; c < 3; ++c) {
    const double* x = start.position[c].data();
    for (int j = 0; j + 1 < packed.rows; ++j)
      for (int r = packed.cell_runs.first[j]; r < packed.cell_runs.first[j + 1]; ++r)
        for (int i = packed.cell_runs.run[r].begin; i < packed.cell_runs.run[r].end; ++i) {
          const int n = j * packed.stride + i, up = n + packed.stride;
          histories.lattice.current()[c][n] = 0.5 * (x[n + 1] - x[n] + x[up + 1] - x[up]) / packed.spacing[0];
          histories.lattice.current()[3 + c][n] = 0.5 * (x[up] - x[n] + x[up + 1] - x[n + 1]) / packed.spacing[1];
        }
    const auto& loose = packed.loose_cells;
    for (int e = 0; e < loose.size(); ++e)
      for (int a = 0; a < LooseCells::width; ++a) {
        histories.listed.current()[c][e] += loose.warp_coefficient[e][a] * x[loose.node[e][a]];
        histories.listed.current()[3 + c][e] += loose.weft_coefficient[e][a] * x[loose.node[e][a]];
      }
  }
  return histories;
}

template <class Law>
void give_stress(CellHistories& histories, const PackedMesh& packed, const Law& law, const ModelSpec& model,
                 double thickness) {
  const bool side = model.formulation == Formulation::side_frame, constant = model.thickness == Thickness::constant;
  const auto start_cell = [&](std::array<Doubles, cell_history_size>& store, std::size_t n, double volume) {
    const double g1[3] = {store[0][n], store[1][n], store[2][n]}, g2[3] = {store[3][n], store[4][n], store[5][n]};
    CellHistory h{};
    if (side)
      h = constant ? sheared_start<Frame::side, Thickness::constant>(law, g1, g2, volume)
                   : sheared_start<Frame::side, Thickness::constant_volume>(law, g1, g2, volume);
    else
      h = constant ? sheared_start<Frame::green_naghdi, Thickness::constant>(law, g1, g2, volume)
                   : sheared_start<Frame::green_naghdi, Thickness::constant_volume>(law, g1, g2, volume);
    const double value[5] = {h.stress1, h.stress2, h.stress4, h.strain, h.work};
    for (int k = 0; k < 5; ++k) store[6 + k][n] = value[k];
  };
  for (int j = 0; j + 1 < packed.rows; ++j)
    for (int r = packed.cell_runs.first[j]; r < packed.cell_runs.first[j + 1]; ++r)
      for (int i = packed.cell_runs.run[r].begin; i < packed.cell_runs.run[r].end; ++i) {
        const auto n = static_cast<std::size_t>(j) * packed.stride + i;
        start_cell(histories.lattice.current(), n, packed.cell_area[n] * thickness);
      }
  for (int e = 0; e < packed.loose_cells.size(); ++e)
    start_cell(histories.listed.current(), static_cast<std::size_t>(e), packed.loose_cells.area[e] * thickness);
}

}  // namespace

CellHistories start_histories(const PackedMesh& packed, const ShearLawShape& shear, const ModelSpec& model,
                              double thickness, const State& start) {
  CellHistories histories = with_directions(packed, start);
  if (shear.shape == ShearShape::general)
    give_stress(histories, packed, shear.general, model, thickness);
  else
    give_stress(histories, packed, shear.started, model, thickness);
  return histories;
}

}  // namespace weaveform
