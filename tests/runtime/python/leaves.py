"""The scene that the tests of the Python module fly."""


def leaves(**more):
    body = {"name": "leaf", "shape": "samara:leaf", "position": [0, 0, 2], "count": 3, "spread": {"angle": 0.5}}
    return {"scene": {"duration": 0.5, "step": 0.002, "frame_rate": 50}, "fluid": {"preset": "air"}, "body": [body | more]}


# So many, for so long, that a flight can be stopped on its way.
long_flight = leaves(count=200) | {"scene": {"duration": 60.0}}
