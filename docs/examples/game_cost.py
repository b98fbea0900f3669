"""What a body costs in each frame of a game, in the air, while it lands and at rest (docs/reference/c.md#cost-in-a-game).

All times are relative to the first: a leaf in the air, at steps of 2 ms.
"""
import time

import numpy
import samara

COUNT, FRAME, SECONDS = 100, 1 / 60, 6


def costs(body, fluid, density, step, collide):
    """CPU seconds of one body and frame: in the air, from its first contact to rest, at rest."""
    simulation = samara.Simulation(samara.Scene({
        "scene": {"duration": SECONDS, "step": step, "ground": 0, "bodies_collide": collide}, "fluid": {"preset": fluid},
        "body": [{"name": body, "shape": f"samara:{body}", "density": density, "loads": "surface",
                  "position": [0, 0, 1.5], "count": COUNT,
                  "spread": {"angle": 3.1, "position": [3, 3, 0]}}]}))
    simulation.watch_contacts(True)
    touched, rows = numpy.zeros(COUNT, bool), []
    for frame in range(1, round(SECONDS / FRAME) + 1):
        begin = time.thread_time()
        simulation.advance(frame * FRAME)
        seconds = time.thread_time() - begin
        contacts = simulation.take_contacts(body)
        touched |= contacts["strongest"][0] > 0
        resting = int(contacts["at_rest"][0].sum())
        landing = int((touched & ~contacts["at_rest"][0].astype(bool)).sum())
        rows.append((seconds, COUNT - landing - resting, landing, resting))
    rows = numpy.array(rows[2:])
    air, rest = (numpy.median(rows[rows[:, column] == COUNT, 0]) / COUNT for column in (1, 3))
    mixed = rows[rows[:, 2] > 0].sum(axis=0)
    return air, (mixed[0] - air * mixed[1] - rest * mixed[3]) / mixed[2], rest


unit = costs("leaf", "air", 600, 0.002, False)[0]
print("body   step (ms)  collide     air  landing  at rest")
for name, *where in (("leaf", "air", 600), ("cube", "water", 2000)):
    for h in (0.002, FRAME):
        for together in (False, True):
            air, landing, rest = (value / unit for value in costs(name, *where, h, together))
            print(f"{name:5}  {1000 * h:9.1f}  {'yes' if together else 'no':7} {air:7.2f}  {landing:7.1f}  {rest:7.2f}")
