"""A body along its path as shaded silhouettes: which frames are shown, and what is painted."""

from typing import Any

import numpy as np

LONGEST_STRETCH = 24.0  # body lengths of path that silhouettes still can be made out on
MOST_SILHOUETTES = 40
SEPARATE_SHARE = 0.9
MOST_TRIANGLES = 4000  # of one silhouette
MOST_PAINTED = 12000  # triangles in all silhouettes of a view, with their far sides
# A view's rows: the world's direction that points right, up, and towards the viewer.
FRONT = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
SIDE = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]])


def rotations(orientation: Any) -> Any:
    """The matrices (n, 3, 3) of unit quaternions x, y, z, w (n, 4): shape to world axes."""
    x, y, z, w = np.asarray(orientation, dtype=float).T
    return np.moveaxis(np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                                 [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                                 [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]), -1, 0)


def _hull(vertices: Any) -> Any:
    """The vertices that are outermost in directions spread evenly over the sphere."""
    i = np.arange(256)
    height = 1.0 - 2.0 * (i + 0.5) / 256
    azimuth = 2.0 * np.pi * i / ((1.0 + np.sqrt(5.0)) / 2.0)
    radius = np.sqrt(1.0 - height**2)
    directions = np.column_stack([radius * np.cos(azimuth), radius * np.sin(azimuth), height])
    return vertices[np.unique(np.argmax(directions @ vertices.T, axis=1))]


def _reach(hull: Any, position: Any, rotation: Any) -> Any:
    """How far a silhouette reaches along twelve axes in each view: (frames, view, axis, low or high)."""
    angles = np.pi * np.arange(12) / 12
    axes = np.concatenate([np.outer(np.cos(angles), view[0]) + np.outer(np.sin(angles), view[1])
                           for view in (FRONT, SIDE)])
    reach = np.empty((len(position), 24, 2))
    for begin in range(0, len(position), 200):
        part = slice(begin, begin + 200)
        along = np.einsum("hi,fji,aj->fah", hull, rotation[part], axes, optimize=True)
        middle = position[part] @ axes.T
        reach[part] = np.stack([middle + along.min(axis=2), middle + along.max(axis=2)], axis=2)
    return reach.reshape(len(position), 2, 12, 2)


def chosen_frames(position: Any, rotation: Any, vertices: Any, first: int, last: int) -> tuple[int, list[int]]:
    """The first frame of the path that is shown, and the frames of the silhouettes, at even intervals.

    Of frames `first` to `last` of a fall the last stretch that spans no more than 24 times the body's largest extent is
    shown. The interval is the smallest at which nine in ten neighbours do not overlap in either view, front and side,
    but no more than twice that at which nine in ten do not overlap in one of the views; 40 silhouettes at most; one
    alone where the body keeps its place. """
    hull = _hull(vertices)
    extent = np.sqrt(((hull[:, None] - hull[None]) ** 2).sum(axis=2).max())
    back = position[first:last + 1][::-1]
    spans = (np.maximum.accumulate(back) - np.minimum.accumulate(back)).max(axis=1)
    first = last - int(np.searchsorted(spans > LONGEST_STRETCH * extent, True)) + 1
    length = last - first
    reach = _reach(hull, position[first:last + 1], rotation[first:last + 1])
    longest = length
    stride = max(1, -(-length // (MOST_SILHOUETTES - 1)))
    while stride <= longest:
        picked = reach[::stride]
        apart = (picked[:-1, ..., 1] < picked[1:, ..., 0]) | (picked[1:, ..., 1] < picked[:-1, ..., 0])
        views = apart.any(axis=2).sum(axis=1)  # in how many of the two views a line passes between neighbours
        enough = SEPARATE_SHARE * (len(picked) - 1)
        frames = list(range(first, last + 1, stride))
        if (views == 2).sum() >= enough:
            return first, frames
        if (views > 0).sum() >= enough:
            longest = min(longest, 2 * stride)
        if (views > 0).any() and stride >= longest:
            return first, frames
        stride += 1
    return first, [first]


def simplified(vertices: Any, triangles: Any, most: int) -> tuple[Any, Any]:
    """A surface of the same form with `most` triangles or fewer: vertices are merged over the cells of a grid."""
    extent = np.ptp(vertices, axis=0).max()
    cells = 128.0
    while len(triangles) > most and cells > 2.0:
        keys = np.rint(vertices / (extent / cells)).astype(np.int64)
        _, places = np.unique(keys, axis=0, return_inverse=True)
        places = places.ravel()
        counts = np.bincount(places)
        merged = np.column_stack([np.bincount(places, vertices[:, axis]) / counts for axis in range(3)])
        corners = places[triangles]
        whole = (corners[:, 0] != corners[:, 1]) & (corners[:, 1] != corners[:, 2]) & (corners[:, 2] != corners[:, 0])
        if 0 < whole.sum() <= most:
            return merged, corners[whole]
        cells /= 1.25
    return vertices, triangles


class Silhouettes:
    """A surface made ready to be painted at many poses."""

    def __init__(self, vertices: Any, triangles: Any, count: int) -> None:
        """`vertices` about the centre of mass (m, shape axes); `count`: how many silhouettes there are going to be."""
        self.vertices, self.triangles = simplified(vertices, triangles,
                                                   min(MOST_TRIANGLES, max(12, MOST_PAINTED // count)))
        edges = self.vertices[self.triangles]
        areas = np.cross(edges[:, 1] - edges[:, 0], edges[:, 2] - edges[:, 0])
        faces = areas / np.maximum(np.linalg.norm(areas, axis=1, keepdims=True), 1e-300)
        smooth = np.zeros_like(self.vertices)
        for corner in range(3):
            np.add.at(smooth, self.triangles[:, corner], areas)
        smooth /= np.maximum(np.linalg.norm(smooth, axis=1, keepdims=True), 1e-300)
        corners = smooth[self.triangles]
        alike = np.einsum("tci,ti->tc", corners, faces) > np.cos(0.6)  # else a crease
        self.normals = np.where(alike[..., None], corners, faces[:, None]).mean(axis=1)

    def painted(self, position: Any, rotation: Any, view: Any, color: Any, rim: float) -> tuple[Any, Any]:
        """Polygons (n, 4, 2; m) and their colours at a pose, to be painted in this order: a dark rim, `rim` (m) wide,
        then the triangles that face the viewer from back to front, in shades of `color` as lit from the upper left."""
        right, up, viewer = view
        places = position + self.vertices @ rotation.T
        flat = np.column_stack([places @ right, places @ up])
        a, b, c = (flat[self.triangles[:, corner]] for corner in range(3))
        facing = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0]) > 0.0
        triangles = self.triangles[facing]
        order = np.argsort((places @ viewer)[triangles].sum(axis=1), kind="stable")
        triangles = triangles[order]
        light_from = -0.5 * right + 0.7 * np.array([0.0, 0.0, 1.0]) + 0.6 * viewer
        normals = self.normals[facing][order] @ rotation.T
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
        light = 0.5 + 0.5 * normals @ (light_from / np.linalg.norm(light_from))
        base = np.asarray(color)[:3]
        shades = 0.42 * base + light[:, None] * (base + 0.45 * (1.0 - base) - 0.42 * base)

        directed = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]).astype(np.int64)
        count = len(self.vertices)
        outline = directed[~np.isin(directed[:, 0] * count + directed[:, 1], directed[:, 1] * count + directed[:, 0])]
        begin, end = flat[outline[:, 0]], flat[outline[:, 1]]
        along = end - begin
        along *= rim / np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-300)
        out = np.column_stack([along[:, 1], -along[:, 0]])
        begin, end = begin - 0.5 * along, end + 0.5 * along
        rims = np.stack([begin - out, end - out, end + out, begin + out], axis=1)

        corners = flat[triangles]
        away = corners - corners.mean(axis=1, keepdims=True)
        corners = corners + 0.5 * rim * away / np.maximum(np.linalg.norm(away, axis=2, keepdims=True),
                                                          1e-300)  # no seams
        faces = np.concatenate([corners, corners[:, 2:]], axis=1)
        return np.concatenate([rims, faces]), np.concatenate([np.tile(0.25 * base, (len(rims), 1)), shades])
