// A leaf of a Norway maple, slightly curled about an axis along y. Metres. Stem at -x, tip at +x; the lowest point of its
// underside is the origin's; y = 0 is its mirror plane.
SetFactory("OpenCASCADE");
DefineConstant[
  length = {0.09, Name "Shape/Length along x, seen from above (m)"}
  thickness = {0.0003, Name "Shape/Thickness (m)"}
  bend_radius = {0.12, Name "Shape/Radius of the curl, of the underside (m)"}
];

// Half the outline: places along the length and half-widths, over the length. Five lobes with teeth.
along[] = {0.02, 0.18, 0.24, 0.40, 0.52, 0.46, 0.70, 0.73, 0.82};
across[] = {0.24, 0.28, 0.46, 0.44, 0.56, 0.19, 0.24, 0.12, 0.11};
count = #along[];

Point(1) = {(0.11 - 0.5) * length, 0, 0};
Point(2) = {0.5 * length, 0, 0};
For i In {0 : count - 1}
  Point(10 + i) = {(along[i] - 0.5) * length, across[i] * length, 0};
  Point(30 + i) = {(along[i] - 0.5) * length, -across[i] * length, 0};
EndFor
right[] = {1};
left[] = {1};
For i In {0 : count - 1}
  right[] += {10 + i};
  left[] += {30 + i};
EndFor
right[] += {2};
left[] += {2};
For i In {0 : count}
  Line(100 + i) = {right[i], right[i + 1]};
  Line(200 + i) = {left[i], left[i + 1]};
EndFor
Curve Loop(1) = {100 : 100 + count, -(200 + count) : -200};
Plane Surface(1) = {1};
Extrude {0, 0, bend_radius} { Surface{1}; }

Cylinder(2) = {0, -length, bend_radius, 0, 2 * length, 0, bend_radius};
Cylinder(3) = {0, -length, bend_radius, 0, 2 * length, 0, bend_radius - thickness};
BooleanDifference(4) = { Volume{2}; Delete; }{ Volume{3}; Delete; };
BooleanIntersection(5) = { Volume{1}; Delete; }{ Volume{4}; Delete; };

Mesh.MeshSizeMax = length / 16;
