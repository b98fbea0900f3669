#!/usr/bin/env python3
"""Prints the base pressure (in units of rho U^2 / 2) by which a sphere has its measured drag in the loads of its surface, for each
Reynolds number of their tables: `smooth_wakes` of runtime/core/body/surface_loads.cpp. The measured drag is that of Brown and
Lawler, J. Env. Eng. 129, 222 (2003); Stokes' resistance and the friction of a laminar boundary layer are taken off it."""

import math

FLOOR = -0.68  # SurfacePressure::smooth_floor
STEPS = 4000


def measured_drag(reynolds):
    return 24 / reynolds * (1 + 0.15 * reynolds**0.681) + 0.407 / (1 + 8710 / reynolds)


def pressure_drag(base):
    """Returns the drag coefficient of the pressure on a sphere, whose potential flow is exact."""
    drag = 0.0
    for step in range(STEPS):
        angle = math.pi * (step + 0.5) / STEPS
        cosine = math.cos(angle)
        attached = 1 - 2.25 * math.sin(angle) ** 2
        if cosine >= 0:
            pressure = max(attached, FLOOR)
        else:
            in_wake = 1 - (1 + cosine) ** 5
            pressure = in_wake * base + (1 - in_wake) * min(0.0, max(attached, base))
        drag += 2 * math.pi / STEPS * pressure * cosine * math.sin(angle)
    return drag


def main():
    for reynolds in (1, 3, 10, 30, 100, 300, 1e3, 3e3, 1e4, 1e5):
        wanted = measured_drag(reynolds) - 24 / reynolds - 1.33 * 8 / 3 / math.sqrt(reynolds)
        low, high = -3.0, 0.5
        while high - low > 1e-5:
            middle = 0.5 * (low + high)
            low, high = (middle, high) if pressure_drag(middle) > wanted else (low, middle)
        print(f"{reynolds:8g} {low:.3f}")


if __name__ == "__main__":
    main()
