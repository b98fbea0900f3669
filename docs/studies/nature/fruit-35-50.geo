// A printed fruit, base angle 35 degrees, radius of curvature 50 mm.
angle = 35; radius = 0.05;
Include "fruit.geo";
