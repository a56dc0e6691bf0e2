SetFactory("OpenCASCADE");
Box(1) = {-120, -60, -10, 240, 120, 10};
Sphere(2) = {-55, 0, -5, 45};
Sphere(3) = {55, 0, -10, 40};
BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
Box(5) = {-200, -200, -110, 400, 400, 100};
BooleanDifference(6) = { Volume{4}; Delete; }{ Volume{5}; Delete; };
