// A printed fruit, base angle 35 degrees, radius of curvature 65 mm.
angle = 35; radius = 0.065;
Include "fruit.geo";
