// Keys of the fabric and its blank.
#include "mesher/scene/scene_keys.hpp"

namespace weaveform {

const std::vector<Key<FabricSpec>>& fabric_keys() {
  static const std::vector<Key<FabricSpec>> keys = {
      key<&FabricSpec::material>(
          {.name = "material",
           .doc = "built-in card (`twintex-pw`, `twintex-tw`) or path of a card file, relative to the scene file"}),
      key<&FabricSpec::face>(
          {.name = "face",
           .doc = "where the fabric's face looks, for cards with `bending_out_of_plane_back`: `up`, to the side from "
                  "which warp turns counter-clockwise to weft (+z of the flat blank), or `down`: laid the other way "
                  "up"}),
  };
  return keys;
}

const std::vector<Key<BlankSpec>>& blank_keys() {
  static const std::vector<Key<BlankSpec>> keys = {
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
                                .limits = any_length,
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
          {.name = "outline_layers",
           .doc = "of a DXF drawing, whose curves bound the blank; left out: all that are on"}),
      key<&BlankSpec::arm_width>({.name = "arm_width",
                                  .unit = "mm",
                                  .limits = above(0, greatest_length),
                                  .doc = "of a cross, which needs it; its yarns run "
                                         "along the arms"}),
      key<&BlankSpec::on_roll>({.name = "on_roll",
                                .unit = "mm",
                                .limits = any_length,
                                .doc =
                                    "where the blank's centre lies on the roll, along warp and weft from a crossing; "
                                    "yarns then lie exactly where the roll has them, in this blank and the next"}),
      key<&BlankSpec::yarn_angle>({.name = "yarn_angle",
                                   .unit = "deg",
                                   .limits = between(-360, 360),
                                   .doc = "from the blank's x axis to the warp direction, counter-clockwise"}),
      key_or_auto<&BlankSpec::coarsening, &BlankSpec::coarsening_open>(
          {.name = "coarsening",
           .unit = "1",
           .limits = between(0.05, 100),
           .one_for_all = true,
           .doc = "yarns per model yarn, for warp and for weft yarns; one number serves both; "
                  "below 1 refines; auto: as coarse as `[accuracy]` allows (docs/automatic.md)"}),
      key<&BlankSpec::phase>({.name = "phase",
                              .unit = "1",
                              .limits = between(-1, 1),
                              .doc = "shift of the warp and weft lines in model intervals; 0 puts a crossing at the "
                                     "blank's centre"}),
      key<&BlankSpec::fit>({.name = "fit",
                            .doc =
                                "`grips`: spacing (within 15 %) and phase are chosen so that yarn lines pass through "
                                "the ends of the gripped edges, which bound the deforming zone; `none`, or a `phase` "
                                "other than 0: lines exactly as written"}),
      key<&BlankSpec::orientation>({.name = "orientation",
                                    .unit = "deg",
                                    .limits = between(-360, 360),
                                    .doc = "turns the whole blank (outline, yarns, grips, measures) in its plane"}),
      key<&BlankSpec::position>({.name = "position",
                                 .unit = "mm",
                                 .limits = any_length,
                                 .doc = "where the blank's centre lies in the world"}),
  };
  return keys;
}

}  // namespace weaveform
