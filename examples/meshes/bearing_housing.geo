// Pedestal of a main bearing of 52 mm, in millimetres: round above, on a foot with two screw holes. Origin in the centre
// of the bore, which runs along z; the foot stands on y = -60.
//
// gmsh -3 bearing_housing.geo -o bearing_housing.msh       coarse, the committed file
// gmsh -3 bearing_housing.geo -setnumber size 5 -o ...     about 50,000 degrees of freedom
DefineConstant[ size = 18 ];
SetFactory("OpenCASCADE");
Mesh.ElementOrder = 2;
Mesh.HighOrderOptimize = 1;  // unfolds elements at round surfaces
Mesh.MshFileVersion = 4.1;
Mesh.CharacteristicLengthMax = size;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumElementsPerTwoPi = 10;

bore = 26;
width = 30;
half = width / 2;
Cylinder(1) = {0, 0, -half, 0, 0, width, 42};
Box(2) = {-42, -60, -half, 84, 60, width};
Box(3) = {-80, -60, -half, 160, 18, width};
BooleanUnion(10) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
Cylinder(11) = {0, 0, -width, 0, 0, 2 * width, bore};
Cylinder(12) = {-62, -100, 0, 0, 100, 0, 6};
Cylinder(13) = {62, -100, 0, 0, 100, 0, 6};
BooleanDifference(20) = { Volume{10}; Delete; }{ Volume{11, 12, 13}; Delete; };
e = 0.01;
Physical Volume("housing") = {20};
found[] = Surface In BoundingBox{-bore - e, -bore - e, -half - e, bore + e, bore + e, half + e};
Physical Surface("bore") = {found[]};
found[] = Surface In BoundingBox{-80 - e, -60 - e, -half - e, 80 + e, -60 + e, half + e};
Physical Surface("foot") = {found[]};
For k In {0:1}
  x = (k == 0) ? -62 : 62;
  found[] = Surface In BoundingBox{x - 6 - e, -60 - e, -6 - e, x + 6 + e, -42 + e, 6 + e};
  Physical Surface(Sprintf("screw_%g", k + 1)) = {found[]};
EndFor
