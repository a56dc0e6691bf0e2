// The part of docs/tutorial.md as a punch: a pan of 150 x 110 mm with a crowned nose, which points down and has its lowest
// point at z = 0. A Gmsh script; punch.step was made of it by `weaveform tool punch.geo --output punch.step`.
SetFactory("OpenCASCADE");
corner = 35;  // mm; radius of the upright edges
nose = 15;    // mm; of the edge around the nose
crown = 220;  // mm; of the sphere that the nose is a part of
Box(1) = {-75, -55, 0, 150, 110, 60};
e = 1e-3;
For x In {-75:75:150}
  For y In {-55:55:110}
    upright() += Curve In BoundingBox {x - e, y - e, -e, x + e, y + e, 60 + e};
  EndFor
EndFor
Fillet{1}{upright()}{corner}
Sphere(2) = {0, 0, crown, crown};
BooleanIntersection(3) = {Volume{1}; Delete;}{Volume{2}; Delete;};
rim() = Curve In BoundingBox {-75 - e, -55 - e, -e, 75 + e, 55 + e, 30};
Fillet{3}{rim()}{nose}
