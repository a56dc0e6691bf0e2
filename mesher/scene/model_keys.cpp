// Keys of the elements and laws.
#include "mesher/scene/scene_keys.hpp"

namespace weaveform {

const std::vector<Key<ModelSpec>>& model_keys() {
  static const std::vector<Key<ModelSpec>> keys = {
      key_or_auto<&ModelSpec::yarn, &ModelSpec::yarn_open>(
          {.name = "yarn",
           .doc = "element of the yarns: `truss` (the paper's T3D2); `beam` (B31): adds flexural "
                  "stiffness along each continuous yarn, crossings stay pinned; `seatbelt` carries no "
                  "compression (the paper's LS-DYNA element); `auto`: the cheapest that serves "
                  "(docs/automatic.md)"}),
      key<&ModelSpec::partner>({.name = "partner",
                                .doc = "`compression`: beside every seatbelt an element that carries the card's "
                                       "`compression` law and no tension"}),
      key_or_auto<&ModelSpec::cell, &ModelSpec::cell_open>(
          {.name = "cell",
           .doc =
               "element of the shear cells: `membrane` (the paper's M3D4R); `rotation-free`: adds bending along warp "
               "and weft and twist from the lattice's curvatures; `shell` (S4R): the same with rotational unknowns "
               "and transverse shear; `auto`: the cheapest that serves (docs/automatic.md)"}),
      key<&ModelSpec::formulation>({.name = "formulation",
                                    .doc = "shear force of a cell: gradient of a stored energy, or the paper's stress "
                                           "(Eq. 9) taken whole; equal for inextensible yarns. For comparison: the "
                                           "paper's stress in increments (Eqs. 8-10), or that in the frame of a side; "
                                           "what they get wrong is in docs/unit_cell.md"}),
      key<&ModelSpec::thickness>({.name = "thickness", .doc = "how a cell's thickness follows its area"}),
      key<&ModelSpec::contact_thickness>(
          {.name = "contact_thickness",
           .doc = "how thick the fabric is where tools and other plies touch it: as the card says, or `sheared`: that "
                  "over the cosine of the shear angle (constant volume), so that sheared fabric carries the binder; "
                  "needs `thickness = \"constant-volume\"` and a flat start"}),
      key<&ModelSpec::section>({.name = "section", .doc = "how a yarn's cross-section follows its stretch"}),
      key<&ModelSpec::yarn_law>({.name = "yarn_law",
                                 .doc =
                                     "tension law: the card's (decrimping, Table 2), or its linear modulus from zero "
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
                                     .doc =
                                         "constant bending stiffness per width of the cells along warp and weft, and "
                                         "twist, in place of the card's; needs a cell that bends. When left out: the "
                                         "fabric's rigidity less what beams bear of it"}),
      key<&ModelSpec::bending_friction>({.name = "bending_friction",
                                         .limits = between(0, 1e6),
                                         .doc = "[moment, rise]: friction in bending of one yarn (N mm, and 1/mm), in "
                                                "place of the card's, in both families; a moment of 0 switches it off. "
                                                "Needs yarns or cells that bend"}),
      key<&ModelSpec::transverse_shear>({.name = "transverse_shear",
                                         .unit = "N/mm",
                                         .limits = above(0, 1e9),
                                         .doc = "of shell cells, force per width over shear angle; auto: the card's"}),
  };
  return keys;
}

}  // namespace weaveform
