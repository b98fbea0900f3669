// A coin of 5 CZK: 23 mm wide, 1.85 mm thick, its axis along z. Metres.
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, -0.000925, 0, 0, 0.00185, 0.0115};
Mesh.MeshSizeMax = 0.0015;
