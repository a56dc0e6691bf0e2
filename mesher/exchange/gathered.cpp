#include "mesher/exchange/gathered.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>

#include "core/error.hpp"
#include "mesher/scene/grip_direction.hpp"

namespace weaveform::foreign {

namespace {

std::vector<YarnGroup> group_yarns(const Mesh& mesh) {
  std::vector<YarnGroup> groups;
  std::array<int, 2> count = {0, 0}, idle_count = {0, 0};
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const auto family = static_cast<std::size_t>(mesh.yarns.family[e]);
    const bool idle = mesh.yarns.softening[e] <= 0.0;
    const double whole = mesh.yarns.section[e];
    const double section = whole * (idle ? idle_share : mesh.yarns.softening[e]);
    const double stretch = 1.0 + mesh.yarns.jaw[e] / mesh.yarns.rest_length[e];
    const auto agree = [](double a, double b) { return std::abs(a - b) <= 1e-9 * b; };
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const YarnGroup& group) {
      return group.family == family && group.idle == idle && agree(group.section, section) &&
             agree(group.whole_section, whole) && agree(group.jaw_stretch, stretch);
    });
    if (same != groups.end()) {
      same->element.push_back(e);
      continue;
    }
    const std::string name = idle ? fmt::format("{}_idle_{}", yarn_families[family], ++idle_count[family])
                                  : fmt::format("{}_{}", yarn_families[family], ++count[family]);
    groups.push_back({name, family, section, whole, stretch, idle, {e}});
  }
  return groups;
}

std::array<double, 3> turned(const std::array<double, 3>& v, double degrees) {
  if (degrees == 0.0) return v;
  const double angle = degrees * std::numbers::pi / 180.0;
  return {std::cos(angle) * v[0] - std::sin(angle) * v[1], std::sin(angle) * v[0] + std::cos(angle) * v[1], v[2]};
}

void gather_grips(const Scene& scene, Gathered& model) {
  for (const auto& spec : scene.grip) {
    if (!spec.free.empty() && scene.blank.orientation != 0.0) {
      model.not_carried.push_back(fmt::format(
          "grip '{}': components left free on a turned blank (blank.orientation) have no world axis; its node set is "
          "written, its motion is not",
          spec.name));
      continue;
    }
    const auto direction = turned(grip_direction(spec), scene.blank.orientation);
    Motion motion{spec.name, {}};
    for (std::size_t c = 0; c < 3; ++c) {
      if (std::find(spec.free.begin(), spec.free.end(), Component{static_cast<int>(c)}) == spec.free.end())
        motion.displacement[c] = spec.travel * direction[c] + 0.0;
    }
    model.grips.push_back(motion);
  }
}

// The base stays, the pulled corner goes along the frame's diagonal, as the solver has it (solver/constraint/picture_frame.hpp).
void gather_frame(const Scene& scene, const Mesh& mesh, Gathered& model) {
  if (!mesh.frame.present() || !scene.frame) return;
  const auto& corner = mesh.frame.corner;
  const auto& x = mesh.nodes.position;
  NodeSet corners{"frame_corners", {corner.begin(), corner.end()}};
  std::sort(corners.node.begin(), corners.node.end());
  model.sets.push_back(std::move(corners));
  model.sets.push_back({"frame_base", {corner[0]}});
  model.sets.push_back({scene.frame->grip, {corner[2]}});
  model.grips.push_back({"frame_base", {0.0, 0.0, 0.0}});
  Motion pulled{scene.frame->grip, {}};
  double diagonal = 0.0;
  for (std::size_t c = 0; c < 3; ++c) diagonal = std::hypot(diagonal, x[corner[2]][c] - x[corner[0]][c]);
  for (std::size_t c = 0; c < 3; ++c) {
    const double part = (x[corner[2]][c] - x[corner[0]][c]) / diagonal;
    pulled.displacement[c] = std::abs(part) < 1e-12 ? 0.0 : scene.frame->travel * part;
  }
  model.grips.push_back(pulled);
  for (std::size_t k = 0; k < 4; ++k) model.members.push_back({{corner[k], corner[(k + 1) % 4]}});
}

void gather_tools(const Scene& scene, const std::vector<Tool>& tools, Gathered& model) {
  for (std::size_t k = 0; k < tools.size(); ++k) {
    ToolMotion motion{tools[k], &scene.tools[k], {}};
    for (std::size_t c = 0; c < 3; ++c) motion.travel[c] = motion.spec->travel * motion.tool.direction[c] + 0.0;
    model.tools.push_back(std::move(motion));
  }
}

double polygon_area(const Mesh& mesh, int cell) {
  std::array<double, 3> sum = {0.0, 0.0, 0.0};
  const auto& x = mesh.flat_positions();
  const int begin = mesh.cells.offset[cell], end = mesh.cells.offset[cell + 1];
  const auto& o = x[mesh.cells.node[begin]];
  for (int k = begin + 1; k + 1 < end; ++k) {
    std::array<double, 3> a{}, b{};
    for (std::size_t c = 0; c < 3; ++c) {
      a[c] = x[mesh.cells.node[k]][c] - o[c];
      b[c] = x[mesh.cells.node[k + 1]][c] - o[c];
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t d = (c + 1) % 3, e = (c + 2) % 3;
      sum[c] += 0.5 * (a[d] * b[e] - a[e] * b[d]);
    }
  }
  return std::hypot(sum[0], sum[1], sum[2]);
}

// What the mesh holds that no other code knows.
void list_mesh(const Mesh& mesh, std::vector<std::string>& lines) {
  int jaws = 0, soft = 0, idle = 0, many = 0, uneven = 0;
  double longest = 0.0, worst = 0.0;
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    if (mesh.yarns.jaw[e] > 0.0) ++jaws;
    longest = std::max(longest, mesh.yarns.jaw[e]);
    if (mesh.yarns.softening[e] <= 0.0)
      ++idle;
    else if (mesh.yarns.softening[e] < 1.0)
      ++soft;
  }
  for (int c = 0; c < mesh.cells.size(); ++c) {
    if (mesh.cells.offset[c + 1] - mesh.cells.offset[c] > 4) ++many;
    const double off = std::abs(mesh.cells.area[c] / polygon_area(mesh, c) - 1.0);
    if (off > 1e-6) ++uneven;
    worst = std::max(worst, off);
  }
  if (jaws > 0)
    lines.push_back(
        fmt::format("jaws: {} yarn elements reach up to {:.4g} mm into a grip's jaws, N = s(ln((L + jaw)/(L0 + jaw)))",
                    jaws, longest));
  if (soft > 0)
    lines.push_back(
        fmt::format("softening: {} yarn ends carry a part of their force; written as a smaller section", soft));
  if (idle > 0) lines.push_back(fmt::format("free ends: {} yarn elements carry nothing beside their tie", idle));
  if (many > 0)
    lines.push_back(
        fmt::format("cut cells: {} cells of 5 or 6 nodes are written as two shells each that share their "
                    "area; they then shear apart where one cell would not",
                    many));
  if (uneven > 0)
    lines.push_back(
        fmt::format("areas: {} cells at the outline stand for up to {:.3g} % more or less area than their "
                    "nodes span; shells take what they span",
                    uneven, 100.0 * worst));
  lines.push_back(
      "masses: lumped from density and section by the other code; the shifts near the outline that keep "
      "Weaveform's step, and any mass of its own choice, are lost");
  if (!mesh.nodes.flat_position.empty())
    lines.push_back(
        "draped start: nodes are written where they start; another code takes that shape, its lengths and "
        "its angles for unstrained, and the flat blank is lost");
}

void list_scene(const Scene& scene, std::vector<std::string>& lines) {
  if (scene.model.cell == CellElement::rotation_free)
    lines.push_back(
        "model.cell = \"rotation-free\": bending over neighbouring cells without rotations has no element "
        "elsewhere; written as shells");
  if (scene.model.yarn == YarnElement::beam)
    lines.push_back(
        "beams: yarns are pinned where they cross yet each runs on; where they share a node another code "
        "joins their rotations");
  if (scene.model.formulation != Formulation::energy)
    lines.push_back(
        fmt::format("model.formulation = \"{}\": cells are written by their energy, which differs in the "
                    "part of the shear force along the yarns",
                    name_of(scene.model.formulation)));
  lines.push_back("analysis: damping, yarn viscosity and step control are not written");
  if (!scene.measure.empty()) lines.push_back("measures are not written");
}

}  // namespace

double Gathered::yarn_density(std::size_t family) const {
  return card.yarn[family].linear_density / card.yarn[family].section;
}

double Gathered::shell_density() const {
  return shell_mass_share * card.area_density() / mesh.thickness;
}

double Gathered::member_section() const {
  return scene.frame ? scene.frame->section : 0.0;
}

double Gathered::member_density() const {
  return scene.frame ? scene.frame->density * scene.frame->mass_scale : 0.0;
}

int Gathered::set_number(const std::string& name) const {
  for (std::size_t s = 0; s < sets.size(); ++s)
    if (sets[s].name == name) return static_cast<int>(s) + 1;
  return 0;
}

std::array<double, 2> Gathered::second_moments(const YarnGroup& group) const {
  const YarnCard& yarn = card.yarn[group.family];
  const double modulus = yarn.linear_modulus * scene.model.yarn_stiffness_scale;
  const double count = group.section / yarn.section;
  if (scene.model.yarn_bending)
    return {count * (*scene.model.yarn_bending)[0] / modulus, count * (*scene.model.yarn_bending)[1] / modulus};
  if (yarn.bending_out_of_plane.empty())
    throw InputError(fmt::format(
        "model.yarn = \"beam\": card '{}' gives no bending_out_of_plane for its yarns; add it to the card, or "
        "set model.yarn_bending = [in plane, out of plane] (N mm^2)",
        card.name));
  return {count * yarn.bending_in_plane.tangent(0.0) / modulus,
          count * yarn.bending_out_of_plane.first_stiffness() / modulus};
}

int Gathered::node_beside(int element) const {
  const auto [a, b] = mesh.yarns.node[element];
  const auto& x = mesh.flat_positions();
  int best = -1;
  double most = 1e-6;  // mm^2
  for (const Shell& shell : shells) {
    if (std::find(shell.node.begin(), shell.node.end(), a) == shell.node.end()) continue;
    for (int c = 0; c < shell.size(); ++c) {
      const auto& p = x[shell.node[c]];
      const double area = std::abs((x[b][0] - x[a][0]) * (p[1] - x[a][1]) - (x[b][1] - x[a][1]) * (p[0] - x[a][0]));
      if (area > most) most = area, best = shell.node[c];
    }
  }
  return best;
}

std::vector<Shell> shells_of(const MeshCells& cells) {
  std::vector<Shell> shells;
  for (int c = 0; c < cells.size(); ++c) {
    const int* node = cells.node.data() + cells.offset[c];
    const int size = cells.offset[c + 1] - cells.offset[c];
    for (int k = 1; k + 1 < size; k += 2)
      shells.push_back({{node[0], node[k], node[k + 1], k + 2 < size ? node[k + 2] : -1}, c});
  }
  return shells;
}

Gathered gather(const Scene& scene, const Card& card, const Mesh& mesh, const std::vector<Tool>& tools, double duration,
                const std::string& written_by) {
  Gathered model{scene, card, mesh, duration, written_by, group_yarns(mesh), shells_of(mesh.cells), {},
                 {},    {},   {},   {},       {}};
  const double angle = scene.blank.yarn_angle + scene.blank.orientation;
  model.direction = {turned({1.0, 0.0, 0.0}, angle), turned({0.0, 1.0, 0.0}, angle)};
  list_mesh(mesh, model.not_carried);
  list_scene(scene, model.not_carried);
  model.sets = mesh.sets;
  gather_grips(scene, model);
  gather_frame(scene, mesh, model);
  gather_tools(scene, tools, model);
  return model;
}

namespace {

void add_pieces(const TangentLaw& law, const std::string& of, const std::string& against,
                std::vector<Constant>& constants) {
  // endless pieces: a strain no fabric reaches
  constexpr double endless = 1e3;
  constants.push_back(
      {static_cast<double>(law.pieces().size()), "pieces of the tangent law of " + of + " against " + against});
  int number = 0;
  for (const auto& piece : law.pieces()) {
    const std::string name = fmt::format("piece {} of {}: ", ++number, of);
    constants.push_back({std::max(piece.from, -endless), name + "from strain"});
    constants.push_back({std::min(piece.to, endless), name + "to strain (1000: no end)"});
    constants.push_back({static_cast<double>(piece.coefficient.size()), name + "number of coefficients"});
    for (std::size_t n = 0; n < piece.coefficient.size(); ++n)
      constants.push_back({piece.coefficient[n], name + fmt::format("coefficient of strain^{} (MPa)", n)});
  }
}

}  // namespace

std::vector<Constant> yarn_constants(const Gathered& model, std::size_t family) {
  const YarnCard& yarn = model.card.yarn[family];
  const ModelSpec& spec = model.scene.model;
  const bool compression = spec.yarn != YarnElement::seatbelt || spec.partner == SeatbeltPartner::compression;
  std::vector<Constant> constants = {
      {spec.yarn_stiffness_scale, "factor on all moduli"},
      {spec.section == Section::incompressible ? 1.0 : 0.0,
       "1: incompressible section, N = s(e) A L0/L; 0: N = s(e) A"},
      {compression ? 1.0 : 0.0, "1: carries compression; 0: does not"},
      {spec.compression_modulus.value_or(yarn.compression_modulus), "compression modulus (MPa), e < 0"},
      {yarn.linear_modulus, "linear modulus (MPa), of the last piece"},
      {yarn.linear_density, "linear density of one yarn (tonne/mm)"},
      {yarn.section, "section of one yarn (mm^2)"}};
  add_pieces(yarn.tension, "tension", "true strain e >= 0; stress is its integral from 0", constants);
  if (compression && !spec.compression_modulus && !yarn.compression.pieces().empty())
    add_pieces(yarn.compression, "compression", "|e|; instead of the modulus", constants);
  return constants;
}

std::vector<Constant> shear_constants(const Gathered& model) {
  const ShearCard& shear = model.card.shear;
  std::vector<Constant> constants = {
      {shear.start.plateau, "plateau of the start (MPa): added stress plateau g/(g + rise)"},
      {shear.start.rise, "rise of the start (1)"},
      {shear.valid_to_deg, "shear angle the law is meant to hold to (deg)"}};
  add_pieces(shear.tangent, "shear", "logarithmic shear strain atanh(sin gamma); contravariant stress is its integral",
             constants);
  return constants;
}

void amend(std::vector<std::string>& lost, const std::string& begin, const std::string& addition) {
  for (auto& line : lost)
    if (line.rfind(begin, 0) == 0) line += addition;
}

void replace(std::vector<std::string>& lost, const std::string& begin, const std::string& line) {
  for (auto& old : lost)
    if (old.rfind(begin, 0) == 0) old = line;
}

void list_frame(const Gathered& model, std::vector<std::string>& lost) {
  if (model.members.empty()) return;
  lost.push_back(
      "shear frame: its members are single elements pinned at the corners (node set frame_corners), with the stiffness "
      "and mass of [frame]; the base (frame_base) stays and the pulled corner moves");
  if (model.scene.frame->rigid)
    lost.push_back("frame.rigid: the members stretch by the modulus and section of [frame]");
}

void list_coupling(const Gathered& model, std::vector<std::string>& lost) {
  if (model.card.shear.tension_coupling > 0.0)
    lost.push_back("tension_coupling of the card: shear there knows nothing of the yarns' tension");
}

void list_user_materials(const Gathered& model, std::vector<std::string>& lost) {
  const ModelSpec& spec = model.scene.model;
  lost.push_back(
      "formulation: cell forces come from the other code's own element and a user material that has to be supplied; "
      "the constants say what it must do");
  if (spec.yarn_law != YarnLaw::card)
    lost.push_back(
        fmt::format("model.yarn_law = \"{}\": the constants are those of the card's own law", name_of(spec.yarn_law)));
  lost.push_back(
      "jaws and softening: elements in a grip's jaws are written without them and so stiffer; softened ends "
      "weigh less by their smaller section");
}

double smooth_way(double s) {
  return s * s * s * (10.0 + s * (6.0 * s - 15.0));  // Abaqus's SMOOTH STEP, and Weaveform's
}

double tool_way(const ToolSpec& tool, double s) {
  if (tool.speed.empty()) return smooth_way(s);
  double until = 0.0, whole = 0.0;  // integrals of the piecewise linear speed to s and to 1
  for (std::size_t k = 0; k + 1 < tool.speed.size(); ++k) {
    const double a = tool.speed[k][0], b = tool.speed[k + 1][0];
    const double u = tool.speed[k][1], v = tool.speed[k + 1][1];
    whole += 0.5 * (u + v) * (b - a);
    if (s <= a || b <= a) continue;
    const double t = (std::min(s, b) - a) / (b - a);
    until += (b - a) * t * (u + 0.5 * t * (v - u));
  }
  return whole > 0.0 ? until / whole : 0.0;
}

std::string fit(double value, std::size_t width) {
  value += 0.0;  // no "-0"
  std::string text = fmt::format("{}", value);
  for (int digits = 17; text.size() > width && digits > 0; --digits) text = fmt::format("{:.{}g}", value, digits);
  return text;
}

std::string plain_name(const std::string& name) {
  std::string plain = name;
  for (char& c : plain)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  if (plain.empty() || std::isalpha(static_cast<unsigned char>(plain[0])) == 0) plain = "n_" + plain;
  return plain;
}

std::string header(const Gathered& model, const std::string& mark, const std::vector<std::string>& not_carried) {
  const Mesh& mesh = model.mesh;
  std::string text = fmt::format("{} Written by {}\n", mark, model.written_by);
  text += fmt::format("{} Scene {}, material {}; units mm, s, N, MPa, tonne\n", mark,
                      model.scene.file.empty() ? "in memory" : model.scene.file, model.card.name);
  text +=
      fmt::format("{} {} nodes, {} yarn elements (1 to {}), {} shells (from {}) of {} cells\n", mark, mesh.node_count(),
                  mesh.yarn_count(), mesh.yarn_count(), model.shells.size(), model.first_shell(), mesh.cells.size());
  text += fmt::format("{} Not carried by this format, or carried in part:\n", mark);
  for (const auto& line : not_carried) text += fmt::format("{}  - {}\n", mark, line);
  return text;
}

}  // namespace weaveform::foreign
