// A maple samara: a thick nut about the origin and a thin wing out along +x. Metres. The wing lies across z with its
// stiff, nearly straight edge at +y; z = 0 is the mirror plane. One closed surface: nut and wing weigh differently, so
// give the mass, its centre and the inertia in the scene.
SetFactory("OpenCASCADE");
DefineConstant[
  nut_length = {0.010, Name "Shape/Nut, length along x (m)"}
  nut_width = {0.008, Name "Shape/Nut, width along y (m)"}
  nut_thickness = {0.004, Name "Shape/Nut, thickness along z (m)"}
  wing_length = {0.035, Name "Shape/Wing, from the nut's middle to the tip (m)"}
  wing_width = {0.012, Name "Shape/Wing, greatest width (m)"}
  wing_thickness = {0.0003, Name "Shape/Wing, thickness (m)"}
];

Sphere(1) = {0, 0, 0, 0.5};
Dilate {{0, 0, 0}, {nut_length, nut_width, nut_thickness}} { Volume{1}; }

// The outline from the root's +y corner around the tip to the -y corner: (place along the wing, place across it).
along[] = {0.08, 0.3, 0.55, 0.8, 0.95, 1.0, 0.96, 0.85, 0.68, 0.5, 0.3, 0.08};
across[] = {0.2, 0.27, 0.32, 0.33, 0.25, 0.03, -0.25, -0.52, -0.66, -0.65, -0.45, -0.2};
For i In {0 : 11}
  Point(100 + i) = {along[i] * wing_length, across[i] * wing_width, -wing_thickness / 2};
EndFor
Spline(100) = {100 : 111};
Line(101) = {111, 100};
Curve Loop(100) = {100, 101};
Plane Surface(100) = {100};
wing[] = Extrude {0, 0, wing_thickness} { Surface{100}; };
BooleanUnion(10) = { Volume{1}; Delete; }{ Volume{wing[1]}; Delete; };

Mesh.MeshSizeMax = wing_width / 6;
