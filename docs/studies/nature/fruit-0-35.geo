// A printed fruit, base angle 0 degrees, radius of curvature 35 mm.
angle = 0; radius = 0.035;
Include "fruit.geo";
