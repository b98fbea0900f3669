// A sharp-edged strip of 100 x 20 x 1 mm, its face across z, its length along x. Metres.
SetFactory("OpenCASCADE");
Box(1) = {-0.05, -0.01, -0.0005, 0.1, 0.02, 0.001};
Mesh.MeshSizeMax = 0.0025;
