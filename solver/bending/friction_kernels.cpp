#include "solver/bending/friction_kernels.hpp"

#include "solver/bending/bend_geometry.hpp"
#include "solver/bending/loose_bend.hpp"

namespace weaveform::WEAVEFORM_SET {
namespace {

// Both families at a crossing: tangents before and after, inverse lengths, spans and the normal.
struct Crossing {
  BendTangent before[2], after[2];
  double span[2][3];
  BendNormal n;
};

[[gnu::always_inline]] inline Crossing crossing_at(const BendRows& rows, int i) {
  Crossing at{};
  double e[2][2][3];
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    const double x = rows.here[c][i];
    e[0][0][c] = x - rows.here[c][i - 1];
    e[0][1][c] = rows.here[c][i + 1] - x;
    e[1][0][c] = x - rows.below[c][i];
    e[1][1][c] = rows.above[c][i] - x;
  }
#pragma GCC unroll 2
  for (int f = 0; f < 2; ++f) {
    at.before[f] = bend_tangent(e[f][0][0], e[f][0][1], e[f][0][2]);
    at.after[f] = bend_tangent(e[f][1][0], e[f][1][1], e[f][1][2]);
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) at.span[f][c] = e[f][0][c] + e[f][1][c];
  }
  at.n = bend_normal(at.span[0], at.span[1]);
  return at;
}

// The step of one family at one bend; returns what is lost per yarn and unit length (N).
[[gnu::always_inline]] inline double step_one(const YarnFriction& friction, const YarnTurn& turn, double inverse_spread,
                                              double keep, double* phi_out, double* phi_in, double* kappa_out,
                                              double* kappa_in) {
  const double inverse_rise = 1.0 / friction.rise;
  const double out = turn.out * turn.root * inverse_spread, in = turn.in * turn.root * inverse_spread;
  const double change_out = keep * (out - *kappa_out), change_in = keep * (in - *kappa_in);
  const double out_after = friction_after(*phi_out, change_out, inverse_rise);
  const double in_after = friction_after(*phi_in, change_in, inverse_rise);
  const double lost = friction.out * friction_loss(*phi_out, out_after, change_out, friction.rise) +
                      friction.in * friction_loss(*phi_in, in_after, change_in, friction.rise);
  *phi_out = out_after;
  *phi_in = in_after;
  *kappa_out = out;
  *kappa_in = in;
  return lost;
}

void row_step(const YarnFriction* frictions, const BendRows& row_pointers, double inverse_warp, double inverse_weft,
              const double* warp_yarns, const double* weft_yarns, int begin, int end, bool begin_at,
              const BendFrictionView& kept, double* lost) {
  const YarnFriction warp = frictions[0], weft = frictions[1];
  const BendRows rows = row_pointers;
  const BendFrictionView state = kept;
  const double keep = begin_at ? 0.0 : 1.0;
#pragma omp simd
  for (int i = begin; i < end; ++i) {
    const Crossing at = crossing_at(rows, i);
    const YarnTurn turn1 = yarn_turn(at.before[0].t, at.after[0].t, at.n.n),
                   turn2 = yarn_turn(at.before[1].t, at.after[1].t, at.n.n);
    const double lost1 = step_one(warp, turn1, inverse_warp, keep, &state.phi[0][0][i], &state.phi[0][1][i],
                                  &state.curvature[0][0][i], &state.curvature[0][1][i]);
    const double lost2 = step_one(weft, turn2, inverse_weft, keep, &state.phi[1][0][i], &state.phi[1][1][i],
                                  &state.curvature[1][0][i], &state.curvature[1][1][i]);
    lost[i] = warp_yarns[i] / inverse_warp * lost1 + weft_yarns[i] / inverse_weft * lost2;
  }
}

void row_forces(const YarnFriction* frictions, const BendRows& row_pointers, const double* warp_yarns,
                const double* weft_yarns, int begin, int end, const BendFrictionView& kept,
                const BendRowOutput& output) {
  const YarnFriction warp = frictions[0], weft = frictions[1];
  const BendRows rows = row_pointers;
  const BendFrictionView state = kept;
  const BendRowOutput out = output;
#pragma omp simd
  for (int i = begin; i < end; ++i) {
    const Crossing at = crossing_at(rows, i);
    double odd1[3], odd2[3], even1[3], even2[3], h[3] = {0.0, 0.0, 0.0};
    friction_bend(yarn_turn(at.before[0].t, at.after[0].t, at.n.n), at.n.n,
                  warp_yarns[i] * warp.out * state.phi[0][0][i], warp_yarns[i] * warp.in * state.phi[0][1][i], odd1,
                  even1, h);
    friction_bend(yarn_turn(at.before[1].t, at.after[1].t, at.n.n), at.n.n,
                  weft_yarns[i] * weft.out * state.phi[1][0][i], weft_yarns[i] * weft.in * state.phi[1][1][i], odd2,
                  even2, h);
    double g1p[3], g1m[3], g2p[3], g2m[3], f1p[3], f1m[3], f2p[3], f2m[3], on1[3], on2[3];
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      g1p[c] = odd1[c] + even1[c];
      g1m[c] = odd1[c] - even1[c];
      g2p[c] = odd2[c] + even2[c];
      g2m[c] = odd2[c] - even2[c];
    }
    bend_force(g1p, at.after[0].t, at.after[0].inverse_length, f1p);
    bend_force(g1m, at.before[0].t, at.before[0].inverse_length, f1m);
    bend_force(g2p, at.after[1].t, at.after[1].inverse_length, f2p);
    bend_force(g2m, at.before[1].t, at.before[1].inverse_length, f2m);
    normal_forces(at.n, h, at.span[0], at.span[1], on1, on2);
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      out.centre[c][i] -= f1p[c] + f1m[c] + f2p[c] + f2m[c];
      out.warp_after[c][i] += f1p[c] + on1[c];
      out.warp_before[c][i] += f1m[c] - on1[c];
      out.weft_after[c][i] += f2p[c] + on2[c];
      out.weft_before[c][i] += f2m[c] - on2[c];
    }
  }
}

void loose_step(const YarnFriction* frictions, const LooseBendView& view, const double* const (&positions)[3],
                bool begin_at, const BendFrictionView& kept, double* lost) {
  const YarnFriction warp = frictions[0], weft = frictions[1];
  const LooseBendView bends = view;
  const BendFrictionView state = kept;
  const double* const x[3] = {positions[0], positions[1], positions[2]};
  const double keep = begin_at ? 0.0 : 1.0;
#pragma omp simd
  for (int e = 0; e < bends.count; ++e) {
    const LooseYarn y1 = loose_yarn(bends, x, 0, e), y2 = loose_yarn(bends, x, 1, e);
    const BendNormal n = bend_normal(y1.span, y2.span);
    const double lost1 =
        step_one(warp, yarn_turn(y1.before, y1.after, n.n), bends.inverse_spread[0][e], keep, &state.phi[0][0][e],
                 &state.phi[0][1][e], &state.curvature[0][0][e], &state.curvature[0][1][e]);
    const double lost2 =
        step_one(weft, yarn_turn(y2.before, y2.after, n.n), bends.inverse_spread[1][e], keep, &state.phi[1][0][e],
                 &state.phi[1][1][e], &state.curvature[1][0][e], &state.curvature[1][1][e]);
    lost[e] =
        bends.yarns[0][e] / bends.inverse_spread[0][e] * lost1 + bends.yarns[1][e] / bends.inverse_spread[1][e] * lost2;
  }
}

void loose_forces(const YarnFriction* frictions, const LooseBendView& view, const double* const (&positions)[3],
                  const BendFrictionView& kept, double* const (&force)[2][2][3]) {
  const YarnFriction warp = frictions[0], weft = frictions[1];
  const LooseBendView bends = view;
  const BendFrictionView state = kept;
  const double* const x[3] = {positions[0], positions[1], positions[2]};
  double* out[2][2][3];
  for (int f = 0; f < 2; ++f)
    for (int side = 0; side < 2; ++side)
      for (int c = 0; c < 3; ++c) out[f][side][c] = force[f][side][c];
#pragma omp simd
  for (int e = 0; e < bends.count; ++e) {
    const LooseYarn y1 = loose_yarn(bends, x, 0, e), y2 = loose_yarn(bends, x, 1, e);
    const BendNormal n = bend_normal(y1.span, y2.span);
    double odd1[3], odd2[3], even1[3], even2[3], h[3] = {0.0, 0.0, 0.0}, on1[3], on2[3];
    friction_bend(yarn_turn(y1.before, y1.after, n.n), n.n, bends.yarns[0][e] * warp.out * state.phi[0][0][e],
                  bends.yarns[0][e] * warp.in * state.phi[0][1][e], odd1, even1, h);
    friction_bend(yarn_turn(y2.before, y2.after, n.n), n.n, bends.yarns[1][e] * weft.out * state.phi[1][0][e],
                  bends.yarns[1][e] * weft.in * state.phi[1][1][e], odd2, even2, h);
    normal_forces(n, h, y1.span, y2.span, on1, on2);
    double g1p[3], g1m[3], g2p[3], g2m[3], f1m[3], f1p[3], f2m[3], f2p[3];
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      g1p[c] = odd1[c] + even1[c];
      g1m[c] = odd1[c] - even1[c];
      g2p[c] = odd2[c] + even2[c];
      g2m[c] = odd2[c] - even2[c];
    }
    bend_force(g1m, y1.before, y1.scale_before, f1m);
    bend_force(g1p, y1.after, y1.scale_after, f1p);
    bend_force(g2m, y2.before, y2.scale_before, f2m);
    bend_force(g2p, y2.after, y2.scale_after, f2p);
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      out[0][0][c][e] += f1m[c] - on1[c];
      out[0][1][c][e] += f1p[c] + on1[c];
      out[1][0][c][e] += f2m[c] - on2[c];
      out[1][1][c][e] += f2p[c] + on2[c];
    }
  }
}

// t and the turn of one edge of shell cells.
struct EdgeTurn {
  double t[3], vector[3];
  double inverse_length, turn;
  double root, slope;  // kappa = turn R(turn^2)/L ; R, dR/du
};

[[gnu::always_inline]] inline EdgeTurn edge_turn(const double (&e)[3], const double (&da)[3], const double (&db)[3]) {
  EdgeTurn edge{};
  const BendTangent tangent = bend_tangent(e[0], e[1], e[2]);
  edge.inverse_length = tangent.inverse_length;
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    edge.t[c] = tangent.t[c];
    edge.vector[c] = db[c] - da[c];
    edge.turn += edge.t[c] * edge.vector[c];
  }
  const double u = edge.turn * edge.turn;
  edge.root = std::sqrt(1.0 + u * (1.0 / 12 + u * (1.0 / 90 + u * (1.0 / 560))));
  edge.slope = 0.5 * (1.0 / 12 + u * (2.0 / 90 + u * (3.0 / 560))) / edge.root;
  return edge;
}

[[gnu::always_inline]] inline double edge_step(const EdgeTurn& edge, double rise, double inverse_rest, double keep,
                                               double* phi, double* curvature) {
  const double now = edge.turn * edge.root * inverse_rest, change = keep * (now - *curvature);
  const double after = friction_after(*phi, change, 1.0 / rise);
  const double lost = friction_loss(*phi, after, change, rise);
  *phi = after;
  *curvature = now;
  return lost;
}

// dE = moment phi l dkappa = moment phi (R + 2 R' turn^2) d(turn)
[[gnu::always_inline]] inline void add_edge_force(const EdgeTurn& edge, double moment, const EdgeOutput& out, int i) {
  const double bend = moment * (edge.root + 2.0 * edge.slope * edge.turn * edge.turn);
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    out.force[c][i] -= edge.inverse_length * bend * (edge.vector[c] - edge.turn * edge.t[c]);
    out.bend[c][i] += bend * edge.t[c];
  }
}

[[gnu::always_inline]] inline EdgeTurn row_edge(const ShellRows& rows, int i) {
  double e[3], da[3], db[3];
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    e[c] = rows.xb[c][i] - rows.xa[c][i];
    da[c] = rows.da[c][i];
    db[c] = rows.db[c][i];
  }
  return edge_turn(e, da, db);
}

[[gnu::always_inline]] inline EdgeTurn loose_edge(const LooseEdgeView& edges, const double* const (&x)[3],
                                                  const double* const (&d)[3], int k) {
  const int a = edges.node0[k], b = edges.node1[k];
  double e[3], da[3], db[3];
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    e[c] = x[c][b] - x[c][a];
    da[c] = d[c][a];
    db[c] = d[c][b];
  }
  return edge_turn(e, da, db);
}

void edge_row_step(double moment, double rise, const ShellRows& row_pointers, double inverse_rest, const double* yarns,
                   int begin, int end, bool begin_at, double* phi, double* curvature, double* lost) {
  const ShellRows rows = row_pointers;
  const double keep = begin_at ? 0.0 : 1.0;
#pragma omp simd
  for (int i = begin; i < end; ++i)
    lost[i] = moment * yarns[i] / inverse_rest *
              edge_step(row_edge(rows, i), rise, inverse_rest, keep, &phi[i], &curvature[i]);
}

void edge_row_forces(double moment, const ShellRows& row_pointers, const double* yarns, int begin, int end,
                     const double* phi, const EdgeOutput& output) {
  const ShellRows rows = row_pointers;
  const EdgeOutput out = output;
#pragma omp simd
  for (int i = begin; i < end; ++i) add_edge_force(row_edge(rows, i), moment * yarns[i] * phi[i], out, i);
}

void loose_edge_step(double moment, double rise, const LooseEdgeView& view, const double* const (&positions)[3],
                     const double* const (&directors)[3], bool begin_at, double* phi, double* curvature, double* lost) {
  const LooseEdgeView edges = view;
  const double* const x[3] = {positions[0], positions[1], positions[2]};
  const double* const d[3] = {directors[0], directors[1], directors[2]};
  const double keep = begin_at ? 0.0 : 1.0;
#pragma omp simd
  for (int k = 0; k < edges.count; ++k)
    lost[k] = moment * edges.yarns[k] / edges.inverse_rest[k] *
              edge_step(loose_edge(edges, x, d, k), rise, edges.inverse_rest[k], keep, &phi[k], &curvature[k]);
}

void loose_edge_forces(double moment, const LooseEdgeView& view, const double* const (&positions)[3],
                       const double* const (&directors)[3], const double* phi, const EdgeOutput& output) {
  const LooseEdgeView edges = view;
  const EdgeOutput out = output;
  const double* const x[3] = {positions[0], positions[1], positions[2]};
  const double* const d[3] = {directors[0], directors[1], directors[2]};
#pragma omp simd
  for (int k = 0; k < edges.count; ++k)
    add_edge_force(loose_edge(edges, x, d, k), moment * edges.yarns[k] * phi[k], out, k);
}

}  // namespace

extern const FrictionLoops friction_table;
const FrictionLoops friction_table = {.row_step = row_step,
                                      .row_forces = row_forces,
                                      .loose_step = loose_step,
                                      .loose_forces = loose_forces,
                                      .edge_row_step = edge_row_step,
                                      .edge_row_forces = edge_row_forces,
                                      .loose_edge_step = loose_edge_step,
                                      .loose_edge_forces = loose_edge_forces};

}  // namespace weaveform::WEAVEFORM_SET
