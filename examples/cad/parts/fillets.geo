SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 150, 100, 20};
Box(2) = {30, 20, 20, 90, 60, 30};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
e() = Boundary{ Boundary{ Volume{3}; } };
e() = Unique(Abs(e()));
Fillet{3}{e()}{2.0}
