// A printed fruit, base angle 35 degrees, straight wings.
angle = 35; radius = 10.0;
Include "fruit.geo";
