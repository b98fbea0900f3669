"""The scene's wind, which keys may change from frame to frame."""

import types

from .conventions import frame_count, metres_per_unit
from .samara_library import SamaraError

_CARRYING = ("wind_speed", "wind_direction")  # what carries the gusts along
_KEYED = _CARRYING + ("use_wind", "gust_speed", "wind_height", "wind_roughness", "wind_exponent")
_FIXED = ("wind_profile", "gust_length", "gust_spectrum", "gust_seed", "use_ground", "ground")


def _curves(scene):
    """Returns the curves that animate the wind, by name and index. Raises SamaraError for what may not be animated."""
    data = scene.animation_data
    curves = {}
    for curve in [] if data is None else list(data.drivers) + (list(data.action.fcurves) if data.action else []):
        name = curve.data_path.rpartition("samara.")[2]
        if curve.data_path != f"samara.{name}" or name not in _KEYED + _FIXED:
            continue
        title = scene.samara.bl_rna.properties[name].name
        if curve.driver is not None:
            raise SamaraError(f"the wind's {title} has a driver; bake it to keys, or remove it")
        if name in _FIXED:
            raise SamaraError(f"the {title} has keys, but may not change during a simulation; remove them")
        curves[name, curve.array_index] = curve
    return curves


def _at(settings, curves, frame):
    """Returns the properties of the wind at a frame."""
    wind = types.SimpleNamespace(**{name: getattr(settings, name) for name in _KEYED + _FIXED})
    wind.wind_direction = wind.wind_direction.copy()
    for (name, index), curve in curves.items():
        value = curve.evaluate(frame)
        if name == "wind_direction":
            wind.wind_direction[index] = value
        else:
            setattr(wind, name, value >= 0.5 if name == "use_wind" else value)
    return wind


def _text_of(wind, unit):
    """Returns the wind as the keys of [wind], in TOML and SI units; empty where there is none."""
    if not wind.use_wind:
        return ""
    direction = wind.wind_direction
    if wind.wind_profile != "NONE":
        direction.z = 0.0
    if direction.length == 0.0 and wind.wind_speed > 0.0:
        raise SamaraError("the wind has no direction; set one, which must be horizontal with a profile")
    direction.normalize()
    lines = [f"velocity = {[unit * wind.wind_speed * x for x in direction]}"]
    if wind.wind_profile != "NONE" and wind.wind_speed > 0.0:
        law = (
            f'law = "log", roughness = {unit * wind.wind_roughness!r}'
            if wind.wind_profile == "LOG"
            else f'law = "power", exponent = {wind.wind_exponent!r}'
        )
        ground = unit * wind.ground if wind.use_ground else 0.0
        lines.append(f"profile = {{ {law}, height = {unit * wind.wind_height!r}, ground = {ground!r} }}")
    if wind.gust_speed > 0.0:
        spectrum = {"VON_KARMAN": "von-karman", "KAIMAL": "kaimal"}[wind.gust_spectrum]
        lines.append(
            f'gusts = {{ spectrum = "{spectrum}", rms = {unit * wind.gust_speed!r}, '
            f"length = {unit * wind.gust_length!r}, seed = {wind.gust_seed} }}"
        )
    return "\n".join(lines)


def winds_of(scene):
    """Returns the wind, or where keys change it one for each frame after the first: that half a frame before it, which blows from
    the previous frame to this one."""
    settings, unit, curves = scene.samara, metres_per_unit(scene), _curves(scene)
    if not curves:
        return (_text_of(_at(settings, {}, 0.0), unit),)
    winds = [_at(settings, curves, scene.frame_start + i + 0.5) for i in range(frame_count(scene) - 1)]
    if any(name in _CARRYING for name, _ in curves) and any(wind.use_wind and wind.gust_speed > 0.0 for wind in winds):
        raise SamaraError("the wind has keys of Speed or Direction, by which its gusts would jump; set Gusts to 0, or remove these keys")
    return tuple(_text_of(wind, unit) for wind in winds)
