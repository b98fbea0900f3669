// A printed fruit: a pod about the origin and two wings that rise from it, stand at `angle` (degrees) to the upright axis z
// for 15 mm and are then bent outwards with `radius` (m) for 60 mm. Their profile is an arc, hollow side out and down, pitched by
// 15 degrees. Metres. The file that includes this one sets both. Sizes as in the authors' CAD file; there the wing's root
// is cut level where it leans, here square.
SetFactory("OpenCASCADE");
pod = 0.010;
chord = 0.016072; pitch = 15 * Pi / 180; camber = 0.020; thickness = 0.000819;
offset = 0.002; straight = 0.015; curved = 0.060;
straights = 4; curves = 24;

half = Asin(chord / 2 / camber);
rise = camber * Cos(half);
x = offset; z = 0; theta = angle * Pi / 180;
For i In {0 : straights + curves}
  p = 100 + 10 * i;
  // Corners: of the outer arc (0, 1), of the inner one (2, 3); their middle (4).
  For corner In {0 : 4}
    arc = corner < 2 ? camber : camber - thickness;
    turn = (corner == 0 || corner == 3) ? -half : half;
    along = corner == 4 ? 0 : arc * Sin(turn);
    out = corner == 4 ? rise : rise - arc * Cos(turn);
    across = along * Cos(pitch) + out * Sin(pitch);
    off = out * Cos(pitch) - along * Sin(pitch);
    Point(p + corner) = {x + off * Cos(theta), across, z - off * Sin(theta)};
  EndFor
  Circle(p) = {p, p + 4, p + 1};
  Line(p + 1) = {p + 1, p + 2};
  Circle(p + 2) = {p + 2, p + 4, p + 3};
  Line(p + 3) = {p + 3, p};
  Curve Loop(100 + i) = {p, p + 1, p + 2, p + 3};
  bend = i < straights ? 0 : curved / curves / radius;
  step = i < straights ? straight / straights : curved / curves;
  theta += bend / 2; x += step * Sin(theta); z += step * Cos(theta); theta += bend / 2;
EndFor
ThruSections(1) = {100 : 100 + straights + curves};
Rotate {{0, 0, 1}, {0, 0, 0}, Pi} { Duplicata { Volume{1}; } }
Sphere(3) = {0, 0, 0, pod};
BooleanUnion(4) = { Volume{3}; Delete; }{ Volume{1, 2}; Delete; };

Mesh.MeshSizeMax = 0.0025;
