SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 120, 80, 30};
n = 100;
For i In {0:4}
  For j In {0:2}
    Cylinder(n) = {15 + 22*i, 15 + 25*j, 12, 0, 0, 20, 3 + 0.5*i};
    Cone(n+1) = {15 + 22*i, 15 + 25*j, 12 - 0.6*(3 + 0.5*i), 0, 0, 0.6*(3 + 0.5*i), 0, 3 + 0.5*i, 2*Pi};
    n += 2;
  EndFor
EndFor
BooleanDifference(2) = { Volume{1}; Delete; }{ Volume{100:n-1}; Delete; };
