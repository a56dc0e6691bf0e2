// The pads of four clips on the edges of a blank of 400 mm: cylinders of 25 mm radius, rounded to flat faces of 10 mm radius
// at z = 0, so that the fabric bends over no edge sharper than its cells. Units: mm.
SetFactory("OpenCASCADE");
away = 185;  // mm; from the blank's centre
Cylinder(1) = {away, 0, 0, 0, 0, 30, 25};
Cylinder(2) = {-away, 0, 0, 0, 0, 30, 25};
Cylinder(3) = {0, away, 0, 0, 0, 30, 25};
Cylinder(4) = {0, -away, 0, 0, 0, 30, 25};
rim() = Curve In BoundingBox {-220, -220, -0.001, 220, 220, 0.001};
Fillet{1:4}{rim()}{15}
