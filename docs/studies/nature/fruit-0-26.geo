// A printed fruit, base angle 0 degrees, radius of curvature 26 mm.
angle = 0; radius = 0.026;
Include "fruit.geo";
