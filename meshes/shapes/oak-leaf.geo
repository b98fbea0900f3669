// A leaf of an English oak, slightly curled about an axis along y. Metres. Stem at -x, tip at +x; the lowest point of its
// underside is the origin's; y = 0 is its mirror plane.
SetFactory("OpenCASCADE");
DefineConstant[
  length = {0.10, Name "Shape/Length along x, seen from above (m)"}
  thickness = {0.0003, Name "Shape/Thickness (m)"}
  bend_radius = {0.12, Name "Shape/Radius of the curl, of the underside (m)"}
];

// Half the outline: places along the length and half-widths, over the length. Four lobes a side.
along[] = {0.08, 0.20, 0.27, 0.33, 0.44, 0.51, 0.57, 0.68, 0.75, 0.80, 0.90, 0.97};
across[] = {0.05, 0.13, 0.15, 0.09, 0.22, 0.23, 0.12, 0.26, 0.26, 0.15, 0.17, 0.10};
count = #along[];

Point(1) = {-0.5 * length, 0, 0};
Point(2) = {0.5 * length, 0, 0};
For i In {0 : count - 1}
  Point(10 + i) = {(along[i] - 0.5) * length, across[i] * length, 0};
  Point(30 + i) = {(along[i] - 0.5) * length, -across[i] * length, 0};
EndFor
Spline(1) = {1, 10 : 9 + count, 2};
Spline(2) = {1, 30 : 29 + count, 2};
Curve Loop(1) = {1, -2};
Plane Surface(1) = {1};
Extrude {0, 0, bend_radius} { Surface{1}; }

Cylinder(2) = {0, -length, bend_radius, 0, 2 * length, 0, bend_radius};
Cylinder(3) = {0, -length, bend_radius, 0, 2 * length, 0, bend_radius - thickness};
BooleanDifference(4) = { Volume{2}; Delete; }{ Volume{3}; Delete; };
BooleanIntersection(5) = { Volume{1}; Delete; }{ Volume{4}; Delete; };

Mesh.MeshSizeMax = length / 16;
