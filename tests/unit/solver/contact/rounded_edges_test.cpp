// A ply's surface as others press on it: without edges where its cells meet.
#include "solver/contact/rounded_edges.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "mesher/symmetry/cut_part.hpp"
#include "mesher/tools/tool.hpp"
#include "solver/contact/ply_face.hpp"
#include "solver/contact/ply_kernel.hpp"
#include "tests/support/stack.hpp"

namespace weaveform {
namespace {

using test::piece;
using test::Stack;

// A ply that is bent between every two cells, with a corner cut out of it.
class RoundedEdgesTest : public testing::Test {
protected:
  RoundedEdgesTest() : stack_({test::piece_without_a_corner(0.0)}), face_(stack_.ply(0), "ply") {
    stack_.place(0, [](const Vec3& x) -> Vec3 {
      return {x[0], x[1], 3.0 * std::sin(0.2 * x[0]) * std::cos(0.17 * x[1]) + 0.002 * x[0] * x[0]};
    });
    face_.edges().look(position());
  }
  const Components& position() { return stack_.ply(0).state().position; }
  const PlySurface& surface() const { return face_.surface(); }
  const RoundedEdges& edges() const { return face_.edges(); }
  // Of the quads; those with another quad on every side when `inner`.
  std::vector<int> quads(bool inner) const {
    const int stride = stack_.ply(0).packed().stride;
    std::vector<int> found;
    for (int facet = 0; facet < stack_.ply(0).packed().lattice_nodes(); ++facet) {
      const auto there = [&](int f) { return f >= 0 && surface().exists(f) && !surface().is_triangle(f); };
      bool all = there(facet);
      for (const int way : {1, stride, stride + 1, stride - 1})
        all = all && (!inner || (there(facet + way) && there(facet - way)));
      if (all) found.push_back(facet);
    }
    return found;
  }

  mutable Stack stack_;
  PlyFace face_;
};

TEST_F(RoundedEdgesTest, OneCellsSideIsTheNextOnesWithItsSlopes) {
  const int stride = stack_.ply(0).packed().stride;
  const auto inner = quads(true);
  ASSERT_GT(inner.size(), 20U);
  double jump_of_cells = 0.0;
  for (const int facet : inner)
    for (const double along : {0.004, 0.3, 0.997})
      for (const bool east : {true, false}) {
        const SurfacePlace here = east ? SurfacePlace{facet, 1.0, along} : SurfacePlace{facet, along, 1.0},
                           there =
                               east ? SurfacePlace{facet + 1, 0.0, along} : SurfacePlace{facet + stride, along, 0.0};
        const auto a = edges().frame(here, position()), b = edges().frame(there, position());
        const auto flat_a = surface().frame(here, position()), flat_b = surface().frame(there, position());
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_NEAR(a.point[c], b.point[c], 1e-12);
          EXPECT_NEAR(a.s1[c], b.s1[c], 1e-12);
          EXPECT_NEAR(a.s2[c], b.s2[c], 1e-12);
          jump_of_cells = std::max(jump_of_cells, std::abs(flat_a.s1[c] - flat_b.s1[c]));
        }
      }
  EXPECT_GT(jump_of_cells, 0.1) << "mm; the cells themselves do meet at an angle";
}

// Slopes are those of the points, everywhere, and so continuous: central differences at 1e-5 of a cell.
TEST_F(RoundedEdgesTest, ItsSlopesAreThoseOfItsPoints) {
  constexpr double step = 1e-5;
  int rounded = 0;
  for (const int facet : quads(false))
    for (const double xi : {0.0, 0.002, 0.0050, 0.0051, 0.5, 0.996, 0.9999})
      for (const double eta : {0.003, 0.0052, 0.4, 0.998}) {
        const auto at = edges().frame({facet, xi, eta}, position());
        rounded += edges().find({facet, xi, eta}).crossing >= 0 ? 1 : 0;
        const auto east = edges().frame({facet, xi + step, eta}, position()),
                   west = edges().frame({facet, xi - step, eta}, position()),
                   north = edges().frame({facet, xi, eta + step}, position()),
                   south = edges().frame({facet, xi, eta - step}, position());
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_NEAR((east.point[c] - west.point[c]) / (2.0 * step), at.s1[c], 1e-3) << xi << " " << eta;
          EXPECT_NEAR((north.point[c] - south.point[c]) / (2.0 * step), at.s2[c], 1e-3) << xi << " " << eta;
        }
      }
  EXPECT_GT(rounded, 100);
}

TEST_F(RoundedEdgesTest, WhatCrossingsTakeIsTheForceAtTheFootAndItsMoment) {
  const Vec3 force = {1.0, -2.0, 3.0};
  int count = 0;
  for (const int facet : quads(false))
    for (const double xi : {0.0, 0.003, 0.6, 0.998})
      for (const double eta : {0.0, 0.004, 0.7, 1.0}) {
        const SurfacePlace place = {facet, xi, eta};
        const EdgePlace edge = edges().find(place);
        if (edge.crossing < 0) continue;
        ++count;
        EdgeFeet feet{};
        edges().fill(edge, position(), 0, feet);
        loops_of_edges().find(RoundedEdges::fill_up(1, feet), 0, feet);
        std::vector<double> into(4 * position()[0].size(), 0.0);
        std::vector<char> touched(position()[0].size() / ply_segment + 1, 0);
        edges().give_back(edge, feet, 0, force, into.data(), touched.data());
        Vec3 sum = {0.0, 0.0, 0.0}, moment = {0.0, 0.0, 0.0};
        for (std::size_t n = 0; n < position()[0].size(); ++n) {
          const Vec3 taken = {into[4 * n], into[4 * n + 1], into[4 * n + 2]};
          sum = plus(sum, taken);
          moment = plus(moment, cross({position()[0][n], position()[1][n], position()[2][n]}, taken));
        }
        const Vec3 whole = cross(edges().frame(place, position()).point, force);
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_NEAR(sum[c], -force[c], 1e-12);
          EXPECT_NEAR(moment[c], -whole[c], 1e-10);
        }
      }
  EXPECT_GT(count, 100);
}

TEST_F(RoundedEdgesTest, FlatPliesHaveNone) {
  stack_.place(0, [](const Vec3& x) -> Vec3 { return {1.01 * x[0] + 0.1 * x[1], x[1], 0.3 * x[0] - 0.2 * x[1]}; });
  face_.edges().look(position());
  EXPECT_FALSE(edges().any());
}

// A ply that its mirror planes map onto itself, bent likewise.
struct Bent {
  Team team{1};
  std::unique_ptr<Ply> ply;
  std::unique_ptr<PlyFace> face;
  Bent(const Mesh& whole, const SymmetricPart* part, const Scene& scene, const Card& card)
      : ply(std::make_unique<Ply>(PlySetup{.whole = whole, .part = part, .scene = scene, .card = card, .team = team})),
        face(std::make_unique<PlyFace>(*ply, "ply")) {
    const Mesh& mesh = ply->mesh();
    for (int n = 0; n < mesh.node_count(); ++n) {
      const auto& x = mesh.nodes.position[n];
      const double a = x[0] / 30.0, b = x[1] / 40.0;
      const Vec3 bent = {x[0] * (1.01 + 0.05 * b * b), x[1] * (1.0 + 0.08 * a * a), 3.0 * a * a + 2.0 * b * b};
      for (std::size_t c = 0; c < 3; ++c) ply->state().position[c][ply->packed().packed_of_mesh[n]] = bent[c];
    }
    ply->follow();
    face->edges().look(ply->state().position);
  }
  [[nodiscard]] const Components& position() const { return ply->state().position; }
};

// Crossings beyond a plane, and what lies on them, are images.
TEST(RoundedEdges, AQuarterIsRoundedAsTheWhole) {
  for (const double angle : {0.0, 45.0})
    for (const double phase : {0.0, 0.5}) {
      Scene scene = piece({60.0, 80.0}, 1.0, angle, 0.0);
      scene.blank.phase = {phase, phase};
      scene.model.symmetry = SymmetryUse::quarter;
      const Card card = load_card(scene.fabric.material);
      const Mesh mesh = build_mesh(scene, card);
      const SymmetricPart part = cut_part(mesh, find_symmetry(scene, card, mesh, make_tools(scene, mesh)));
      const Bent whole(mesh, nullptr, scene, card), quarter(mesh, &part, scene, card);
      int rounded = 0;
      for (int n = 0; n < part.mesh.node_count(); ++n) {
        const int facet = quarter.ply->packed().packed_of_mesh[n],
                  there = whole.ply->packed().packed_of_mesh[part.mesh.symmetry.whole_node[n]];
        if (facet >= quarter.ply->packed().lattice_nodes() || !quarter.face->surface().exists(facet)) continue;
        ASSERT_TRUE(whole.face->surface().exists(there));
        for (const double xi : {0.0, 0.002, 0.4, 0.998, 1.0})
          for (const double eta : {0.0, 0.001, 0.6, 0.997, 1.0}) {
            const auto expected = whole.face->edges().frame({there, xi, eta}, whole.position());
            bool beyond = false;
            for (const auto& plane : part.mesh.symmetry.plane)
              beyond = beyond || dot(minus(expected.point, plane.point), plane.normal) < -1e-9;
            if (beyond) continue;
            const auto found = quarter.face->edges().frame({facet, xi, eta}, quarter.position());
            rounded += quarter.face->edges().find({facet, xi, eta}).crossing >= 0 ? 1 : 0;
            for (std::size_t c = 0; c < 3; ++c) {
              EXPECT_NEAR(found.point[c], expected.point[c], 1e-11) << angle << " deg, phase " << phase;
              EXPECT_NEAR(found.s1[c], expected.s1[c], 1e-11) << angle << " deg, phase " << phase;
              EXPECT_NEAR(found.s2[c], expected.s2[c], 1e-11) << angle << " deg, phase " << phase;
            }
          }
      }
      EXPECT_GT(rounded, 200);
    }
}

}  // namespace
}  // namespace weaveform
