// A sphere about the origin. Metres.
SetFactory("OpenCASCADE");
DefineConstant[ radius = {0.02, Name "Shape/Radius (m)"} ];

// Of eight octants: triangles on a whole sphere are poor at its poles and seam.
Geometry.OCCUnionUnify = 0;
Sphere(1) = {0, 0, 0, radius, 0, Pi / 2, Pi / 2};
For quarter In {1 : 3}
  Rotate {{0, 0, 1}, {0, 0, 0}, quarter * Pi / 2} { Duplicata { Volume{1}; } }
EndFor
Rotate {{1, 0, 0}, {0, 0, 0}, Pi} { Duplicata { Volume{1:4}; } }
BooleanUnion(9) = { Volume{1}; Delete; }{ Volume{2:8}; Delete; };

Mesh.MeshSizeMax = radius / 5;
