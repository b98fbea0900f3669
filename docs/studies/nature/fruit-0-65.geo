// A printed fruit, base angle 0 degrees, radius of curvature 65 mm.
angle = 0; radius = 0.065;
Include "fruit.geo";
