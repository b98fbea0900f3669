// A sharp-edged disc, a tenth as thick as wide, its axis along z. Metres.
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, -0.002, 0, 0, 0.004, 0.02};
Mesh.MeshSizeMax = 0.0025;
