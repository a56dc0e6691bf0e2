// The plate under box_punch.geo: an opening of 104 x 74 mm, its rim rounded; its face at z = 0 faces up.
SetFactory("OpenCASCADE");
corner = 27;  // mm; of the opening's upright edges
rim = 8;      // mm; of the opening's upper edge
Box(1) = {-120, -105, -70, 240, 210, 70};
Box(2) = {-52, -37, -80, 104, 74, 90};
e = 1e-3;
For x In {-52:52:104}
  For y In {-37:37:74}
    upright() += Curve In BoundingBox {x - e, y - e, -80 - e, x + e, y + e, 10 + e};
  EndFor
EndFor
Fillet{2}{upright()}{corner}
BooleanDifference(3) = {Volume{1}; Delete;}{Volume{2}; Delete;};
upper() = Curve In BoundingBox {-52 - e, -37 - e, -e, 52 + e, 37 + e, e};
Fillet{3}{upper()}{rim}
