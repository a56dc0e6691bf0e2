// A belt over a round tool: a strip of fabric laid over a cylinder as a polygon, pulled at one end along its own line.
#pragma once

#include <algorithm>
#include <cmath>

#include "tests/support/contact_scene.hpp"

namespace weaveform::test {

// A strip laid over a cylinder: straight, `wrap` radians about it, straight; nodes on a polygon with sides of one cell,
// its corners at `radius`.
inline void lay_over(Mesh& mesh, double radius, double wrap) {
  const double side = mesh.spacing[0], turn = 2.0 * std::asin(0.5 * side / radius);
  const int corners = static_cast<int>(std::lround(wrap / turn));  // odd: a corner at the top
  const auto corner = [&](int n) {
    const int half = (corners - 1) / 2;
    const int on_arc = std::clamp(n, -half, half);
    std::array<double, 2> p = {radius * std::sin(on_arc * turn), radius * std::cos(on_arc * turn)};
    const double direction = (n > 0 ? 1.0 : -1.0) * (half + 0.5) * turn;
    p[0] += (n > 0 ? 1.0 : -1.0) * std::abs(n - on_arc) * side * std::cos(direction);
    p[1] -= std::abs(n - on_arc) * side * std::abs(std::sin(direction));
    return p;
  };
  for (auto& x : mesh.nodes.position) {
    const double s = x[0] / side;
    const int n = static_cast<int>(std::floor(s));
    const auto a = corner(n), b = corner(n + 1);
    x[0] = a[0] + (s - n) * (b[0] - a[0]);
    x[2] = a[1] + (s - n) * (b[1] - a[1]);
  }
}

struct Belt {
  Scene scene;
  Card card;
  Mesh mesh;
  double turn = 0.0;   // rad; at one corner
  double angle = 0.0;  // rad; between the straight ends
  [[nodiscard]] SolveResult run() const { return solve(mesh, scene, card, "", {.threads = 1, .quiet = true}); }
};

struct BeltShape {
  double length = 300.0, width = 20.0;  // mm; of the strip
  double radius = 50.0;                 // mm; of the cylinder
  std::array<double, 2> coarsening = {1.0, 1.0};
  int corners = 21;                      // on the cylinder, odd
  double pulled = 12.0, followed = 9.0;  // mm; ways of the ends: the belt is that much longer in the end, and slides
};

inline Belt make_belt(const BeltShape& shape, double friction) {
  Belt belt;
  Scene& scene = belt.scene;
  scene = contact_scene({shape.length, shape.width}, 1.0);
  scene.blank.coarsening = shape.coarsening;
  scene.blank.phase = {0.0, 0.0};
  scene.blank.fit = LineFit::none;
  belt.card = load_card(scene.fabric.material);
  GripSpec pulled, held;
  pulled.name = "pulled";
  pulled.edge = BlankEdge::right;
  held.name = "held";
  held.edge = BlankEdge::left;
  scene.grip = {held, pulled};
  belt.mesh = build_mesh(scene, belt.card);
  const double middle = shape.radius + 0.5 * belt.card.thickness;
  belt.turn = 2.0 * std::asin(0.5 * belt.mesh.spacing[0] / middle);
  belt.angle = shape.corners * belt.turn;
  lay_over(belt.mesh, middle, belt.angle);
  ToolSpec cylinder = make_tool_spec("cylinder", ToolShape::cylinder);
  cylinder.radius = shape.radius;
  cylinder.axis = {0.0, 1.0, 0.0};
  cylinder.position = {{0.0, 0.0, 0.0}};
  cylinder.friction = friction;
  scene.tools = {cylinder};
  const double half = 0.5 * belt.angle;
  pulled.travel = shape.pulled;
  pulled.direction = {{std::cos(half), 0.0, -std::sin(half)}};
  held.travel = -shape.followed;
  held.direction = {{-std::cos(half), 0.0, -std::sin(half)}};
  scene.grip = {held, pulled};
  scene.analysis.duration = 0.15;
  scene.analysis.damping = 10.0;
  return belt;
}

}  // namespace weaveform::test
