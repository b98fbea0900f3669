// A curled leaf: a thin shell, broad near its stem and pointed, bent about an axis along y. Metres. Stem at -x, tip at
// +x, both curled up towards +z; the lowest point of its underside is the origin's; y = 0 is its mirror plane.
SetFactory("OpenCASCADE");
DefineConstant[
  length = {0.06, Name "Shape/Length along x, seen from above (m)"}
  width = {0.032, Name "Shape/Greatest width along y (m)"}
  thickness = {0.0003, Name "Shape/Thickness (m)"}
  bend_radius = {0.05, Name "Shape/Radius of the curl, of the underside (m)"}
];

// Half the outline as (place along the length, half-width over the greatest half-width).
along[] = {0.06, 0.18, 0.35, 0.55, 0.75, 0.9};
across[] = {0.42, 0.82, 1.0, 0.85, 0.5, 0.2};

Point(1) = {-length / 2, 0, 0};
Point(2) = {length / 2, 0, 0};
For i In {0 : 5}
  Point(10 + i) = {(along[i] - 0.5) * length, across[i] * width / 2, 0};
  Point(20 + i) = {(along[i] - 0.5) * length, -across[i] * width / 2, 0};
EndFor
Spline(1) = {1, 10 : 15, 2};
Spline(2) = {1, 20 : 25, 2};
Curve Loop(1) = {1, -2};
Plane Surface(1) = {1};
Extrude {0, 0, bend_radius} { Surface{1}; }

Cylinder(2) = {0, -width, bend_radius, 0, 2 * width, 0, bend_radius};
Cylinder(3) = {0, -width, bend_radius, 0, 2 * width, 0, bend_radius - thickness};
BooleanDifference(4) = { Volume{2}; Delete; }{ Volume{3}; Delete; };
BooleanIntersection(5) = { Volume{1}; Delete; }{ Volume{4}; Delete; };

Mesh.MeshSizeMax = length / 16;
