// Crankshaft of the four-cylinder engine of examples/crank_train, in millimetres: five main bearings of 52 mm, four pins
// of 44 mm on a crank radius of 40 mm. Origin on the axis in the middle bearing, axis along z, pins 1 and 4 towards +y.
//
// gmsh -3 crankshaft.geo -o crankshaft.msh                 coarse, the committed file
// gmsh -3 crankshaft.geo -setnumber size 8.5 -o ...        about 67,000 degrees of freedom
DefineConstant[ size = 24 ];
SetFactory("OpenCASCADE");
Mesh.ElementOrder = 2;
Mesh.HighOrderOptimize = 1;  // unfolds elements at round surfaces
Mesh.MshFileVersion = 4.1;
Mesh.CharacteristicLengthMax = size;
Mesh.CharacteristicLengthMin = size / 4;

main = 26;  // radii
pin = 22;
throw = 40;
web = 9;    // thickness

// Mains and pins touch their webs, which lie 90 mm apart in pairs.
For k In {0:4}
  z0 = (k == 0) ? -200 : -180 + 90 * k - 20.5;
  z1 = (k == 4) ? 200 : -180 + 90 * k + 20.5;
  Cylinder(1 + k) = {0, 0, z0, 0, 0, z1 - z0, main};
EndFor
all[] = {};
For k In {0:3}
  z = -135 + 90 * k;
  side = (k == 0 || k == 3) ? 1 : -1;
  Cylinder(20 + k) = {0, side * throw, z - 15.5, 0, 0, 31, pin};
  y0 = (side > 0) ? -46 : -66;
  Box(30 + 2 * k) = {-28, y0, z - 24.5, 56, 112, web};
  Box(31 + 2 * k) = {-28, y0, z + 24.5 - web, 56, 112, web};
  all[] += {20 + k, 30 + 2 * k, 31 + 2 * k};
EndFor
whole[] = BooleanUnion{ Volume{1}; Delete; }{ Volume{2:5, all[]}; Delete; };
Physical Volume("crankshaft") = {whole[]};

e = 0.01;
For k In {0:4}
  z0 = (k == 0) ? -200 : -180 + 90 * k - 20.5;
  z1 = (k == 4) ? 200 : -180 + 90 * k + 20.5;
  found[] = Surface In BoundingBox{-main - e, -main - e, z0 - e, main + e, main + e, z1 + e};
  // the two ends of the shaft are flat and stay out
  If (k == 0)
    ends[] = Surface In BoundingBox{-main - e, -main - e, -200 - e, main + e, main + e, -200 + e};
    found[] -= ends[];
  EndIf
  If (k == 4)
    ends[] = Surface In BoundingBox{-main - e, -main - e, 200 - e, main + e, main + e, 200 + e};
    found[] -= ends[];
  EndIf
  Physical Surface(Sprintf("main_%g", k + 1)) = {found[]};
EndFor
For k In {0:3}
  z = -135 + 90 * k;
  side = (k == 0 || k == 3) ? 1 : -1;
  found[] = Surface In BoundingBox{-pin - e, side * throw - pin - e, z - 15.5 - e, pin + e, side * throw + pin + e, z + 15.5 + e};
  Physical Surface(Sprintf("pin_%g", k + 1)) = {found[]};
EndFor
