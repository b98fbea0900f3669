// A sharp-edged disc, three tenths as thick as wide, its axis along z. Metres.
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, -0.006, 0, 0, 0.012, 0.02};
Mesh.MeshSizeMax = 0.0025;
