// The part of docs/tutorial.md as a shell for structural analysis: the faces of punch.step up to the trim height.
//   gmsh examples/tutorial/part.geo -2 -o part.inp
// Triangles of second order, which CalculiX wants as S6 (Gmsh calls them CPS6).
SetFactory("OpenCASCADE");
trim = 28;  // mm; above the lowest point of the nose
size = 9;   // mm; of the shells
Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
Mesh.ElementOrder = 2;
Mesh.SaveGroupsOfNodes = 1;  // for the edge that is held
punch() = ShapeFromFile("punch.step");
Box(100) = {-200, -200, -1, 400, 400, trim + 1};
below() = BooleanIntersection{ Volume{punch()}; Delete; }{ Volume{100}; Delete; };
face() = Boundary{ Volume{below()}; };
e = 1e-3;
cut() = Surface In BoundingBox {-200, -200, trim - e, 200, 200, trim + e};
face() -= cut();
Physical Surface("PART") = face();
Physical Curve("TRIM") = Boundary{ Surface{cut()}; };
