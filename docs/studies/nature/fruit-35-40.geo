// A printed fruit, base angle 35 degrees, radius of curvature 40 mm.
angle = 35; radius = 0.04;
Include "fruit.geo";
