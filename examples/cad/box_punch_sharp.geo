// A box-shaped punch, 100 x 70 mm, the edges around its nose sharp; at z = 0, facing down: a Gmsh script, which Weaveform reads as it is.
// `weaveform tool examples/cad/box_punch_sharp.geo --output punch.step` makes it a STEP file.
SetFactory("OpenCASCADE");
corner = 25;  // mm; of the upright edges
Box(1) = {-50, -35, 0, 100, 70, 60};
e = 1e-3;
For x In {-50:50:100}
  For y In {-35:35:70}
    upright() += Curve In BoundingBox {x - e, y - e, -e, x + e, y + e, 60 + e};
  EndFor
EndFor
Fillet{1}{upright()}{corner}
