// The plate under punch.geo: an opening of 154 x 114 mm, 2 mm of air around the punch, its rim rounded; its face at z = 0
// faces up. A Gmsh script; die.step was made of it by `weaveform tool die.geo --output die.step`.
SetFactory("OpenCASCADE");
corner = 37;  // mm; radius of the opening's upright edges
rim = 16;     // mm; of the opening's upper edge
Box(1) = {-150, -130, -60, 300, 260, 60};
Box(2) = {-77, -57, -70, 154, 114, 80};
e = 1e-3;
For x In {-77:77:154}
  For y In {-57:57:114}
    upright() += Curve In BoundingBox {x - e, y - e, -70 - e, x + e, y + e, 10 + e};
  EndFor
EndFor
Fillet{2}{upright()}{corner}
BooleanDifference(3) = {Volume{1}; Delete;}{Volume{2}; Delete;};
upper() = Curve In BoundingBox {-77 - e, -57 - e, -e, 77 + e, 57 + e, e};
Fillet{3}{upper()}{rim}
