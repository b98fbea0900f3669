// A sharp-edged plate of 32.4 x 6.48 x 0.81 mm, its face across z, its length along x. Metres.
SetFactory("OpenCASCADE");
Box(1) = {-0.0162, -0.00324, -0.000405, 0.0324, 0.00648, 0.00081};
Mesh.MeshSizeMax = 0.0008;
