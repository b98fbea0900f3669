// A cube about the origin with its faces across x, y, z. Metres.
SetFactory("OpenCASCADE");
DefineConstant[ side = {0.02, Name "Shape/Length of an edge (m)"} ];

Box(1) = {-side / 2, -side / 2, -side / 2, side, side, side};

Mesh.MeshSizeMax = side / 8;
