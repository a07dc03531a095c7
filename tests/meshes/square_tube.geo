// SPDX-License-Identifier: GPL-3.0-or-later
// A square tube of one layer, blood 1 cm wide in a wall of 0.5 cm, whose meshes are tests/meshes/square_tube*.msh.
SetFactory("Built-in");
For k In {0:1}
  a = 0.5 + 0.5 * k;
  Point(10 * k + 1) = {-a, -a, 0}; Point(10 * k + 2) = {a, -a, 0};
  Point(10 * k + 3) = {a, a, 0}; Point(10 * k + 4) = {-a, a, 0};
  For i In {1:4}
    Line(10 * k + i) = {10 * k + i, 10 * k + i % 4 + 1};
  EndFor
  Curve Loop(k + 1) = {10 * k + 1 : 10 * k + 4};
EndFor
Plane Surface(1) = {1};
Plane Surface(2) = {2, 1};
blood() = Extrude {0, 0, 2} { Surface{1}; Layers{1}; };
wall() = Extrude {0, 0, 2} { Surface{2}; Layers{1}; };
Physical Volume("blood") = {blood(1)};
Physical Volume("wall") = {wall(1)};
Physical Surface("inlet") = {1};
Physical Surface("outlet") = {blood(0)};
Physical Surface("wall_inlet") = {2};
Physical Surface("wall_outlet") = {wall(0)};
Physical Surface("outer") = {wall(2), wall(3), wall(4), wall(5)};
Mesh.MeshSizeMin = 2; Mesh.MeshSizeMax = 2;
Mesh.ElementOrder = 2;
