// A printed fruit, base angle 35 degrees, radius of curvature 100 mm.
angle = 35; radius = 0.1;
Include "fruit.geo";
