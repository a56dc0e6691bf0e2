// What the user asked for: the scene as plain data. Units: mm, s, N, MPa, tonne; angles in degrees (a scene is a file).
// The defaults below are the only place where defaults are written; the _keys.cpp name each key, its unit, type and
// range.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mesher/scene/choices.hpp"

namespace weaveform {

// A number the program chooses from the scene unless the user gives it ("auto" in the file).
using Auto = std::optional<double>;

struct FabricSpec {
  std::string material = "twintex-pw";  // built-in card name, or path of a card file (relative to the scene file)
  FabricFace face = FabricFace::up;     // which way its face looks: for cards that bend otherwise in the other sense
  bool operator==(const FabricSpec&) const = default;
};

struct BlankSpec {
  BlankShape shape = BlankShape::rectangle;
  std::array<double, 2> size = {115.0, 230.0};  // mm; extent along the blank's own x and y axes
  double yarn_angle = 45.0;                     // deg; from the blank's x axis to the warp direction, counter-clockwise
  std::array<double, 2> coarsening = {1.0, 1.0};  // yarns per model yarn, for warp and for weft yarns
  bool coarsening_open = false;                   // "auto": the program takes it (mesher/automatic)
  std::array<double, 2> phase = {
      0.0, 0.0};  // intervals; shift of the warp and weft lines; 0 puts a crossing at the blank's centre
  std::vector<std::vector<double>> corners;      // mm; of a polygon, [x, y] each, blank frame
  std::string outline;                           // file of the outline; relative to the scene file
  std::optional<LengthUnit> outline_unit;        // of that file; none: its own, or mm
  std::vector<std::string> outline_layers;       // of a DXF drawing; none: all that are on
  Auto arm_width;                                // mm; of a cross
  std::optional<std::array<double, 2>> on_roll;  // mm; where the centre lies on the roll; none: lines by phase and fit
  LineFit fit = LineFit::grips;  // grips: spacing (within 15 %) and phase meet the ends of the gripped edges
  double orientation = 0.0;      // deg; turns the whole blank (outline, yarns, grips, measures) in the plane
  std::array<double, 3> position = {0.0, 0.0, 0.0};  // mm; where the blank's centre lies in the world
  bool operator==(const BlankSpec&) const = default;
};

struct ModelSpec {
  YarnElement yarn = YarnElement::truss;
  bool yarn_open = false;                           // "auto": the program takes it, as `cell` (mesher/automatic)
  SeatbeltPartner partner = SeatbeltPartner::none;  // beside a seatbelt: an element that carries compression only
  CellElement cell = CellElement::membrane;
  bool cell_open = false;
  Formulation formulation = Formulation::energy;
  Thickness thickness = Thickness::constant_volume;
  ContactThickness contact_thickness = ContactThickness::card;
  Section section = Section::incompressible;
  YarnLaw yarn_law = YarnLaw::card;   // linear: the card's linear modulus from zero strain on (decrimping taken out)
  Auto slack;                         // 1; true strain before a yarn carries; auto: ln(1 + crimp) of its family
  double yarn_stiffness_scale = 1.0;  // factor on all yarn moduli
  Auto compression_modulus;           // MPa; for e < 0, in place of the card's modulus or law; auto: the card's
  SymmetryUse symmetry = SymmetryUse::automatic;
  std::optional<std::array<double, 2>>
      yarn_bending;  // N mm^2; of one yarn, in plane and out of plane; none: the card's
  std::optional<std::array<double, 3>> cell_bending;      // N mm; warp, weft, twist; none: from the card (flexure.hpp)
  std::optional<std::array<double, 2>> bending_friction;  // N mm, 1/mm; of one yarn; none: the card's
  Auto transverse_shear;                                  // N/mm; of shell cells; none: the card's
  bool operator==(const ModelSpec&) const = default;
};

// A seatbelt without its partner carries none.
[[nodiscard]] inline bool carries_compression(const ModelSpec& model) {
  return model.yarn != YarnElement::seatbelt || model.partner == SeatbeltPartner::compression;
}

// Whether anything resists bending out of the plane.
[[nodiscard]] inline bool has_bending(const ModelSpec& model) {
  return model.yarn == YarnElement::beam || model.cell != CellElement::membrane;
}

// One ply of a stack. What its table leaves out is that of [blank], [fabric] and [model].
struct PlySpec {
  std::string name;
  FabricSpec fabric;
  BlankSpec blank;  // its own position is the one below
  ModelSpec model;  // symmetry is the whole scene's
  // mm; of the blank's centre, in its middle plane; none: on the ply before, the first where [blank] is
  std::optional<std::array<double, 3>> position;
  bool operator==(const PlySpec&) const = default;
};

// What two plies of a stack have of their own.
struct PairSpec {
  std::vector<std::string> plies;  // two names
  Auto friction;                   // 1; none: the stack's, and so on
  std::string friction_law;
  Auto gap;  // mm
  std::string compaction;
  bool operator==(const PairSpec&) const = default;
};

// How the plies of a stack lie and slide on each other.
struct StackSpec {
  double friction = 0.0;     // 1; Coulomb coefficient between plies
  std::string friction_law;  // CSV file of slip (mm) and shear stress (MPa), beside Coulomb; relative to the scene file
  double gap = 0.0;          // mm; between the faces of plies at the start, where the scene does not place them
  std::string compaction;    // CSV file of approach (mm) and pressure (MPa); none: faces that hardly give way
  std::vector<PairSpec> pair;
  bool operator==(const StackSpec&) const = default;
};

struct GripSpec {
  std::string name;
  std::optional<BlankEdge> edge;             // none when box is given
  std::optional<std::array<double, 4>> box;  // mm; xmin, ymin, xmax, ymax in the blank's frame (centre = origin)
  double travel = 0.0;                       // mm; along direction, smooth-step over the duration
  std::optional<std::array<double, 3>>
      direction;                        // blank frame; default: outward normal of the edge, (0, 1, 0) for a box
  std::vector<Component> free;          // components left free, blank's frame
  std::vector<std::string> plies = {};  // of a stack, that it holds; none: all that have something there
  bool operator==(const GripSpec&) const = default;
};

// A pin-jointed shear frame around a square blank whose yarns run on to the frame through arms without cross yarns.
struct FrameSpec {
  double length = 216.0;           // mm; L_F, between the pins
  double travel = 60.0;            // mm; of the pulled corner along the diagonal, smooth step
  std::string grip = "crosshead";  // name of the pulled corner
  bool rigid = false;              // members that do not stretch and have no mass: one degree of freedom, the travel
  double section = 500.0;          // mm^2; of a member
  double modulus = 70000.0;        // MPa; aluminium
  double density = 2.7e-9;         // tonne/mm^3; aluminium
  double mass_scale = 1.0;         // factor on the members' mass; the change is reported
  int turn = 0;  // of a stack's ply, no key: quarter turns, 0 to 3, of its yarns against those of the lowest
  bool operator==(const FrameSpec&) const = default;
};

// A rigid tool. It does not turn; it travels, is pushed by a force, or stays.
struct ToolSpec {
  std::string name;                                // of its table, [tools.NAME]
  ToolShape shape = ToolShape::plane;              // must be given
  std::optional<std::array<double, 3>> position;   // mm; of the shape's origin; none: touching the flat blank
  std::array<double, 3> axis = {0.0, 0.0, 1.0};    // outward normal of a plane or ring, shank of a sphere, ...
  Auto radius;                                     // mm; sphere, cylinder
  Auto opening_radius;                             // mm; ring
  double fillet_radius = 0.0;                      // mm; ring: of the opening's rim
  std::vector<std::vector<double>> profile;        // mm; revolved: corners (mesher/tools/profile.hpp)
  std::string file;                                // triangles: STL, CAD or .inp, relative to the scene file
  Auto chord_tolerance;                            // mm; triangles from CAD: greatest distance from the true surface
  std::optional<LengthUnit> unit;                  // of the file; none: mm, and checked
  bool flip = false;                               // triangles: turn the surface over, its inside out
  double travel = 0.0;                             // mm; along direction over the duration
  std::optional<std::array<double, 3>> direction;  // of travel or force; none: the way the tool faces
  std::vector<std::vector<double>> speed;          // [part of the duration, relative speed] points; none: smooth step
  Auto force;                                      // N; pushes the tool along direction, which then moves as it must
  Auto mass;                                       // tonne; of a tool pushed by a force; none: that of the blank
  double damping = 1000.0;  // 1/s; of a tool pushed by a force: viscous force = damping * mass * speed
  double friction = 0.0;    // 1; Coulomb coefficient
  Auto offset;              // mm; from the fabric's middle plane to its face; none: half the thickness
  bool operator==(const ToolSpec&) const = default;
};

// The blank starts draped over a tool: a pin-jointed net of inextensible yarns (mesher/drape/).
struct DrapeSpec {
  std::string tool;                                     // name of its table, [tools.NAME]
  std::array<double, 2> anchor = {0.0, 0.0};            // mm; blank's frame: the nearest crossing is laid on the seed
  std::optional<std::array<double, 3>> seed;            // mm; world; none: the anchor projected on the tool
  std::array<double, 3> projection = {0.0, 0.0, -1.0};  // way of that projection
  std::optional<std::array<double, 3>> warp_direction;  // at the seed; none: that of the flat blank
  std::vector<std::vector<double>> warp_curve;          // mm; points of the warp yarn through the seed; none: geodesic
  std::vector<std::vector<double>> weft_curve;          // mm; the same for the weft
  bool operator==(const DrapeSpec&) const = default;
};

struct AnalysisSpec {
  Auto duration;             // s; auto: chosen from the fabric's slowest shear wave (docs/theory.md)
  Auto loading_speed;        // mm/s; greatest speed of any grip; an alternative to duration
  Auto inertia;              // 1; share of the loads that inertia may be: the duration is chosen by it, the run warns
  double step_factor = 0.9;  // fraction of the stable step
  StepBound step_bound = StepBound::reached;
  Precision precision = Precision::double_precision;
  int bending_every = 1;    // steps from one evaluation of bending to the next
  double mass_scale = 1.0;  // factor on the fabric's mass, not on its weight
  Auto contact_stiffness;   // 1; factor on the contact springs of the tools; auto: 0.5, with step_bound "stiffest" 1
  bool curved_contact = false;   // each yarn's kink lifts nodes and bounds friction (solver/contact/chord_kinks.hpp)
  bool step_check = true;        // stop when the step is above the stable one
  Auto damping;                  // 1/s; mass-proportional; auto: chosen from the duration
  double yarn_viscosity = 0.06;  // 1; fraction of critical damping of the yarn elements' highest frequency
  double energy_limit = 0.05;    // the run fails when the energy-balance error passes this fraction
  std::array<double, 3> gravity = {0.0, 0.0, 0.0};  // mm/s^2; acceleration of the fabric by its weight
  double perturbation = 0.0;                        // mm; random in-plane displacement of every free node at the start
  int perturbation_seed = 1;
  double most_hours = 24.0;  // of the solve, as expected before it begins; longer ones need --yes
  Auto most_memory;          // GB; of the process; auto: what is available
  bool operator==(const AnalysisSpec&) const = default;
};

struct OutputSpec {
  int frames = 20;                  // result frames after the initial one
  int history = 200;                // rows of history.csv after the initial one
  double contour_step = 5.0;        // deg; spacing of the shear-angle isolines
  double checkpoint_minutes = 2.0;  // min of wall time between checkpoints; 0: none by time
  bool operator==(const OutputSpec&) const = default;
};

struct MeasureSpec {
  std::string name;
  std::optional<std::array<double, 4>> box;  // mm; xmin, ymin, xmax, ymax, blank frame, initial configuration
  std::optional<std::array<double, 4>>
      relative_box;      // the same in units of the blank's width (size[0]), so that it follows the size
  std::string ply = {};  // of a stack, whose cells it looks at; none: all that have cells there
  bool operator==(const MeasureSpec&) const = default;
};

// What is wanted of the answers, where something is left to the program.
struct AccuracySpec {
  double force = 0.02;  // 1; of a load
  double angle = 1.0;   // deg; of a shear angle over 20 mm or so
  bool operator==(const AccuracySpec&) const = default;
};

// A value that the program took where the scene left it open, as long as the scene has that value.
struct TakenSpec {
  std::string key;     // "blank.coarsening", "ply.upper.cell", "analysis.duration"
  std::string value;   // as in the file
  std::string why;     // one line
  std::string missed;  // what was wanted and is not reached with it; "" when all is
  bool operator==(const TakenSpec&) const = default;
};

struct Scene {
  std::string file;  // where it was read from; "" when built in code
  FabricSpec fabric;
  BlankSpec blank;
  ModelSpec model;
  std::vector<PlySpec> ply;  // bottom to top along the blank's normal; none: the one of fabric, blank and model
  StackSpec stack;           // of a scene with plies
  std::vector<GripSpec> grip;
  std::optional<FrameSpec> frame;
  std::vector<ToolSpec> tools;  // in the order of their names
  std::optional<DrapeSpec> drape;
  AnalysisSpec analysis;
  OutputSpec output;
  std::vector<MeasureSpec> measure;
  std::optional<AccuracySpec> accuracy;  // none: its defaults, where anything is open
  std::vector<TakenSpec> taken;          // written by the program (taken.hpp)
  bool operator==(const Scene&) const = default;
};

}  // namespace weaveform
