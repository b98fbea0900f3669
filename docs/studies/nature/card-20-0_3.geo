// A card of 120 x 20 x 0.3 mm.
width = 0.020; thickness = 0.3e-3;
Include "card.geo";
