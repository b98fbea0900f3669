// A coin of 50 CZK: 27.5 mm wide, 2.55 mm thick, its axis along z. Metres.
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, -0.001275, 0, 0, 0.00255, 0.01375};
Mesh.MeshSizeMax = 0.0018;
