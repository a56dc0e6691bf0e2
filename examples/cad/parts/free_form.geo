SetFactory("OpenCASCADE");
For k In {0:5}
  For i In {0:9}
    a = 2*Pi*i/10;
    r = 30 + 8*Sin(k) + 6*Cos(2*a + 0.6*k) + 3*Sin(3*a);
    Point(100*(k+1) + i) = {r*Cos(a), 1.4*r*Sin(a) + 4*k, 22*k};
  EndFor
  b = 100*(k+1);
  BSpline(k+1) = {b, b+1, b+2, b+3, b+4, b+5, b+6, b+7, b+8, b+9, b};
  Curve Loop(k+1) = {k+1};
EndFor
ThruSections(1) = {1:6};
