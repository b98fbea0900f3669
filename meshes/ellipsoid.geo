// An ellipsoid about the origin with its axes along x, y, z. Metres. The default is the 1:2:4 ellipsoid.
SetFactory("OpenCASCADE");
DefineConstant[
  semi_axis_x = {0.01, Name "Shape/Semi-axis along x (m)"}
  semi_axis_y = {0.02, Name "Shape/Semi-axis along y (m)"}
  semi_axis_z = {0.04, Name "Shape/Semi-axis along z (m)"}
];

Sphere(1) = {0, 0, 0, 1};
Dilate {{0, 0, 0}, {semi_axis_x, semi_axis_y, semi_axis_z}} { Volume{1}; }

Mesh.MeshSizeMax = (semi_axis_x + semi_axis_y + semi_axis_z) / 20;
