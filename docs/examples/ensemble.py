"""How far leaves scatter: an ensemble study by the Python module (docs/tutorials/python.md).

The loads are those of the surface: by its tables the ready-baked leaf sinks faster and faster for some seconds, unlike full CFD's.
"""
import samara

print("height (m)  wind (m/s)  descent (m/s)    landed  drift (m)  spread (m)  path spread ~ t^p")
for height in (1, 2, 4):
    for wind in (0.0, 1.0):
        motion = samara.simulate({
            "scene": {"duration": 6, "ground": 0}, "fluid": {"preset": "air", "current": [wind, 0, 0]},
            "body": [{"name": "leaf", "shape": "samara:leaf", "loads": "surface", "position": [0, 0, height],
                      "count": 50, "spread": {"angle": 3.1}}]}, runs=4)
        leaf = motion["leaf"].ensemble()
        landing = leaf["landing"]
        print(f"{height:10}  {wind:10}  {leaf['descent_speed']:.3f} +- {leaf['descent_speed_error']:.3f}  "
              f"{landing['count']:3} of {leaf['samples']}  {landing['mean'][0]:9.3f}  {landing['spread']:10.3f}  "
              f"{leaf['path_spread_growth']:17.2f}")
