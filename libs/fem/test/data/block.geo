// A block of all solid shapes in second order: hexahedra, wedges beside them, tetrahedra on the wedges.
// The files beside it are made of it,
//   as README.md says
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
Mesh.Smoothing = 0;
Point(1) = {0, 0, 0, 10};
Point(2) = {10, 0, 0, 10};
Point(3) = {20, 0, 0, 10};
Point(4) = {20, 9, 0, 10};
Point(5) = {10, 9, 0, 10};
Point(6) = {0, 8, 0, 10};
Line(1) = {1, 2};
Line(2) = {2, 5};
Line(3) = {5, 6};
Line(4) = {6, 1};
Line(5) = {2, 3};
Line(6) = {3, 4};
Line(7) = {4, 5};
Transfinite Curve {1, 2, 3, 4, 5, 6, 7} = 2;
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {5, 6, 7, -2};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Transfinite Surface {1, 2};
Recombine Surface {1};
hex[] = Extrude {0, 0, 7} { Surface{1}; Layers{2}; Recombine; };
wedge[] = Extrude {0, 0, 7} { Surface{2}; Layers{2}; Recombine; };
tet[] = Extrude {0, 0, 5} { Surface{wedge[0]}; Layers{1}; };
Physical Volume("bricks") = {hex[1]};
Physical Volume("wedges") = {wedge[1]};
Physical Volume("tets") = {tet[1]};
Physical Surface("floor") = {1, 2};
Physical Surface("roof") = {tet[0]};
If (!Exists(no_curves))
  Physical Curve("edge") = {4};
EndIf
Physical Point("corner") = {1};
