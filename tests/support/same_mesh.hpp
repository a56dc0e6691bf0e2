// Two meshes compared member by member, to the bit.
#pragma once

#include <gtest/gtest.h>

#include "mesher/mesh/mesh.hpp"

namespace weaveform::test {

inline void expect_same_mesh(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.nodes.position, b.nodes.position);
  EXPECT_EQ(a.nodes.flat_position, b.nodes.flat_position);
  EXPECT_EQ(a.nodes.mass, b.nodes.mass);
  EXPECT_EQ(a.nodes.crossing, b.nodes.crossing);
  EXPECT_EQ(a.yarns.node, b.yarns.node);
  EXPECT_EQ(a.yarns.family, b.yarns.family);
  EXPECT_EQ(a.yarns.rest_length, b.yarns.rest_length);
  EXPECT_EQ(a.yarns.section, b.yarns.section);
  EXPECT_EQ(a.yarns.yarns, b.yarns.yarns);
  EXPECT_EQ(a.yarns.jaw, b.yarns.jaw);
  EXPECT_EQ(a.yarns.softening, b.yarns.softening);
  EXPECT_EQ(a.cells.offset, b.cells.offset);
  EXPECT_EQ(a.cells.node, b.cells.node);
  EXPECT_EQ(a.cells.coefficient, b.cells.coefficient);
  EXPECT_EQ(a.cells.area, b.cells.area);
  EXPECT_EQ(a.cells.lattice, b.cells.lattice);
  EXPECT_EQ(a.spacing, b.spacing);
  EXPECT_EQ(a.lattice_size, b.lattice_size);
  EXPECT_EQ(a.thickness, b.thickness);
  EXPECT_EQ(a.frame.corner, b.frame.corner);
  ASSERT_EQ(a.tie.size(), b.tie.size());
  for (std::size_t k = 0; k < a.tie.size(); ++k) {
    EXPECT_EQ(a.tie[k].node, b.tie[k].node);
    EXPECT_EQ(a.tie[k].to, b.tie[k].to);
    EXPECT_EQ(a.tie[k].share, b.tie[k].share);
  }
  ASSERT_EQ(a.sets.size(), b.sets.size());
  for (std::size_t k = 0; k < a.sets.size(); ++k) {
    EXPECT_EQ(a.sets[k].name, b.sets[k].name);
    EXPECT_EQ(a.sets[k].node, b.sets[k].node);
  }
}

}  // namespace weaveform::test
