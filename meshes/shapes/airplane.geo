// A paper dart folded from a square sheet, as one closed body. Metres. Nose at the origin and towards -x, wings
// along y, keel down along -z; y = 0 is its mirror plane.
//
// The sheet is creased along its middle, its two front corners are folded in to the crease, and the wings are folded
// out `keel_height` from the crease. Both halves of the keel lie flat against each other. The folded corners lie inside:
// the front half of the sheet is double, the rear half single, which is averaged so that the body has the sheet's volume.
DefineConstant[
  side = {0.083, Name "Shape/Side of the sheet (m)"}
  paper = {0.0001, Name "Shape/Thickness of the paper (m)"}
  keel_height = {0.015, Name "Shape/Height of the keel (m)"}
  dihedral = {10, Name "Shape/Angle of the wings above the horizontal (degrees)"}
];

wing_thickness = paper * 4 / 3;
half_keel = wing_thickness;             // half the thickness of the keel: one panel
span = side / 2 - keel_height;          // of one wing, along the paper
slope = Tan(dihedral * Pi / 180);
along_y = Cos(dihedral * Pi / 180);
along_z = Sin(dihedral * Pi / 180);

// The cross-section, from the keel's bottom to the middle of the top.
bottom_z = -keel_height;
root_z = -wing_thickness / along_y + half_keel * slope;
tip_upper_y = span * along_y;
tip_upper_z = span * along_z;
tip_lower_y = tip_upper_y + wing_thickness * along_z;
tip_lower_z = tip_upper_z - wing_thickness * along_y;

// The 45-degree front edge of the folded sheet: along the paper as far back as it is out from the crease.
root_x = keel_height;
tip_x = side / 2;
// Where the wing's lower root meets the plane of the leading edge, which stands square on the wing.
lower_root_x = root_x + (half_keel * along_y + root_z * along_z) * (tip_x - root_x) / span;

lc = side / 7.4;                        // 294 triangles when gmsh meshes this file by itself
front = 0; rear = 20; left = 10;
// Right half in 1 to 5 (front) and 21 to 25 (rear), left half in 11 to 14 and 31 to 34.
For end In {0 : 1}
  For half In {0 : 1}
    y = 1 - 2 * half;
    n = rear * end + left * half;
    Point(n + 1) = {end ? side : 0, y * half_keel, bottom_z, lc};
    Point(n + 2) = {end ? side : lower_root_x, y * half_keel, root_z, lc};
    Point(n + 3) = {end ? side : tip_x, y * tip_lower_y, tip_lower_z, lc};
    Point(n + 4) = {end ? side : tip_x, y * tip_upper_y, tip_upper_z, lc};
  EndFor
  Point(rear * end + 5) = {end ? side : root_x, 0, 0, lc};
EndFor
For end In {0 : 1}
  For half In {0 : 1}
    n = rear * end + left * half;
    line = 100 + 50 * end + left * half;
    Line(line + 21) = {n + 1, n + 2};
    Line(line + 22) = {n + 2, n + 3};
    Line(line + 23) = {n + 3, n + 4};
    Line(line + 24) = {n + 4, rear * end + 5};
  EndFor
  Line(140 + 50 * end) = {rear * end + 1, rear * end + left + 1};
EndFor
Line(105) = {5, 25};
Line(141) = {2, 12};
For half In {0 : 1}
  n = left * half;
  For point In {1 : 4}
    Line(100 + n + point) = {n + point, rear + n + point};
  EndFor
  Line(125 + n) = {n + 2, 5};
  Curve Loop(n + 1) = {121 + n, 102 + n, -(171 + n), -(101 + n)};    // side of the keel
  Curve Loop(n + 2) = {122 + n, 103 + n, -(172 + n), -(102 + n)};    // under the wing
  Curve Loop(n + 3) = {123 + n, 104 + n, -(173 + n), -(103 + n)};    // tip
  Curve Loop(n + 4) = {124 + n, 105, -(174 + n), -(104 + n)};        // above the wing
  Curve Loop(n + 5) = {122 + n, 123 + n, 124 + n, -(125 + n)};       // leading edge
EndFor
Curve Loop(21) = {121, 141, -131, -140};                             // front of the keel
Curve Loop(22) = {125, -135, -141};                                  // front of the wings' root
Curve Loop(23) = {140, 111, -190, -101};                             // bottom of the keel
Curve Loop(24) = {171, 172, 173, 174, -184, -183, -182, -181, -190}; // rear
For loop In {1 : 24}
  If (loop <= 5 || (loop >= 11 && loop <= 15) || loop >= 21)
    Plane Surface(loop) = {loop};
  EndIf
EndFor
// Outwards, for those who export the mesh with gmsh itself.
ReverseMesh Surface{5, 11 : 14, 21 : 23};
Surface Loop(1) = {1 : 5, 11 : 15, 21 : 24};
Volume(1) = {1};
