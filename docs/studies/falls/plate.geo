// A sharp-edged plate of 60 x 20 x 2.5 mm, its face across z, its length along x. Metres.
SetFactory("OpenCASCADE");
Box(1) = {-0.03, -0.01, -0.00125, 0.06, 0.02, 0.0025};
Mesh.MeshSizeMax = 0.002;
