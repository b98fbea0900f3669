// A disc of 40 x 0.4 mm, its axis along z. Metres.
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, -0.0002, 0, 0, 0.0004, 0.02};
Mesh.MeshSizeMax = 0.0025;
