// A sharp-edged box of 12 x 24 x 36 mm about the origin. Metres.
SetFactory("OpenCASCADE");
Box(1) = {-0.006, -0.012, -0.018, 0.012, 0.024, 0.036};
Mesh.MeshSizeMax = 0.003;
