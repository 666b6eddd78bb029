// Connecting rod with cap and two bores, in millimetres. Big end as in Table 1 of Choi, Kim, Rhim and Choi (2012):
// journal 45 mm, bearing width 15.6 mm; length, small end and shank are typical of a car engine of that bore.
// Origin in the centre of the big end, small end towards +y, bores along z.
//
// gmsh -3 conrod.geo -o conrod.msh                         coarse, the committed file
// gmsh -3 conrod.geo -setnumber size 6.3 -o ...            about 25,000 degrees of freedom
// gmsh -3 conrod.geo -setnumber size 3.43 -o ...           about 97,000 degrees of freedom
DefineConstant[ size = 11 ];  // of an element away from the bores
SetFactory("OpenCASCADE");
Mesh.ElementOrder = 2;
Mesh.HighOrderOptimize = 1;  // unfolds elements at round surfaces
Mesh.MshFileVersion = 4.1;

length = 140;
width = 15.6;
bore = 22.5;      // radii
big_end = 30;
eye = 10;
small_end = 16;
half = width / 2;

Cylinder(1) = {0, 0, -half, 0, 0, width, big_end};
Cylinder(2) = {0, length, -half, 0, 0, width, small_end};
Box(3) = {-37, -13, -half, 74, 26, width};  // bosses of the cap's screws
Point(101) = {-14, 20, -half};
Point(102) = {14, 20, -half};
Point(103) = {9, length - 8, -half};
Point(104) = {-9, length - 8, -half};
Line(101) = {101, 102};
Line(102) = {102, 103};
Line(103) = {103, 104};
Line(104) = {104, 101};
Curve Loop(101) = {101, 102, 103, 104};
Plane Surface(101) = {101};
shank[] = Extrude {0, 0, width} { Surface{101}; };
BooleanUnion(10) = { Volume{1}; Delete; }{ Volume{2, 3, shank[1]}; Delete; };

// Both bores, and a pocket on each side of the shank, which makes its section an I.
Cylinder(11) = {0, 0, -width, 0, 0, 2 * width, bore};
Cylinder(12) = {0, length, -width, 0, 0, 2 * width, eye};
Box(13) = {-5.5, 40, 2.5, 11, 76, width};
Box(14) = {-5.5, 40, -2.5 - width, 11, 76, width};
BooleanDifference(20) = { Volume{10}; Delete; }{ Volume{11, 12, 13, 14}; Delete; };

// The cap below the split shares its nodes with the rod: screwed together, they are one body.
Box(21) = {-100, -100, -50, 200, 100, 100};
BooleanIntersection(30) = { Volume{20}; }{ Volume{21}; };
BooleanDifference(31) = { Volume{20}; Delete; }{ Volume{21}; Delete; };
parts[] = BooleanFragments{ Volume{30}; Delete; }{ Volume{31}; Delete; };

e = 0.01;
big_bore[] = Surface In BoundingBox{-bore - e, -bore - e, -half - e, bore + e, bore + e, half + e};
small_bore[] = Surface In BoundingBox{-eye - e, length - eye - e, -half - e, eye + e, length + eye + e, half + e};
Physical Volume("cap") = {parts[0]};
Physical Volume("rod") = {parts[1]};
Physical Surface("big_end") = {big_bore[]};
Physical Surface("small_end") = {small_bore[]};

// Elements half as large at the bores as away from them.
Mesh.CharacteristicLengthMax = size;
Mesh.CharacteristicLengthMin = size / 4;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Field[1] = Distance;
Field[1].FacesList = {big_bore[], small_bore[]};
Field[1].NNodesByEdge = 30;
Field[2] = Threshold;
Field[2].IField = 1;
Field[2].LcMin = 0.6 * size;
Field[2].LcMax = size;
Field[2].DistMin = 2;
Field[2].DistMax = 15;
Background Field = 2;
