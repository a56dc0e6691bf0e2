SetFactory("OpenCASCADE");
n = 1;
For k In {0:3}
  Box(n) = {0, 0, 12*k, 200, 120, 10};
  c() = {};
  For i In {0:3}
    Cylinder(1000 + n + i) = {25 + 50*i, 30 + 20*(k%2), 12*k - 1, 0, 0, 12, 4};
    c() += {1000 + n + i};
  EndFor
  BooleanDifference{ Volume{n}; Delete; }{ Volume{c()}; Delete; }
  n += 1;
EndFor
For i In {0:3}
  v = newv; Cylinder(v) = {25 + 50*i, 90, 60, 0, 0, 30, 6};
  s = newv; Sphere(s) = {25 + 50*i, 90, 90, 9};
  BooleanUnion{ Volume{v}; Delete; }{ Volume{s}; Delete; }
EndFor
