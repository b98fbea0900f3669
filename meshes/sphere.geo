// A sphere about the origin. Metres.
SetFactory("OpenCASCADE");
DefineConstant[ radius = {0.02, Name "Shape/Radius (m)"} ];

Sphere(1) = {0, 0, 0, radius};

Mesh.MeshSizeMax = radius / 5;
