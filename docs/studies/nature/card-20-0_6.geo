// A card of 120 x 20 x 0.6 mm.
width = 0.020; thickness = 0.6e-3;
Include "card.geo";
