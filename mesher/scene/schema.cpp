#include "mesher/scene/schema.hpp"

#include <type_traits>

namespace weaveform {
namespace {

const std::vector<Key<FabricSpec>> fabric_keys = {
    key<&FabricSpec::material>(
        {.name = "material",
         .doc = "built-in card (`twintex-pw`, `twintex-tw`) or path of a card file, relative to the scene file"}),
};

const std::vector<Key<BlankSpec>> blank_keys = {
    key<&BlankSpec::shape>({.name = "shape",
                            .doc = "outline of the flat blank: `rectangle`; `disc`, an ellipse of the given extents; "
                                   "`cross`: a square of `arm_width` whose yarns run on into four arms without cross "
                                   "yarns; `polygon` of `corners`; `file`: `outline`, with holes and notches"}),
    key<&BlankSpec::size>({.name = "size",
                           .unit = "mm",
                           .limits = above(0, 1e5),
                           .doc = "extent along the blank's own x and y axes; a polygon and a file have their own"}),
    key<&BlankSpec::corners>({.name = "corners",
                              .unit = "mm",
                              .limits = between(-1e6, 1e6),
                              .doc =
                                  "of a polygon, [x, y] each in the blank's frame, either way around; the last joins "
                                  "the first"}),
    key<&BlankSpec::outline>(
        {.name = "outline",
         .doc = "for shape = \"file\", relative to the scene file: DXF (lines, arcs, polylines, circles, ellipses, "
                "splines), STEP, IGES, BREP or Gmsh script (.geo) with a planar "
                "face or closed curves, chords within 0.01 mm; or CSV with rows x,y (mm, blank's frame), closed "
                "loops (the last point repeats the first) parted by blank lines; a loop inside another is a hole"}),
    key<&BlankSpec::outline_unit>({.name = "outline_unit",
                                   .doc = "of that file; left out: what a DXF drawing ($INSUNITS), STEP or IGES file "
                                          "names, mm where none is named"}),
    key<&BlankSpec::outline_layers>(
        {.name = "outline_layers", .doc = "of a DXF drawing, whose curves bound the blank; left out: all that are on"}),
    key<&BlankSpec::arm_width>({.name = "arm_width",
                                .unit = "mm",
                                .limits = above(0, 1e6),
                                .doc = "of a cross, which needs it; its yarns run "
                                       "along the arms"}),
    key<&BlankSpec::on_roll>({.name = "on_roll",
                              .unit = "mm",
                              .limits = between(-1e6, 1e6),
                              .doc = "where the blank's centre lies on the roll, along warp and weft from a crossing; "
                                     "yarns then lie exactly where the roll has them, in this blank and the next"}),
    key<&BlankSpec::yarn_angle>({.name = "yarn_angle",
                                 .unit = "deg",
                                 .limits = between(-360, 360),
                                 .doc = "from the blank's x axis to the warp direction, counter-clockwise"}),
    key<&BlankSpec::coarsening>({.name = "coarsening",
                                 .unit = "1",
                                 .limits = between(0.05, 100),
                                 .one_for_all = true,
                                 .doc = "yarns per model yarn, for warp and for weft yarns; one number serves both; "
                                        "below 1 refines"}),
    key<&BlankSpec::phase>({.name = "phase",
                            .unit = "1",
                            .limits = between(-1, 1),
                            .doc = "shift of the warp and weft lines in model intervals; 0 puts a crossing at the "
                                   "blank's centre"}),
    key<&BlankSpec::fit>({.name = "fit",
                          .doc = "`grips`: spacing (within 15 %) and phase are chosen so that yarn lines pass through "
                                 "the ends of the gripped edges, which bound the deforming zone; `none`, or a `phase` "
                                 "other than 0: lines exactly as written"}),
    key<&BlankSpec::orientation>({.name = "orientation",
                                  .unit = "deg",
                                  .limits = between(-360, 360),
                                  .doc = "turns the whole blank (outline, yarns, grips, measures) in its plane"}),
    key<&BlankSpec::position>({.name = "position",
                               .unit = "mm",
                               .limits = between(-1e6, 1e6),
                               .doc = "where the blank's centre lies in the world"}),
};

const std::vector<Key<ModelSpec>> model_keys = {
    key<&ModelSpec::yarn>({.name = "yarn",
                           .doc = "element of the yarns: `truss` (the paper's T3D2); `beam` (B31): adds flexural "
                                  "stiffness along each continuous yarn, crossings stay pinned; `seatbelt` carries no "
                                  "compression (the paper's LS-DYNA element)"}),
    key<&ModelSpec::partner>({.name = "partner",
                              .doc = "`compression`: beside every seatbelt an element that carries the card's "
                                     "`compression` law and no tension"}),
    key<&ModelSpec::cell>(
        {.name = "cell",
         .doc = "element of the shear cells: `membrane` (the paper's M3D4R); `rotation-free`: adds bending along warp "
                "and weft and twist from the lattice's curvatures; `shell` (S4R): the same with rotational unknowns "
                "and transverse shear"}),
    key<&ModelSpec::formulation>({.name = "formulation",
                                  .doc = "shear force of a cell: gradient of a stored energy, or the paper's stress "
                                         "(Eq. 9) taken whole; equal for inextensible yarns. For comparison: the "
                                         "paper's stress in increments (Eqs. 8-10), or that in the frame of a side; "
                                         "what they get wrong is in docs/unit_cell.md"}),
    key<&ModelSpec::thickness>({.name = "thickness", .doc = "how a cell's thickness follows its area"}),
    key<&ModelSpec::section>({.name = "section", .doc = "how a yarn's cross-section follows its stretch"}),
    key<&ModelSpec::yarn_law>({.name = "yarn_law",
                               .doc = "tension law: the card's (decrimping, Table 2), or its linear modulus from zero "
                                      "strain on, or that from the slack strain on and nothing before"}),
    key<&ModelSpec::slack>(
        {.name = "slack",
         .unit = "1",
         .limits = between(0, 1),
         .doc = "true strain that yarns stretch before they carry, for `yarn_law = \"slack\"`; "
                "auto: ln(1 + crimp) of the card, each family its own (0 when the card gives no crimp)"}),
    key<&ModelSpec::yarn_stiffness_scale>({.name = "yarn_stiffness_scale",
                                           .unit = "1",
                                           .limits = above(0, 1000),
                                           .doc = "factor on all yarn moduli; below 1 buys a larger step"}),
    key<&ModelSpec::compression_modulus>(
        {.name = "compression_modulus",
         .unit = "MPa",
         .limits = between(0, 1e7),
         .doc = "of the yarns at negative strain, in place of the card's modulus or law (docs/stability.md says how "
                "low and how high it may be); auto: the card's"}),
    key<&ModelSpec::symmetry>({.name = "symmetry",
                               .false_word = "none",
                               .doc =
                                   "`auto`: where blank, fabric, tools and loads are mirrored onto themselves by the "
                                   "planes x = 0 and y = 0 of the blank, a half or a quarter is solved; all results "
                                   "are those of the whole. `half`, `quarter`: an error where that cannot be. `none` "
                                   "or false: the whole blank is solved"}),
    key<&ModelSpec::yarn_bending>({.name = "yarn_bending",
                                   .unit = "N mm^2",
                                   .limits = between(0, 1e9),
                                   .one_for_all = true,
                                   .doc =
                                       "constant flexural stiffness of one yarn, in plane and out of plane, in place "
                                       "of the card's; needs yarn = \"beam\""}),
    key<&ModelSpec::cell_bending>({.name = "cell_bending",
                                   .unit = "N mm",
                                   .limits = between(0, 1e9),
                                   .doc = "constant bending stiffness per width of the cells along warp and weft, and "
                                          "twist, in place of the card's; needs a cell that bends. When left out: the "
                                          "fabric's rigidity less what beams bear of it"}),
    key<&ModelSpec::transverse_shear>({.name = "transverse_shear",
                                       .unit = "N/mm",
                                       .limits = above(0, 1e9),
                                       .doc = "of shell cells, force per width over shear angle; auto: the card's"}),
};

const std::vector<Key<GripSpec>> grip_keys = {
    key<&GripSpec::name>({.name = "name",
                          .required = true,
                          .identifier = true,
                          .doc = "heads the grip's columns in history.csv; names it in `--set grip.NAME.travel=...`"}),
    key<&GripSpec::edge>({.name = "edge", .doc = "the edge of the blank it holds; either this or `box`"}),
    key<&GripSpec::box>({.name = "box",
                         .unit = "mm",
                         .limits = between(-1e6, 1e6),
                         .doc = "holds every node in xmin, ymin, xmax, ymax, blank frame (its centre is the origin)"}),
    key<&GripSpec::travel>({.name = "travel",
                            .unit = "mm",
                            .limits = between(-1e6, 1e6),
                            .doc = "way along `direction`, a smooth step over the duration; 0 holds still"}),
    key<&GripSpec::direction>({.name = "direction",
                               .unit = "1",
                               .limits = between(-1e9, 1e9),
                               .doc = "blank frame, any length but zero; when left out the edge's outward normal, or "
                                      "[0, 1, 0] for a box"}),
    key<&GripSpec::free>({.name = "free", .doc = "components left free, blank frame; the others are prescribed"}),
};

const std::vector<Key<ToolSpec>> tool_keys = {
    key<&ToolSpec::shape>(
        {.name = "shape",
         .required = true,
         .doc = "`plane`; `sphere` with a shank of its radius up the axis; endless `cylinder`; `ring`: a plate with a "
                "rounded opening; `revolved`: a profile turned about the axis; `triangles`: a surface from an STL or "
                "CAD file"}),
    key<&ToolSpec::position>(
        {.name = "position",
         .unit = "mm",
         .limits = between(-1e6, 1e6),
         .doc =
             "of the shape's origin: a point of the plane, the centre of the sphere, a point of the cylinder's axis, "
             "the centre of the ring's face, r = z = 0 of the profile, the origin of the STL file. Left out for a "
             "plane, sphere or ring with its axis along z: touching the flat blank at its centre, a sphere tip "
             "first, a plane or ring by its face"}),
    key<&ToolSpec::axis>({.name = "axis",
                          .unit = "1",
                          .limits = between(-1e9, 1e9),
                          .doc =
                              "outward normal of a plane or of a ring's face; from a sphere's centre into its shank; "
                              "axis of a cylinder or profile; any length but zero. Triangles do not use it"}),
    key<&ToolSpec::radius>(
        {.name = "radius", .unit = "mm", .limits = above(0, 1e6), .doc = "of a sphere or cylinder, which need it"}),
    key<&ToolSpec::opening_radius>(
        {.name = "opening_radius", .unit = "mm", .limits = above(0, 1e6), .doc = "of a ring, which needs it"}),
    key<&ToolSpec::fillet_radius>(
        {.name = "fillet_radius", .unit = "mm", .limits = between(0, 1e6), .doc = "of the rim of a ring's opening"}),
    key<&ToolSpec::profile>(
        {.name = "profile",
         .unit = "mm",
         .limits = between(-1e6, 1e6),
         .doc =
             "of a revolved tool: corners in the half-plane (r, z) with the material on the left: [r, z] a line "
             "leads here, [r, z, radius] a rounded corner, [r, z, cr, cz] an arc about (cr, cz) leads here; the first "
             "and last line go on for ever beyond an end off the axis"}),
    key<&ToolSpec::file>(
        {.name = "file",
         .doc = "surface of a tool of triangles, relative to the scene file: STL (outside counter-clockwise), CAD "
                "(STEP, IGES, BREP, Gmsh's .geo) or the shells of an Abaqus .inp (these are made to face outward, open "
                "ones to the blank)"}),
    key<&ToolSpec::chord_tolerance>(
        {.name = "chord_tolerance",
         .unit = "mm",
         .limits = between(1e-4, 1e3),
         .doc = "of triangles made from CAD: greatest distance from the true surface. Left out: a "
                "hundredth of a cell's shorter edge"}),
    key<&ToolSpec::unit>(
        {.name = "unit",
         .doc = "of an STL, BREP, .geo or .inp file, which name none; left out: mm, and refused when the tool is then "
                "out of all proportion to the blank. STEP and IGES bring their own"}),
    key<&ToolSpec::flip>({.name = "flip", .doc = "turns a surface of triangles over, its inside out"}),
    key<&ToolSpec::travel>({.name = "travel",
                            .unit = "mm",
                            .limits = between(-1e6, 1e6),
                            .doc = "way along `direction` over the duration; 0 stays, or follows `force`"}),
    key<&ToolSpec::direction>(
        {.name = "direction",
         .unit = "1",
         .limits = between(-1e9, 1e9),
         .doc =
             "of travel, force and of the force recorded in history.csv; any length but zero. Left out: the axis of a "
             "plane or ring (the way it faces), against the axis of a sphere, [0, 0, -1] for the others"}),
    key<&ToolSpec::speed>({.name = "speed",
                           .unit = "1",
                           .limits = between(0, 1e9),
                           .doc =
                               "points [part of the duration, relative speed], joined by straight lines and scaled so "
                               "that the way is `travel`; left out: smooth step"}),
    key<&ToolSpec::force>({.name = "force",
                           .unit = "N",
                           .limits = between(0, 1e9),
                           .doc = "pushes the tool along `direction`, all of it after the first 3 % of the duration; "
                                  "it moves as the fabric lets it, along "
                                  "`direction` only"}),
    key<&ToolSpec::mass>(
        {.name = "mass",
         .unit = "tonne",
         .limits = above(0, 1e6),
         .doc = "of a tool pushed by a force; auto: that of the blank, four times that with `step_bound = "
                "\"reached\"`, which neither sets the step nor lags behind it"}),
    key<&ToolSpec::damping>(
        {.name = "damping",
         .unit = "1/s",
         .limits = between(0, 1e9),
         .doc = "of a tool pushed by a force: viscous force on it over its mass and speed; its work is reported"}),
    key<&ToolSpec::friction>(
        {.name = "friction", .unit = "1", .limits = between(0, 10), .doc = "Coulomb coefficient of tool and fabric"}),
    key<&ToolSpec::offset>({.name = "offset",
                            .unit = "mm",
                            .limits = between(0, 1e6),
                            .doc = "from the fabric's middle plane to its face; auto: half the fabric's thickness"}),
};

const std::vector<Key<DrapeSpec>> drape_keys = {
    key<&DrapeSpec::tool>({.name = "tool",
                           .required = true,
                           .identifier = true,
                           .doc = "name of the tool it lies on, [tools.NAME], where that stands at the start"}),
    key<&DrapeSpec::anchor>({.name = "anchor",
                             .unit = "mm",
                             .limits = between(-1e6, 1e6),
                             .doc = "point of the flat blank, blank frame; the crossing nearest to it is laid on the "
                                    "seed"}),
    key<&DrapeSpec::seed>({.name = "seed",
                           .unit = "mm",
                           .limits = between(-1e6, 1e6),
                           .doc = "point of the tool's surface, world; left out: the anchor, projected on the tool "
                                  "along `projection`"}),
    key<&DrapeSpec::projection>({.name = "projection",
                                 .unit = "1",
                                 .limits = between(-1e9, 1e9),
                                 .doc =
                                     "way of that projection, any length but zero; the first surface met from outside "
                                     "counts"}),
    key<&DrapeSpec::warp_direction>(
        {.name = "warp_direction",
         .unit = "1",
         .limits = between(-1e9, 1e9),
         .doc = "of the warp at the seed; its part along the surface counts; left out: as in the flat blank"}),
    key<&DrapeSpec::warp_curve>({.name = "warp_curve",
                                 .unit = "mm",
                                 .limits = between(-1e6, 1e6),
                                 .doc =
                                     "points [x, y, z] of a line through the seed that the warp yarn follows, in the "
                                     "warp's sense; they are moved to the surface; left out: a geodesic, which also "
                                     "goes on beyond the line's ends"}),
    key<&DrapeSpec::weft_curve>(
        {.name = "weft_curve", .unit = "mm", .limits = between(-1e6, 1e6), .doc = "the same for the weft yarn"}),
};

const std::vector<Key<AnalysisSpec>> analysis_keys = {
    key<&AnalysisSpec::duration>(
        {.name = "duration",
         .unit = "s",
         .limits = above(0, 1e9),
         .doc = "time over which the grips travel; auto: from the fabric's slowest shear wave, or, where nothing acts "
                "but gravity, until the slowest sway has come to rest"}),
    key<&AnalysisSpec::loading_speed>({.name = "loading_speed",
                                       .unit = "mm/s",
                                       .limits = above(0, 1e9),
                                       .doc = "greatest speed of any grip; an alternative to `duration`"}),
    key<&AnalysisSpec::yarn_viscosity>(
        {.name = "yarn_viscosity",
         .unit = "1",
         .limits = between(0, 1),
         .doc = "axial viscosity of the yarns as a fraction of critical damping at their elements' highest frequency; "
                "keeps "
                "yarns that jump between tension and slackness from making energy out of rounding noise"}),
    key<&AnalysisSpec::step_factor>(
        {.name = "step_factor", .unit = "1", .limits = between(1e-4, 4), .doc = "fraction of the stable step"}),
    key<&AnalysisSpec::step_bound>(
        {.name = "step_bound",
         .doc =
             "stiffness of the yarns that the stable step is taken from: `stiffest`, the law's greatest up to a true "
             "strain of 0.5; `reached`, the greatest at strains that yarns have reached so far, watched at every "
             "step: two to three times fewer steps where they decrimp (docs/accuracy.md)"}),
    key<&AnalysisSpec::bending_every>(
        {.name = "bending_every",
         .unit = "1",
         .limits = between(1, 16),
         .doc =
             "steps from one evaluation of bending to the next (of beams and rotation-free cells, which are far softer "
             "than yarns in tension); its force then acts as an impulse of so many steps. 4 takes bending off the "
             "bill"}),
    key<&AnalysisSpec::mass_scale>(
        {.name = "mass_scale",
         .unit = "1",
         .limits = between(1e-4, 1e6),
         .doc =
             "factor on the fabric's mass, not on its weight: above 1 the step grows with its root, and inertia with "
             "it, as if loaded that much faster; the mass added is in the summary"}),
    key<&AnalysisSpec::contact_stiffness>(
        {.name = "contact_stiffness",
         .unit = "1",
         .limits = above(0, 1),
         .doc = "factor on the stiffness of contact: below 1 the fabric sinks further into the tools (the greatest "
                "penetration is in the summary), and contact takes less of the step; auto: 1, and 0.5 with "
                "`step_bound = \"reached\"`"}),
    key<&AnalysisSpec::step_check>({.name = "step_check", .doc = "stop when the step is above the stable one"}),
    key<&AnalysisSpec::damping>(
        {.name = "damping",
         .unit = "1/s",
         .limits = between(0, 1e9),
         .doc = "mass-proportional damping; auto: chosen from the duration; critical for the slowest "
                "sway where nothing acts but gravity"}),
    key<&AnalysisSpec::energy_limit>({.name = "energy_limit",
                                      .unit = "1",
                                      .limits = above(0, 1),
                                      .doc = "the run fails when the energy-balance error passes this fraction"}),
    key<&AnalysisSpec::gravity>({.name = "gravity",
                                 .unit = "mm/s2",
                                 .limits = between(-1e10, 1e10),
                                 .doc = "acceleration of the fabric by its weight, world frame"}),
    key<&AnalysisSpec::perturbation>({.name = "perturbation",
                                      .unit = "mm",
                                      .limits = between(0, 1000),
                                      .doc = "random in-plane displacement of every free node at the start"}),
    key<&AnalysisSpec::perturbation_seed>(
        {.name = "perturbation_seed", .unit = "1", .limits = at_least(0), .doc = "same seed, same displacements"}),
    key<&AnalysisSpec::most_hours>(
        {.name = "most_hours",
         .unit = "h",
         .limits = above(0, 1e5),
         .doc = "a solve that is expected to take longer does not begin, unless `--yes` says so; expected from "
                "cells, steps and, near the limit, the time that a few steps take here"}),
    key<&AnalysisSpec::most_memory>(
        {.name = "most_memory",
         .unit = "GB",
         .limits = above(0, 1e6),
         .doc = "the same for the memory that mesh and solve are expected to take; auto: what the machine has "
                "available (and the limits set for the process allow)"}),
};

const std::vector<Key<FrameSpec>> frame_keys = {
    key<&FrameSpec::length>(
        {.name = "length", .unit = "mm", .limits = above(0, 1e6), .doc = "side of the frame between its pins"}),
    key<&FrameSpec::travel>(
        {.name = "travel",
         .unit = "mm",
         .limits = between(-1e6, 1e6),
         .doc = "of the pulled corner along the frame's diagonal, a smooth step over the duration"}),
    key<&FrameSpec::grip>({.name = "grip", .identifier = true, .doc = "name of the pulled corner in history.csv"}),
    key<&FrameSpec::rigid>({.name = "rigid",
                            .doc =
                                "members without stretch or mass, so that the travel alone moves the frame; the load "
                                "is then the generalised force of the travel"}),
    key<&FrameSpec::section>({.name = "section", .unit = "mm2", .limits = above(0, 1e9), .doc = "of one member"}),
    key<&FrameSpec::modulus>({.name = "modulus", .unit = "MPa", .limits = above(0, 1e9), .doc = "of the members"}),
    key<&FrameSpec::density>({.name = "density", .unit = "tonne/mm3", .limits = above(0, 1), .doc = "of the members"}),
    key<&FrameSpec::mass_scale>(
        {.name = "mass_scale",
         .unit = "1",
         .limits = above(0, 1e6),
         .doc = "factor on the members' mass: below 1 takes their inertia out of the load, above 1 "
                "lengthens their stable step; the mass added is in the summary"}),
};

const std::vector<Key<OutputSpec>> output_keys = {
    key<&OutputSpec::frames>(
        {.name = "frames", .unit = "1", .limits = between(0, 10000), .doc = "result frames after the initial one"}),
    key<&OutputSpec::history>({.name = "history",
                               .unit = "1",
                               .limits = between(1, 1000000),
                               .doc = "rows of history.csv after the initial one"}),
    key<&OutputSpec::contour_step>({.name = "contour_step",
                                    .unit = "deg",
                                    .limits = between(0.01, 90),
                                    .doc = "spacing of the shear-angle isolines"}),
    key<&OutputSpec::checkpoint_minutes>(
        {.name = "checkpoint_minutes",
         .unit = "min",
         .limits = between(0, 10000),
         .doc = "wall time between checkpoints, which `--resume` goes on from after a kill or a power cut; stretched "
                "where writing them would take more than a hundredth of the time; 0: none but on signals"}),
};

const std::vector<Key<MeasureSpec>> measure_keys = {
    key<&MeasureSpec::name>({.name = "name",
                             .required = true,
                             .identifier = true,
                             .doc = "heads the column `NAME.shear_angle_deg` of history.csv"}),
    key<&MeasureSpec::box>(
        {.name = "box",
         .unit = "mm",
         .limits = between(-1e6, 1e6),
         .doc = "the cells whose centre lies in xmin, ymin, xmax, ymax, blank frame, before forming"}),
    key<&MeasureSpec::relative_box>({.name = "relative_box",
                                     .unit = "1",
                                     .limits = between(-1e9, 1e9),
                                     .doc = "the same in units of the blank's width size[0], so that it follows the "
                                            "size; either this or `box`"}),
};

void complain_form(const toml::node& node, const std::string& name, bool many, Complaints& complaints) {
  complaints.add(node, many ? "'" + name + "' is a list of tables; begin each with [[" + name + "]]"
                            : "'" + name + "' is one table; begin it with [" + name + "]");
}

void complain_named(const toml::node& node, const std::string& name, Complaints& complaints) {
  complaints.add(node, "'" + name + "' is a group of named tables; begin each with [" + name + ".NAME]");
}

template <class Spec>
void read_one(const toml::node& node, const std::string& name, const std::vector<Key<Spec>>& keys, Spec& spec,
              bool many, Complaints& complaints) {
  const auto* table = node.as_table();
  if (table == nullptr) return complain_form(node, name, many, complaints);
  const std::string title = many ? "[[" + name + "]]" : "[" + name + "]";
  read_keys(*table, title, keys, spec, complaints);
  require_keys(*table, title, keys, complaints);
}

// [name]: one table, a struct of the scene.
template <auto member, class Spec>
SceneTable one_table(const std::string& name, const std::vector<Key<Spec>>& keys, std::string doc) {
  SceneTable table{.name = name, .many = false, .doc = std::move(doc), .keys = describe_keys(name, keys)};
  table.read = [name, &keys](const toml::node& node, Scene& scene, Complaints& complaints) {
    read_one(node, name, keys, scene.*member, false, complaints);
  };
  table.write = [name, &keys](const Scene& scene) { return "\n[" + name + "]\n" + write_keys(keys, scene.*member); };
  return table;
}

// [name.NAME]: a table of named tables, a vector of the scene in the order of the names.
template <auto member, class Spec>
SceneTable named_tables(const std::string& name, const std::vector<Key<Spec>>& keys, std::string doc) {
  SceneTable table{
      .name = name, .many = false, .named = true, .doc = std::move(doc), .keys = describe_keys(name, keys)};
  table.read = [name, &keys](const toml::node& node, Scene& scene, Complaints& complaints) {
    const auto* group = node.as_table();
    if (group == nullptr) return complain_named(node, name, complaints);
    for (const auto& [given, item] : *group) {
      const std::string title = name + "." + std::string(given.str());
      if (!is_identifier(given.str())) {
        complaints.add(item,
                       "[" + title + "]: a name begins with a letter and holds only letters, digits, '_' and '-'");
      } else if (!item.is_table()) {
        complain_named(item, name, complaints);
      } else {
        Spec& spec = (scene.*member).emplace_back();
        spec.name = given.str();
        read_one(item, title, keys, spec, false, complaints);
      }
    }
  };
  table.write = [name, &keys](const Scene& scene) {
    std::string text;
    for (const Spec& spec : scene.*member)
      text += "\n[" + name + "." + spec.name + "]\n" + write_keys(keys, spec, Echo::given);
    return text;
  };
  return table;
}

// [name] that a scene may do without.
template <auto member, class Spec>
SceneTable optional_table(const std::string& name, const std::vector<Key<Spec>>& keys, std::string doc) {
  SceneTable table{.name = name, .many = false, .doc = std::move(doc), .keys = describe_keys(name, keys)};
  table.read = [name, &keys](const toml::node& node, Scene& scene, Complaints& complaints) {
    read_one(node, name, keys, (scene.*member).emplace(), false, complaints);
  };
  table.write = [name, &keys](const Scene& scene) {
    return scene.*member ? "\n[" + name + "]\n" + write_keys(keys, *(scene.*member)) : std::string();
  };
  return table;
}

// [[name]]: a list of tables, a vector of the scene. An element that cannot be read keeps its place, so that the n-th
// element is the n-th table of the file.
template <auto member, class Spec>
SceneTable many_tables(const std::string& name, const std::vector<Key<Spec>>& keys, std::string doc) {
  SceneTable table{.name = name, .many = true, .doc = std::move(doc), .keys = describe_keys(name, keys)};
  table.read = [name, &keys](const toml::node& node, Scene& scene, Complaints& complaints) {
    const auto* list = node.as_array();
    if (list == nullptr) return complain_form(node, name, true, complaints);
    for (const auto& item : *list) {
      Spec& spec = (scene.*member).emplace_back();
      read_one(item, name, keys, spec, true, complaints);
    }
  };
  table.write = [name, &keys](const Scene& scene) {
    std::string text;
    for (const Spec& spec : scene.*member) text += "\n[[" + name + "]]\n" + write_keys(keys, spec);
    return text;
  };
  return table;
}

}  // namespace

const std::vector<SceneTable>& scene_tables() {
  static const std::vector<SceneTable> tables = {
      one_table<&Scene::fabric>("fabric", fabric_keys, "The woven reinforcement."),
      one_table<&Scene::blank>("blank", blank_keys, "The flat piece of fabric and how finely its yarns are modelled."),
      one_table<&Scene::model>("model", model_keys, "Elements and laws."),
      many_tables<&Scene::grip>("grip", grip_keys, "A prescribed part of the blank; as many as needed."),
      optional_table<&Scene::frame>(
          "frame", frame_keys,
          "A pin-jointed shear frame around a square blank: the fabric is blank.size, its yarns run "
          "on to the frame through arms without cross yarns. Left out: no frame."),
      named_tables<&Scene::tools>("tools", tool_keys,
                                  "A rigid tool; as many as needed, each with a name of its own: it heads the tool's "
                                  "columns in history.csv and names it in `--set tools.NAME.travel=...`."),
      optional_table<&Scene::drape>("drape", drape_keys,
                                    "The blank starts draped over a tool, as a pin-jointed net of inextensible yarns "
                                    "(docs/drape.md). Left out: it "
                                    "starts flat."),
      one_table<&Scene::analysis>("analysis", analysis_keys, "The explicit analysis."),
      one_table<&Scene::output>("output", output_keys, "What is written."),
      many_tables<&Scene::measure>("measure", measure_keys,
                                   "A patch of cells whose mean shear angle is recorded; as many as needed."),
  };
  return tables;
}

}  // namespace weaveform
