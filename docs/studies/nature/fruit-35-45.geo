// A printed fruit, base angle 35 degrees, radius of curvature 45 mm.
angle = 35; radius = 0.045;
Include "fruit.geo";
