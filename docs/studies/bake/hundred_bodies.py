#!/usr/bin/env python3
"""Prints a scene of ten shapes at ten densities, for the plan of a large bake (docs/how-to/cluster.md):

    docs/studies/bake/hundred_bodies.py >hundred.toml
    samara bake hundred.toml -o hundred --whole-grid --dry-run
"""
import pathlib

SHAPES = pathlib.Path(__file__).resolve().parents[3] / "meshes/shapes"
NAMES = ("airplane", "cube", "disc", "ellipsoid", "leaf", "maple-leaf", "oak-leaf", "samara", "sheet", "sphere")

print('[scene]\nduration = 2.0\n[fluid]\npreset = "water"')
for name in NAMES:
    for i in range(10):
        print(f'[[body]]\nname = "{name}-{i}"\nshape = "{SHAPES / name}.geo"\ndensity = {1100 + 40 * i}')
