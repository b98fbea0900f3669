// A printed fruit, base angle 0 degrees, radius of curvature 20 mm.
angle = 0; radius = 0.02;
Include "fruit.geo";
