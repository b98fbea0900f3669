// A flat disc with sharp edges about the origin, its axis along z. Metres.
SetFactory("OpenCASCADE");
DefineConstant[
  radius = {0.02, Name "Shape/Radius (m)"}
  thickness = {0.002, Name "Shape/Thickness (m)"}
];

Cylinder(1) = {0, 0, -thickness / 2, 0, 0, thickness, radius};

Mesh.MeshSizeMax = radius / 8;
