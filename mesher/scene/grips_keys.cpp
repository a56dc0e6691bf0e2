// Keys of what holds and moves the fabric but tools: grips and the shear frame.
#include "mesher/scene/scene_keys.hpp"

namespace weaveform {

const std::vector<Key<GripSpec>>& grip_keys() {
  static const std::vector<Key<GripSpec>> keys = {
      key<&GripSpec::name>(
          {.name = "name",
           .required = true,
           .identifier = true,
           .doc = "heads the grip's columns in history.csv; names it in `--set grip.NAME.travel=...`"}),
      key<&GripSpec::edge>({.name = "edge", .doc = "the edge of the blank it holds; either this or `box`"}),
      key<&GripSpec::box>(
          {.name = "box",
           .unit = "mm",
           .limits = any_length,
           .doc = "holds every node in xmin, ymin, xmax, ymax, blank frame (its centre is the origin)"}),
      key<&GripSpec::travel>({.name = "travel",
                              .unit = "mm",
                              .limits = any_length,
                              .doc = "way along `direction`, a smooth step over the duration; 0 holds still"}),
      key<&GripSpec::direction>({.name = "direction",
                                 .unit = "1",
                                 .limits = between(-1e9, 1e9),
                                 .doc = "blank frame, any length but zero; when left out the edge's outward normal, or "
                                        "[0, 1, 0] for a box"}),
      key<&GripSpec::free>({.name = "free", .doc = "components left free, blank frame; the others are prescribed"}),
      key<&GripSpec::plies>({.name = "plies",
                             .identifier = true,
                             .doc = "of a stack: names of the plies it holds, each in its own blank's frame; left out: "
                                    "all, a box those that have fabric there"}),
  };
  return keys;
}

const std::vector<Key<FrameSpec>>& frame_keys() {
  static const std::vector<Key<FrameSpec>> keys = {
      key<&FrameSpec::length>({.name = "length",
                               .unit = "mm",
                               .limits = above(0, greatest_length),
                               .doc = "side of the frame between its pins"}),
      key<&FrameSpec::travel>(
          {.name = "travel",
           .unit = "mm",
           .limits = any_length,
           .doc = "of the pulled corner along the frame's diagonal, a smooth step over the duration"}),
      key<&FrameSpec::grip>({.name = "grip", .identifier = true, .doc = "name of the pulled corner in history.csv"}),
      key<&FrameSpec::rigid>({.name = "rigid",
                              .doc =
                                  "members without stretch or mass, so that the travel alone moves the frame; the load "
                                  "is then the generalised force of the travel"}),
      key<&FrameSpec::section>({.name = "section", .unit = "mm2", .limits = above(0, 1e9), .doc = "of one member"}),
      key<&FrameSpec::modulus>({.name = "modulus", .unit = "MPa", .limits = above(0, 1e9), .doc = "of the members"}),
      key<&FrameSpec::density>(
          {.name = "density", .unit = "tonne/mm3", .limits = above(0, 1), .doc = "of the members"}),
      key<&FrameSpec::mass_scale>(
          {.name = "mass_scale",
           .unit = "1",
           .limits = above(0, 1e6),
           .doc = "factor on the members' mass: below 1 takes their inertia out of the load, above 1 "
                  "lengthens their stable step; the mass added is in the summary"}),
  };
  return keys;
}

}  // namespace weaveform
