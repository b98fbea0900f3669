// An oblate spheroid four times as wide as thick, its axis along z. Metres.
SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0, 1};
Dilate {{0, 0, 0}, {0.02, 0.02, 0.005}} { Volume{1}; }
Mesh.MeshSizeMax = 0.0025;
