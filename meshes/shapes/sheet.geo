// A flat sheet of paper about the origin: its face across z, its edges along x and y. Metres.
SetFactory("OpenCASCADE");
DefineConstant[
  length = {0.083, Name "Shape/Length along x (m)"}
  width = {0.083, Name "Shape/Width along y (m)"}
  thickness = {0.0001, Name "Shape/Thickness (m)"}
];

Box(1) = {-length / 2, -width / 2, -thickness / 2, length, width, thickness};

Mesh.MeshSizeMax = (length + width) / 32;
