#include "solver/coupling/coupled_lattice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/error.hpp"

namespace weaveform {
namespace {

// By its two nodes, the lower first.
std::map<std::array<int, 2>, int> elements_that_tell(const MeshYarns& yarns) {
  std::map<std::array<int, 2>, int> element;
  for (int y = 0; y < static_cast<int>(yarns.node.size()); ++y) {
    if (yarns.softening[y] != 1.0 || yarns.jaw[y] != 0.0 || !(yarns.section[y] > 0.0)) continue;
    const auto [a, b] = yarns.node[y];
    element[{std::min(a, b), std::max(a, b)}] = y;
  }
  return element;
}

}  // namespace

CoupledLattice couple_lattice(const Mesh& mesh, const Card& card) {
  CoupledLattice lattice{
      .pair = {},
      .section_width = {card.yarn[0].section / card.yarn[0].interval, card.yarn[1].section / card.yarn[1].interval},
      .coupling = card.shear.tension_coupling};
  const auto element = elements_that_tell(mesh.yarns);
  for (int c = 0; c < mesh.cells.size(); ++c) {
    std::array<std::vector<int>, 2> around;
    const int begin = mesh.cells.offset[c], end = mesh.cells.offset[c + 1];
    for (int a = begin; a < end; ++a) {
      const int one = mesh.cells.node[a], next = mesh.cells.node[a + 1 < end ? a + 1 : begin];
      const auto found = element.find({std::min(one, next), std::max(one, next)});
      if (found != element.end())
        around[static_cast<std::size_t>(mesh.yarns.family[found->second])].push_back(found->second);
    }
    const double volume = mesh.cells.area[c] * mesh.thickness;
    for (std::size_t f = 0; f < around.size(); ++f) {
      for (const int y : around[f]) {
        const double part = 0.5 / static_cast<double>(around[f].size());
        const double share = lattice.coupling * lattice.section_width[f] * part * volume /
                             (mesh.yarns.section[y] * mesh.yarns.rest_length[y]);
        lattice.pair.push_back({c, y, part, share});
      }
    }
  }
  return lattice;
}

std::vector<double> shortenings(const CoupledLattice& lattice, const std::vector<double>& cell_energy,
                                std::size_t yarns) {
  std::vector<double> shortening(yarns, 0.0);
  for (const CoupledPair& pair : lattice.pair) shortening[pair.yarn] += pair.share * cell_energy[pair.cell];
  return shortening;
}

void require_coupling(const Card& card, const ModelSpec& model) {
  if (!(card.shear.tension_coupling > 0.0)) return;
  const auto refuse = [&](const std::string& what, const std::string& instead) {
    throw InputError(
        fmt::format("the card '{}' couples tension and shear ([shear] tension_coupling), which {} does not "
                    "know; {}, or take the coupling out of the card",
                    card.name, what, instead));
  };
  if (model.formulation != Formulation::energy)
    refuse(fmt::format("model.formulation = \"{}\"", name_of(model.formulation)), "set formulation = \"energy\"");
  if (model.thickness != Thickness::constant_volume)
    refuse(fmt::format("model.thickness = \"{}\"", name_of(model.thickness)), "set thickness = \"constant-volume\"");
  if (model.section != Section::incompressible)
    refuse(fmt::format("model.section = \"{}\"", name_of(model.section)), "set section = \"incompressible\"");
}

}  // namespace weaveform
