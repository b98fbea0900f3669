// A printed fruit, base angle 35 degrees, radius of curvature 35 mm.
angle = 35; radius = 0.035;
Include "fruit.geo";
