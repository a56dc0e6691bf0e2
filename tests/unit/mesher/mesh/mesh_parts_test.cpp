// The parts of a mesh: what add() takes is there whole, and check() names the first thing wrong.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "tests/unit/solver/lattice/trellis.hpp"

namespace weaveform {
namespace {

TEST(MeshParts, WhatIsAddedIsThereWhole) {
  Mesh mesh;
  EXPECT_EQ(mesh.nodes.add({1.0, 2.0, 3.0}, 4.0), 0);
  EXPECT_EQ(mesh.nodes.add({5.0, 6.0, 7.0}, 8.0, {2, 3}), 1);
  EXPECT_EQ(mesh.nodes.crossing, (std::vector<std::array<int, 2>>{{-1, -1}, {2, 3}}));
  const MeshYarn yarn = {{0, 1}, Family::weft, 1.5, 2.5, 3.5, 4.5, 0.5};
  mesh.yarns.add({});
  mesh.yarns.add(yarn);
  const MeshYarn back = mesh.yarns.at(1);
  EXPECT_EQ(back.node, yarn.node);
  EXPECT_EQ(back.family, yarn.family);
  EXPECT_EQ((std::array{back.rest_length, back.section, back.yarns, back.jaw, back.softening}),
            (std::array{1.5, 2.5, 3.5, 4.5, 0.5}));
  mesh.cells.add({0, 1, 2}, {{1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}}, 9.0, {4, 5});
  mesh.cells.add({3, 2, 1, 0}, {{1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}, {2.0, 2.0}}, 10.0, {6, 7});
  EXPECT_EQ(mesh.cells.offset, (std::vector<int>{0, 3, 7}));
  EXPECT_EQ(mesh.cells.area, (std::vector<double>{9.0, 10.0}));
  EXPECT_EQ(mesh.cells.lattice.back(), (std::array<int, 2>{6, 7}));
}

struct Fault {
  std::function<void(Mesh&)> make;
  std::string said;
};

TEST(MeshParts, ACheckNamesTheFirstThingWrong) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Fault> faults = {
      {[](Mesh& m) { m.nodes.mass.pop_back(); }, "12 nodes, but 11 masses"},
      {[](Mesh& m) { m.nodes.flat_position.resize(3); }, "12 nodes, but 3 flat positions"},
      {[&](Mesh& m) { m.nodes.position[4][1] = none; }, "the position of node 4 has a component that is nan"},
      {[](Mesh& m) { m.nodes.mass[2] = -1.0; }, "mass of node 2 is -1"},
      {[](Mesh& m) { m.yarns.softening.pop_back(); }, "17 yarn elements, but 16 softenings"},
      {[](Mesh& m) {
         m.yarns.node[3] = {1, 12};
       },
       "yarn element 3 names node 12 of 12"},
      {[](Mesh& m) {
         m.yarns.node[3] = {1, 1};
       },
       "yarn element 3 names node 1 twice"},
      {[](Mesh& m) { m.yarns.rest_length[5] = 0.0; }, "rest length of yarn element 5 is 0"},
      {[](Mesh& m) { m.cells.area.push_back(1.0); }, "7 cells, but 6 offsets after the first"},
      {[](Mesh& m) { m.cells.lattice.pop_back(); }, "6 cells, but 5 lattice places"},
      {[](Mesh& m) { m.cells.coefficient.pop_back(); }, "24 cell entries, but 23 coefficients"},
      {[](Mesh& m) { m.cells.offset.back() = 25; }, "the cells' offsets span 0 to 25, not 0 to 24"},
      {[](Mesh& m) { m.cells.offset[1] = 2; }, "cell 0 has 2 nodes"},
      {[](Mesh& m) { m.cells.offset[1] = 1 << 30; }, "cell 0 lies outside the entries"},
      {[](Mesh& m) { m.cells.node[0] = -1; }, "cell 0 names node -1 of 12"},
      {[](Mesh& m) { m.cells.area[2] = 0.0; }, "area of cell 2 is 0"},
      {[](Mesh& m) { m.thickness = 0.0; }, "spacing or thickness 2 is 0"},
      {[](Mesh& m) {
         m.tie.push_back({3, {3, 4}, -1.0});
       },
       "tie 0 names node 3 twice"},
      {[](Mesh& m) {
         m.frame.corner = {0, 1, 2, 99};
       },
       "frame 0 names node 99 of 12"},
      {[](Mesh& m) {
         m.sets.push_back({"grip", {0, 12}});
       },
       "set 'grip' names node 12 of 12"},
      {[](Mesh& m) {
         m.sets.push_back({"grip", {4, 4}});
       },
       "the nodes of set 'grip' do not rise: 4 after 4"},
      {[](Mesh& m) {
         m.nodes.crossing[1] = {0, 0};
       },
       "node 1 lies at crossing (0, 0), where another does"},
  };
  EXPECT_EQ(test::lattice(4, 3, 5.0).check(), "");
  for (const Fault& fault : faults) {
    Mesh mesh = test::lattice(4, 3, 5.0);
    fault.make(mesh);
    EXPECT_EQ(mesh.check(), fault.said);
  }
}

}  // namespace
}  // namespace weaveform
