// SPDX-License-Identifier: GPL-3.0-or-later
// A straight artery with a sac that it meets in a sharp neck, for tests/meshes/sharp_neck.msh (format 2.2, binary).
SetFactory("OpenCASCADE");
R = 0.2; h = 0.04; L = 0.8; Rs = 0.3; c = 0.4;
Cylinder(1) = {0,0,-L/2, 0,0,L, R};
Sphere(2) = {c,0,0, Rs};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0,0,-L/2, 0,0,L, R+h};
Sphere(5) = {c,0,0, Rs+h};
BooleanUnion(6) = { Volume{4}; Delete; }{ Volume{5}; Delete; };
v() = BooleanFragments{ Volume{3}; Delete; }{ Volume{6}; Delete; };
Physical Volume("blood") = {3};
Physical Volume("wall") = {v(1)};
e=1e-3;
i() = Surface In BoundingBox{-R-e,-R-e,-L/2-e, R+e,R+e,-L/2+e};
o() = Surface In BoundingBox{-R-e,-R-e,L/2-e, R+e,R+e,L/2+e};
wi() = Surface In BoundingBox{-R-h-e,-R-h-e,-L/2-e, R+h+e,R+h+e,-L/2+e}; wi() -= i();
wo() = Surface In BoundingBox{-R-h-e,-R-h-e,L/2-e, R+h+e,R+h+e,L/2+e}; wo() -= o();
Physical Surface("inlet") = {i()};
Physical Surface("outlet") = {o()};
Physical Surface("wall_inlet") = {wi()};
Physical Surface("wall_outlet") = {wo()};
ob() = Abs(Boundary{ Volume{v(1)}; });
ib() = Abs(Boundary{ Volume{3}; });
ob() -= ib(); ob() -= wi(); ob() -= wo();
Physical Surface("outer") = {ob()};
Mesh.MeshSizeMax = 0.15; Mesh.MeshSizeMin = 0.05;
Mesh.ElementOrder = 1;
