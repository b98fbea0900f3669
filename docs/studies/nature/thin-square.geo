// A square of 40 x 40 x 0.4 mm, its face across z. Metres.
SetFactory("OpenCASCADE");
Box(1) = {-0.02, -0.02, -0.0002, 0.04, 0.04, 0.0004};
Mesh.MeshSizeMax = 0.0025;
