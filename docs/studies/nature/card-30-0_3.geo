// A card of 120 x 30 x 0.3 mm.
width = 0.030; thickness = 0.3e-3;
Include "card.geo";
