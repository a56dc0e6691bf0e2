#include "tests/support/bending_cases.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "mesher/lattice/build.hpp"
#include "tests/support/elastica.hpp"
#include "tests/support/static_fabric.hpp"

namespace weaveform::test {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

constexpr double length = 24 * 4.92;  // mm; of yarns and strips, 24 yarns of the plain weave
constexpr double rigidity = 2.0;      // N mm; of strips
constexpr double stiff_shear = 50.0;  // N/mm; of shells where shear is not what is looked at: 1e-5 of the deflection

TangentLaw constant(double stiffness) {
  return TangentLaw({{0.0, std::numeric_limits<double>::infinity(), {stiffness}}});
}

// A rod or strip clamped at one end: per width (strips) or per yarn.
struct Cantilever {
  std::unique_ptr<StaticFabric> fabric;
  double stiffness;  // N mm^2 of the whole width
  double weight;     // N/mm under an acceleration of 1 mm/s^2
  double clamp, length;
  int tip;
};

Mesh chain(int elements, const Card& card) {
  Mesh mesh;
  const double h = length / elements;
  for (int n = 0; n <= elements; ++n) {
    const double share = n == 0 || n == elements ? 0.5 : 1.0;
    mesh.nodes.add({n * h, 0.0, 0.0}, share * h * card.yarn[0].linear_density, {n, 0});
  }
  for (int n = 0; n < elements; ++n)
    mesh.yarns.add({.node = {n, n + 1}, .rest_length = h, .section = card.yarn[0].section});
  mesh.spacing = {h, h};
  mesh.lattice_size = {elements + 1, 1};
  mesh.thickness = card.thickness;
  return mesh;
}

Flexure yarn_flexure(const TangentLaw& law) {
  Flexure flexure;
  flexure.in_plane[0] = law;
  flexure.out_of_plane[0] = law;
  flexure.bends_yarns = true;
  return flexure;
}

// Laws per width.
Flexure strip_flexure(Bender bender, const BendingLaw& per_width, const Card& card, double shear) {
  const auto of_yarn = [&](const TangentLaw& half) {
    auto pieces = half.pieces();
    for (auto& piece : pieces)
      for (auto& c : piece.coefficient) c *= card.yarn[0].interval;
    return TangentLaw(pieces);
  };
  const BendingLaw law(of_yarn(per_width.face()), of_yarn(per_width.back()));
  Flexure flexure;
  flexure.bends_yarns = bender != Bender::shell;
  if (bender == Bender::beam) flexure.in_plane = {law.face(), law.face()};
  flexure.rotation_free = bender == Bender::rotation_free;
  flexure.has_shell = bender == Bender::shell;
  (bender == Bender::shell ? flexure.shell : flexure.out_of_plane) = {law, law};
  if (bender != Bender::beam) flexure.twist = 0.2;
  flexure.transverse_shear = shear;
  return flexure;
}

std::vector<char> clamped_nodes(const Mesh& mesh, double up_to_x) {
  std::vector<char> clamped(mesh.node_count(), 0);
  for (int n = 0; n < mesh.node_count(); ++n) clamped[n] = mesh.nodes.position[n][0] <= up_to_x + 1e-6 ? 1 : 0;
  return clamped;
}

Cantilever yarn_cantilever(int elements, const TangentLaw& law) {
  const Card card = load_card("twintex-pw");
  Mesh mesh = chain(elements, card);
  auto clamped = clamped_nodes(mesh, 0.0);
  return {std::make_unique<StaticFabric>(std::move(mesh), card, ModelSpec{}, yarn_flexure(law), clamped),
          law.tangent(0.0),
          card.yarn[0].linear_density,
          0.0,
          length,
          elements};
}

// `law` per width; the strip is `stretch` times as long as its cells are said to be.
Cantilever strip_cantilever(Bender bender, int cells, const BendingLaw& law, double shear, double longer = 0.0,
                            double strip_length = length, int across = 0) {
  const Card card = load_card("twintex-pw");
  Scene scene;
  const double spacing = strip_length / cells, total = strip_length + longer * spacing;
  const double width = across > 0 ? across * spacing : 0.5 * strip_length;
  scene.blank.size = {total, width};
  scene.blank.yarn_angle = 0.0;
  scene.blank.coarsening = {spacing / card.yarn[0].interval, spacing / card.yarn[0].interval};
  GripSpec clamp;
  clamp.name = "clamp";
  clamp.edge = BlankEdge::left;
  scene.grip.push_back(clamp);
  Mesh mesh = build_mesh(scene, card);
  std::vector<char> clamped(mesh.node_count(), 0);
  for (const int n : mesh.sets.front().node) clamped[n] = 1;
  auto fabric = std::make_unique<StaticFabric>(std::move(mesh), card, ModelSpec{},
                                               strip_flexure(bender, law, card, shear), clamped);
  const int tip = fabric->node_at(0.5 * total, 0.0);
  return {std::move(fabric), law.face().tangent(0.0) * width, card.area_density() * width, -0.5 * total, total, tip};
}

Cantilever cantilever(Bender bender, int cells, double shear = stiff_shear) {
  if (bender == Bender::yarn) return yarn_cantilever(cells, constant(5.0));
  return strip_cantilever(bender, cells, constant(rigidity), shear);
}

void start_at(Cantilever& c, const RodShape& shape) {
  c.fabric->place(
      [&](const Vector3d& x) {
        const double s = x[0] - c.clamp;
        return Vector3d(c.clamp + shape.x_at(s), x[1], -shape.drop_at(s));
      },
      [&](const Vector3d& x) {
        const double angle = shape.angle_at(x[0] - c.clamp);
        return Vector3d(std::sin(angle), 0.0, std::cos(angle));
      });
}

Rod linear_rod(const Cantilever& c) {
  return {.length = c.length, .curvature = [b = c.stiffness](double moment) { return moment / b; }};
}

// Distance of the tip from where the rod's is, over the length.
Measured tip_error(Cantilever& c, const RodShape& shape, const StaticFabric::Load& load) {
  start_at(c, shape);
  Measured m;
  m.residual = c.fabric->relax(load);
  const Vector3d tip = c.fabric->position(c.tip);
  m.measured = -tip[2] / c.length;
  m.exact = shape.drop.back() / c.length;
  m.error = std::hypot(tip[0] - c.clamp - shape.x.back(), -tip[2] - shape.drop.back()) / c.length;
  return m;
}

// P down on the end, shared by the yarns that end there.
StaticFabric::Load end_load(const Cantilever& c, double load) {
  const double end = c.clamp + c.length;
  std::vector<double> share(c.fabric->mesh().node_count(), 0.0);
  const Mesh& mesh = c.fabric->mesh();
  double sum = 0.0;
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const int n = mesh.yarns.node[e][1];
    if (mesh.yarns.family[e] != Family::warp || std::abs(mesh.nodes.position[n][0] - end) > 1e-6) continue;
    share[n] += mesh.yarns.yarns[e];
    sum += mesh.yarns.yarns[e];
  }
  return [share, sum, load](const StaticFabric& /*fabric*/, NodalLoads& loads) {
    for (std::size_t n = 0; n < share.size(); ++n) loads.force[n][2] -= load * share[n] / sum;
  };
}

Measured relative(double measured, double exact, double residual) {
  return {std::abs(measured / exact - 1.0), residual, measured, exact};
}

double chord_angle(const RodShape& shape) {
  return std::atan2(shape.drop.back(), shape.x.back());
}

// The axial load at which the straight, compressed chain's least stiffness vanishes. Curvature counts the turn over the
// flat length, so that P (1 - P/(E A)) = P_Euler: a strain of 1e-5 here.
Measured euler(int elements, bool clamped, double exact_factor) {
  constexpr double bending = 500.0;
  const Card card = load_card("twintex-pw");
  Mesh mesh = chain(elements, card);
  auto clamps = clamped ? clamped_nodes(mesh, 0.0) : std::vector<char>(mesh.node_count(), 0);
  StaticFabric fabric(std::move(mesh), card, {}, yarn_flexure(constant(bending)), clamps);
  if (!clamped) {
    for (int c = 0; c < 3; ++c) fabric.hold(0, c);
    for (int c = 1; c < 3; ++c) fabric.hold(elements, c);
  }
  const double inextensible = exact_factor * pi * pi * bending / (length * length);
  const double exact = inextensible * (1.0 + inextensible / (card.yarn[0].linear_modulus * card.yarn[0].section));
  double residual = 0.0;
  const auto least_at = [&](double load) {
    const auto push = [&](const StaticFabric& /*fabric*/, NodalLoads& loads) { loads.force[elements][0] -= load; };
    residual = std::max(residual, fabric.relax(push));
    return fabric.least_stiffness(push);
  };
  // the eigenvalue is very nearly linear in the load: secant
  double p0 = 0.8 * exact, p1 = 0.95 * exact, k0 = least_at(p0);
  for (int n = 0; n < 6 && std::abs(p1 - p0) > 1e-9 * exact; ++n) {
    const double k1 = least_at(p1), next = p1 - k1 * (p1 - p0) / (k1 - k0);
    p0 = p1;
    k0 = k1;
    p1 = next;
  }
  return relative(p1, exact, residual);
}

}  // namespace

std::string name_of(Bender bender) {
  switch (bender) {
    case Bender::yarn:
      return "yarn";
    case Bender::beam:
      return "beam";
    case Bender::rotation_free:
      return "rotation-free";
    default:
      return "shell";
  }
}

const std::vector<BendingCase>& bending_cases() {
  constexpr auto yarn = Bender::yarn, beam = Bender::beam, free = Bender::rotation_free, shell = Bender::shell;
  static const std::vector<BendingCase> cases = {
      {"own weight, small: w L^4/8B", {yarn, beam, free, shell}, &sag},
      {"own weight, large: w L^3/B = 20", {yarn, beam, free, shell}, &heavy_elastica},
      {"own weight, Peirce's 41.5 deg", {yarn, beam, free, shell}, &peirce_overhang},
      {"own weight, length not whole cells", {beam, free, shell}, &cut_strip},
      {"own weight, law that yields", {yarn, free, shell}, &yielding_strip},
      {"end load, P L^2/B = 12 (82 deg)", {yarn, beam, free, shell}, &end_loaded_elastica},
      {"Euler, pinned-pinned", {yarn}, &euler_pinned},
      {"Euler, clamped-free", {yarn}, &euler_clamped},
      {"full circle, M = 2 pi B/L", {yarn, shell}, &full_circle},
      {"short thick strip, P L^3/3D + P L/G", {shell}, &short_thick_strip},
      {"twist by corners, P a b/4 D66", {free, shell}, &plate_twist},
      {"the same, G = 0.5 N/mm", {shell}, &plate_twist_sheared},
  };
  return cases;
}

Measured sag(Bender bender, int cells) {
  Cantilever c = cantilever(bender, cells);
  const double load = 0.01 * c.stiffness / std::pow(c.length, 3), gravity = load / c.weight;
  const double residual = c.fabric->relax(weight({0.0, 0.0, -gravity}));
  double exact = load * std::pow(c.length, 4) / (8.0 * c.stiffness);
  if (bender == Bender::shell) exact += load * c.length * c.length / (2.0 * stiff_shear * 0.5 * length);
  return relative(-c.fabric->position(c.tip)[2], exact, residual);
}

Measured heavy_elastica(Bender bender, int cells) {
  Cantilever c = cantilever(bender, cells);
  Rod rod = linear_rod(c);
  rod.weight = 20.0 * c.stiffness / std::pow(c.length, 3);
  return tip_error(c, solve_rod(rod), weight({0.0, 0.0, -rod.weight / c.weight}));
}

double peirce_load() {
  static const double found = [] {
    double low = 1.0, high = 30.0;
    for (int n = 0; n < 45; ++n) {
      const double middle = 0.5 * (low + high);
      const Rod rod{.length = 1.0, .curvature = [](double moment) { return moment; }, .weight = middle};
      (chord_angle(solve_rod(rod, 1000)) < 41.5 * pi / 180.0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }();
  return found;
}

Measured peirce_overhang(Bender bender, int cells) {
  Cantilever c = cantilever(bender, cells);
  Rod rod = linear_rod(c);
  rod.weight = peirce_load() * c.stiffness / std::pow(c.length, 3);
  start_at(c, solve_rod(rod));
  const double residual = c.fabric->relax(weight({0.0, 0.0, -rod.weight / c.weight}));
  const Vector3d tip = c.fabric->position(c.tip);
  return relative(std::atan2(-tip[2], tip[0] - c.clamp) * 180.0 / pi, 41.5, residual);
}

Measured end_loaded_elastica(Bender bender, int cells) {
  Cantilever c = cantilever(bender, cells);
  Rod rod = linear_rod(c);
  rod.end_load = 12.0 * c.stiffness / (c.length * c.length);
  return tip_error(c, solve_rod(rod), end_load(c, rod.end_load));
}

Measured euler_pinned(Bender /*yarn*/, int cells) {
  return euler(cells, false, 1.0);
}

Measured euler_clamped(Bender /*yarn*/, int cells) {
  return euler(cells, true, 0.25);
}

// The moment follows: on a yarn a couple on the ends of its last element, on a shell on the last directors.
Measured full_circle(Bender bender, int cells) {
  Cantilever c = cantilever(bender, cells);
  const double moment = 2.0 * pi * c.stiffness / c.length, radius = 0.5 * c.length / pi;
  c.fabric->place(
      [&](const Vector3d& x) {
        const double turn = (x[0] - c.clamp) / radius;
        return Vector3d(c.clamp + radius * std::sin(turn), x[1], radius * (std::cos(turn) - 1.0));
      },
      [&](const Vector3d& x) {
        const double turn = (x[0] - c.clamp) / radius;
        return Vector3d(std::sin(turn), 0.0, std::cos(turn));
      });
  const double total_yarns = 0.5 * c.length / c.fabric->card().yarn[0].interval;
  const double end = c.clamp + c.length;
  const Mesh& mesh = c.fabric->mesh();
  const auto load = [&](const StaticFabric& fabric, NodalLoads& loads) {
    for (int e = 0; e < mesh.yarn_count(); ++e) {
      const auto [a, b] = mesh.yarns.node[e];
      if (mesh.yarns.family[e] != Family::warp || std::abs(mesh.nodes.position[b][0] - end) > 1e-6) continue;
      if (bender == Bender::yarn) {
        const Vector3d along = fabric.position(b) - fabric.position(a);
        const Vector3d couple = Vector3d(along[2], 0.0, -along[0]) * moment / along.squaredNorm();
        loads.force[b] += couple;
        loads.force[a] -= couple;
        continue;
      }
      // d = (sin, 0, cos): the moment's work is M dtheta = M (cos, 0, -sin).dd
      const Vector3d d = fabric.director(b);
      loads.director[b] += moment * mesh.yarns.yarns[e] / total_yarns * Vector3d(d[2], 0.0, -d[0]);
    }
  };
  Measured m;
  m.residual = c.fabric->relax(load);
  const Vector3d tip = c.fabric->position(c.tip);
  m.measured = m.error = std::hypot(tip[0] - c.clamp, tip[2]) / c.length;
  return m;
}

Measured short_thick_strip(Bender bender, int cells) {
  constexpr double thick = 2000.0, soft = 0.5;  // N mm, N/mm: shear bends by 0.86 of what bending does
  Cantilever c = strip_cantilever(bender, cells, constant(thick), soft);
  const double width = 0.5 * length, load = 1e-4;
  const double residual = c.fabric->relax(end_load(c, load * width));
  const double exact = load * std::pow(c.length, 3) / (3.0 * thick) + load * c.length / soft;
  return relative(-c.fabric->position(c.tip)[2], exact, residual);
}

namespace {

// Corners push up and down in turn; three of them are held in z, where nothing acts. The exact answer is Kirchhoff's.
Measured twisted_plate(Bender bender, int cells, double shear) {
  constexpr double load = 1e-7, side = 0.5 * length;
  const Card card = load_card("twintex-pw");
  Scene scene;
  const double k = side / cells / card.yarn[0].interval;
  scene.blank.size = {side, side};
  scene.blank.yarn_angle = 0.0;
  scene.blank.coarsening = {k, k};
  scene.blank.fit = LineFit::none;
  scene.blank.phase = {cells % 2 == 0 ? 0.0 : 0.5, cells % 2 == 0 ? 0.0 : 0.5};  // lines along the edges
  Mesh mesh = build_mesh(scene, card);
  const Flexure flexure = strip_flexure(bender, constant(rigidity), card, shear);
  const std::vector<char> free(mesh.node_count(), 0);
  StaticFabric plate(std::move(mesh), card, {}, flexure, free);
  const double half = 0.5 * side;
  const std::array<int, 4> corner = {plate.node_at(-half, -half), plate.node_at(half, -half), plate.node_at(half, half),
                                     plate.node_at(-half, half)};
  for (const int n : {0, 1, 3}) plate.hold(corner[n], 2);
  plate.hold(corner[0], 0);
  plate.hold(corner[0], 1);
  plate.hold(corner[1], 1);
  const auto twist = [&](const StaticFabric& /*fabric*/, NodalLoads& loads) {
    for (int n = 0; n < 4; ++n) loads.force[corner[n]][2] += n % 2 == 0 ? load : -load;
  };
  const double residual = plate.relax(twist);
  return relative(plate.position(corner[2])[2], load * side * side / (4.0 * flexure.twist), residual);
}

}  // namespace

// A shell's twisting moment P/2 ends at the edge in a transverse shear force P/2, which the edge's line bears over the
// width h/2 it stands for: the edge's slope gains P/(G h) on its directors, and the corner 2 a P/(G h).
Measured plate_twist(Bender bender, int cells) {
  const Measured m = twisted_plate(bender, cells, stiff_shear);
  if (bender != Bender::shell) return m;
  const double side = 0.5 * length, spacing = side / cells;
  return relative(m.measured, m.exact * (1.0 + 8.0 * 0.2 / (stiff_shear * side * spacing)), m.residual);
}

Measured plate_twist_sheared(Bender bender, int cells) {
  return twisted_plate(bender, cells, 0.5);
}

// A law that yields as bundles do whose fibres begin to slide: the tangent falls smoothly to a twentieth,
//   M' = end + (first - end) (1 - kappa/joint)^2  up to the joint, end beyond.
Measured yielding_strip(Bender bender, int cells) {
  constexpr double first = 20.0, end = 1.0, joint = 0.04, drop = first - end;  // N mm (N mm^2 of a yarn), 1/mm
  const TangentLaw law({{0.0, joint, {first, -2.0 * drop / joint, drop / (joint * joint)}},
                        {joint, std::numeric_limits<double>::infinity(), {end}}});
  Cantilever c =
      bender == Bender::yarn ? yarn_cantilever(cells, law) : strip_cantilever(bender, cells, law, stiff_shear);
  const double scale = c.stiffness / first;
  const auto curvature = [=](double moment) {
    const double m = std::abs(moment) / scale, at_joint = end * joint + drop * joint / 3.0;
    if (m > at_joint) return std::copysign(joint + (m - at_joint) / end, moment);
    double kappa = m / first;  // Newton's method from the stiff side
    for (int n = 0; n < 20; ++n) {
      const double rest = 1.0 - kappa / joint;
      kappa += (m - end * kappa - drop * joint / 3.0 * (1.0 - rest * rest * rest)) / (end + drop * rest * rest);
    }
    return std::copysign(kappa, moment);
  };
  Rod rod{.length = c.length, .curvature = curvature};
  rod.weight = 2.5 * c.stiffness / std::pow(c.length, 3);
  return tip_error(c, solve_rod(rod, 1000), weight({0.0, 0.0, -rod.weight / c.weight}));
}

Measured strip_of_law(Bender bender, int cells, const BendingLaw& law, const std::function<double(double)>& curvature,
                      double overhang, double weight_of_area) {
  Cantilever c = strip_cantilever(bender, cells, law, stiff_shear, 0.0, overhang, 4);
  const double width = c.stiffness / law.face().tangent(0.0);
  const Rod rod{.length = overhang,
                .curvature = [&](double moment) { return curvature(moment / width); },
                .weight = weight_of_area * width};
  const auto shape = solve_rod(rod, 2000);
  start_at(c, shape);
  const double residual = c.fabric->relax(weight({0.0, 0.0, -rod.weight / c.weight}));
  return relative(-c.fabric->position(c.tip)[2], shape.drop.back(), residual);
}

Measured cut_strip(Bender bender, int cells) {
  Cantilever c = strip_cantilever(bender, cells, constant(rigidity), stiff_shear, 0.4);
  Rod rod = linear_rod(c);
  rod.weight = 20.0 * c.stiffness / std::pow(c.length, 3);
  return tip_error(c, solve_rod(rod), weight({0.0, 0.0, -rod.weight / c.weight}));
}

}  // namespace weaveform::test
