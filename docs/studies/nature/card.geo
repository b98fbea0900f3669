// A sharp-edged card 120 mm long along x, its face across z; width and thickness (m) are set by the file that includes this one.
SetFactory("OpenCASCADE");
Box(1) = {-0.06, -width / 2, -thickness / 2, 0.12, width, thickness};
Mesh.MeshSizeMax = width / 8;
