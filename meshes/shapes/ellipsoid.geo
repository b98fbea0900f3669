// An ellipsoid about the origin with its axes along x, y, z. Metres. The default is the 1:2:4 ellipsoid.
SetFactory("OpenCASCADE");
DefineConstant[
  semi_axis_x = {0.01, Name "Shape/Semi-axis along x (m)"}
  semi_axis_y = {0.02, Name "Shape/Semi-axis along y (m)"}
  semi_axis_z = {0.04, Name "Shape/Semi-axis along z (m)"}
];

// Of eight octants: triangles on a whole sphere are poor at its poles and seam.
Geometry.OCCUnionUnify = 0;
Sphere(1) = {0, 0, 0, 1, 0, Pi / 2, Pi / 2};
For quarter In {1 : 3}
  Rotate {{0, 0, 1}, {0, 0, 0}, quarter * Pi / 2} { Duplicata { Volume{1}; } }
EndFor
Rotate {{1, 0, 0}, {0, 0, 0}, Pi} { Duplicata { Volume{1:4}; } }
BooleanUnion(9) = { Volume{1}; Delete; }{ Volume{2:8}; Delete; };
Dilate {{0, 0, 0}, {semi_axis_x, semi_axis_y, semi_axis_z}} { Volume{9}; }

Mesh.MeshSizeMax = (semi_axis_x + semi_axis_y + semi_axis_z) / 20;
