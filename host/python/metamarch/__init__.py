# SPDX-License-Identifier: MIT
"""metamarch renders glTF scenes, on a Vulkan device or on the processor alone.

>>> import metamarch
>>> scene = metamarch.load("scenes/cornell.glb")
>>> film = metamarch.render(scene, size=(16, 16), spp=1, backend="cpu")
>>> film.rgb.shape
(16, 16, 3)

Options have the names and meanings of `metamarch render --help`, with underscores: `--max-bounces 2` is `max_bounces=2`.
The pictures have the bytes that the program writes. World space is glTF's: right-handed, +Y up, lengths in metres.
Pixel (0, 0) of a picture is top left; arrays of a picture have the shape (height, width) or (height, width, channels).
"""
from __future__ import annotations

import json
import os
import warnings
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import _native
from ._gltf import glb_of
from ._native import (Error, InputRefused, InvalidArgument, Mismatch, NoDevice, OutOfMemory, OutputNotWritable)
from ._options import LOAD, RENDER, SAVE, help_text, words_of

if TYPE_CHECKING:
    from typing import Unpack

    from numpy.typing import ArrayLike, NDArray

    from ._option_types import LoadOptions, RenderOptions, SaveOptions

__all__ = [
    "Animation", "Camera", "ChannelComparison", "Comparison", "Error", "Film", "Hits", "InputRefused", "InvalidArgument",
    "Light", "Material", "Mesh", "MeshInstance", "Mismatch", "NoDevice", "OutOfMemory", "OutputNotWritable", "Scene",
    "SceneWarning", "Tracer", "compare", "from_arrays", "from_meshes", "load", "progressive", "render"
]

__version__: str = _native.version.split()[1]


class SceneWarning(UserWarning):
    """What the program would print as a warning: the scene or its light is not quite what the file asks for."""


def _warn(lines: Iterable[str]) -> None:
    for line in lines:
        warnings.warn(line, SceneWarning, stacklevel=3)


class Camera(NamedTuple):
    """A camera of the file, in world space. `forward` and `up` have unit length."""
    index: int
    name: str
    projection: str  # "perspective" or "orthographic"
    eye: tuple[float, float, float]
    forward: tuple[float, float, float]
    up: tuple[float, float, float]
    vfov: float | None  # degrees; of a perspective
    height: float | None  # of the picture in world units; orthographic


class Light(NamedTuple):
    """A light of the file without extent, in world space and glTF's units."""
    name: str
    type: str  # "directional", "point" or "spot"
    color: tuple[float, float, float]  # linear
    intensity: float  # candela; of a directional light lux
    position: tuple[float, float, float] | None
    direction: tuple[float, float, float] | None


class Material(NamedTuple):
    """A material and the number of triangles that have it."""
    name: str
    triangles: int


class Animation(NamedTuple):
    """An animation and the time of its last key in seconds."""
    name: str
    seconds: float


class MeshInstance(NamedTuple):
    """A mesh at one place in the scene: its name, its index in the file, and the name of the node that places it."""
    name: str
    mesh: int
    node: str


class Hits(NamedTuple):
    """What N rays hit first, see Tracer."""
    t: NDArray[np.float32]  # (N,), in lengths of the direction; inf for a miss
    triangle: NDArray[np.int32]  # (N,), row of Scene.triangles; -1 for a miss
    uv: NDArray[np.float32]  # (N, 2), barycentric weights of the second and the third corner


@dataclass
class Mesh:
    """A mesh without a file.

    positions: (V, 3), metres
    indices: (F, 3), rows of `positions`, counter-clockwise seen from the front; None: positions are F * 3 corners
    normals: (V, 3); None: each triangle is flat
    uvs: (V, 2), (0, 0) is the upper left corner of a texture
    colors: (V, 3 or 4), linear, in [0, 1]; multiply the base colour
    material: glTF's material with glTF's names; those of pbrMetallicRoughness may stand at the top:
        {"baseColorFactor": (0.8, 0.1, 0.1, 1), "metallicFactor": 0, "roughnessFactor": 0.4}.
        A texture is an array of height x width x 3 or 4 of uint8. None: glTF's default, a white rough metal
    """
    positions: ArrayLike
    indices: ArrayLike | None = None
    normals: ArrayLike | None = None
    uvs: ArrayLike | None = None
    colors: ArrayLike | None = None
    material: dict[str, Any] | None = None
    name: str = ""


class Scene:
    """A scene in memory, by load(), from_arrays() or from_meshes(). It keeps its acceleration structure, its light and
    its copy on a device for the next picture. Several threads may use it at the same time.

    What the file holds:

    >>> scene = load("scenes/cornell.glb")
    >>> scene
    <metamarch.Scene: 32 triangles, 4 materials>
    >>> scene.materials[0], scene.meshes[0].name, scene.cameras[0].projection
    (Material(name='white', triangles=26), 'room', 'perspective')
    >>> scene.scenes, scene.variants, scene.animations, scene.lights
    ([''], [], [], [])

    Its geometry:

    >>> lo, hi = scene.bounds
    >>> bool((scene.positions >= lo).all() and (scene.positions <= hi).all())
    True
    >>> [array.shape[1] for array in (scene.positions, scene.normals, scene.uvs, scene.triangles)]
    [3, 3, 2, 3]
    >>> scene.materials[scene.triangle_material[0]].name, scene.meshes[scene.triangle_mesh[0]].name
    ('white', 'room')
    """

    def __init__(self, native: _native.Scene) -> None:
        self._native = native

    @cached_property
    def _contents(self) -> dict[str, Any]:
        return json.loads(self._native.contents())

    @property
    def cameras(self) -> list[Camera]:
        """The cameras; render(camera=...) takes one, its name or its index."""
        return [
            Camera(index, camera["name"], camera["projection"], tuple(camera["eye"]), tuple(camera["forward"]),
                   tuple(camera["up"]), camera.get("verticalFov"), camera.get("height"))
            for index, camera in enumerate(self._contents["cameras"])
        ]

    @property
    def lights(self) -> list[Light]:
        """The lights without extent."""
        def point(value: list[float] | None) -> Any:
            return None if value is None else tuple(value)

        return [
            Light(light["name"], light["type"], tuple(light["color"]), light["intensity"], point(light.get("position")),
                  point(light.get("direction"))) for light in self._contents["lights"]
        ]

    @property
    def materials(self) -> list[Material]:
        """The materials; Scene.triangle_material and the channel id.material count in this list."""
        return [Material(material["name"], material["triangles"]) for material in self._contents["materials"]]

    @property
    def meshes(self) -> list[MeshInstance]:
        """The meshes where nodes place them; Scene.triangle_mesh and the channel id.instance count in this list."""
        return [MeshInstance(*mesh) for mesh in self._native.meshes()]

    @property
    def scenes(self) -> list[str]:
        """The names of the scenes of the file; load(scene=...) chooses one."""
        return self._contents["scenes"]

    @property
    def variants(self) -> list[str]:
        """The names of the material variants; load(variant=...) chooses one."""
        return self._contents["variants"]

    @property
    def animations(self) -> list[Animation]:
        """The animations; load(time=..., animation=...) poses the scene."""
        return [Animation(animation["name"], animation["seconds"]) for animation in self._contents["animations"]]

    @property
    def bounds(self) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """The least and the greatest corner of the box around all triangles, (3,) each, metres."""
        return self._native.bounds()

    @property
    def positions(self) -> NDArray[np.float32]:
        """(V, 3): the vertices in world space. Like all arrays of a scene it is not a copy, and cannot be written."""
        return self._native.positions

    @property
    def normals(self) -> NDArray[np.float32]:
        """(V, 3): unit length, or zero where the file gives none, which means the triangle's normal."""
        return self._native.normals

    @property
    def uvs(self) -> NDArray[np.float32]:
        """(V, 2): the first set of texture coordinates; zero where the file gives none."""
        return self._native.uvs

    @property
    def triangles(self) -> NDArray[np.uint32]:
        """(F, 3): rows of `positions`, counter-clockwise seen from the front."""
        return self._native.triangles

    @property
    def triangle_mesh(self) -> NDArray[np.uint32]:
        """(F,): index into `meshes`."""
        return self._native.triangle_mesh

    @property
    def triangle_material(self) -> NDArray[np.uint32]:
        """(F,): index into `materials`; 4294967295 for none."""
        return self._native.triangle_material

    def __repr__(self) -> str:
        return f"<metamarch.Scene: {len(self.triangles)} triangles, {len(self.materials)} materials>"


class Film:
    """A picture. Its arrays are not copies, and cannot be written.

    >>> film = render(load("scenes/cornell.glb"), size=(16, 12), spp=2, aov=("Z", "N"), backend="cpu")
    >>> film
    <metamarch.Film: 16 x 12, 2 samples, cpu>
    >>> film.channels
    ['R', 'G', 'B', 'A', 'Z', 'N.X', 'N.Y', 'N.Z']
    >>> film["Z"].shape, film["N"].shape, film.rgb.shape, film.rgba8(tone_map="agx").dtype, "id.mesh" in film
    ((12, 16), (12, 16, 3), (12, 16, 3), dtype('uint8'), False)
    >>> film.size, film.samples, film.is_complete, film.device, film.driver
    ((16, 12), 2, True, 'cpu', 'metamarch')
    >>> f"{film.traversal} took {film.seconds} s"  # doctest: +ELLIPSIS
    '... took ... s'

    Where a point of the world is in the picture:

    >>> scene = load("scenes/cornell.glb")
    >>> x, y, z, w = film.world_to_ndc @ (*np.mean(scene.bounds, axis=0), 1)
    >>> round(float(x / w), 2), round(float(y / w), 2)
    (0.5, 0.5)
    >>> x, y, z, w = film.world_to_camera @ (*scene.cameras[0].eye, 1)
    >>> bool(abs(z) < 1e-5)
    True
    """

    def __init__(self, native: _native.Film) -> None:
        self._native = native

    @property
    def channels(self) -> list[str]:
        """The names of the channels, as in an EXR: R, G, B, A, Z, N.X, ..."""
        return self._native.channels

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Returns a channel, (height, width): film["Z"]. The name before the last dot returns all channels of the group,
        (height, width, channels): film["N"]. Values are float32; ids and counts are uint32."""
        array = self._native.channel(name)
        if array is None:
            raise KeyError(f"{name}: the film has {', '.join(self.channels)}; render(aov=...) asks for more")
        return array

    def __contains__(self, name: str) -> bool:
        return self._native.channel(name) is not None

    @property
    def rgb(self) -> NDArray[np.float32]:
        """(height, width, 3): linear radiance."""
        array = self._native.channel("")
        assert array is not None
        return array

    def rgba8(self, **options: Unpack[SaveOptions]) -> NDArray[np.uint8]:
        """Returns the pixels of a PNG, (height, width, 4): tone-mapped, sRGB-coded, alpha not multiplied.

        Takes tone_map and exposure, see save().
        """
        return self._native.rgba8(words_of("Film.rgba8", SAVE, options))

    def save(self, path: str | os.PathLike[str], **options: Unpack[SaveOptions]) -> None:
        """Writes the picture as `metamarch render` does, with the same bytes: .exr (all channels), .png, .jpg, .webp or
        .tif. The file appears whole or not at all.

        >>> import pathlib, tempfile
        >>> film = render(load("scenes/cornell.glb"), size=(4, 4), spp=1, backend="cpu")
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     film.save(pathlib.Path(folder) / "cornell.exr", half=True)
        ...     compare(pathlib.Path(folder) / "cornell.exr", film, max_abs=0.01).passed
        True

        Options:
        """
        self._native.save(os.fsencode(path), words_of("Film.save", SAVE, options))

    @property
    def samples(self) -> int:
        """The number of samples that every pixel has."""
        return self._native.samples

    @property
    def is_complete(self) -> bool:
        """Whether the film has all samples that were asked for."""
        return self._native.is_complete

    @property
    def device(self) -> str:
        """The name of the Vulkan device that rendered, or "cpu"."""
        return self._native.device

    @property
    def driver(self) -> str:
        """The driver of the device, with its version."""
        return self._native.driver

    @property
    def traversal(self) -> str:
        """How rays found triangles."""
        return self._native.traversal

    @property
    def seconds(self) -> float:
        """What the render took, without loading the scene."""
        return self._native.seconds

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) in pixels."""
        return self._native.width, self._native.height

    @property
    def world_to_camera(self) -> NDArray[np.float32]:
        """(4, 4), for column vectors: x right, y up, z ahead, as OpenEXR defines worldToCamera."""
        return self._native.world_to_camera

    @property
    def world_to_ndc(self) -> NDArray[np.float32]:
        """(4, 4), for column vectors: after the division (0, 0) is the upper left corner of the picture, (1, 1) the lower
        right one, as OpenEXR defines worldToNDC. Not for a panorama."""
        return self._native.world_to_ndc

    def __repr__(self) -> str:
        return f"<metamarch.Film: {self.size[0]} x {self.size[1]}, {self.samples} samples, {self.device}>"


class Tracer:
    """Casts rays at a scene.

    >>> scene = from_arrays([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    >>> hits = Tracer(scene).trace([(0.25, 0.5, 2)], [(0, 0, -1)])
    >>> float(hits.t[0]), int(hits.triangle[0]), hits.uv[0].tolist()
    (2.0, 0, [0.25, 0.5])
    """

    def __init__(self, scene: Scene, *, backend: str = "cpu", device: str = "") -> None:
        """`backend` is "cpu" or "gpu"; both find the same triangles at the same t. `device` is for the gpu, see
        render()."""
        if backend not in ("cpu", "gpu"):
            raise InvalidArgument(f"backend={backend!r}: give gpu or cpu")
        self._native = _native.Tracer(scene._native, backend == "gpu", str(device))

    def trace(self, origins: ArrayLike, directions: ArrayLike, *, t_min: float = 0.0,
              t_max: float = float("inf")) -> Hits:
        """Returns the first hit of each ray with t_min < t <= t_max.

        origins, directions: (N, 3), world space. Directions need no unit length; t counts their lengths.
        """
        return Hits(*self._native.trace(_rays(origins), _rays(directions), t_min, t_max))


def _rays(array: ArrayLike) -> NDArray[np.float32]:
    try:
        return np.ascontiguousarray(array, dtype=np.float32)
    except (TypeError, ValueError):
        raise InvalidArgument("give origins and directions as two arrays of N x 3") from None


class ChannelComparison(NamedTuple):
    """How far apart two pictures are in one channel."""
    name: str
    judged: bool  # False for the channels that count work
    rmse: float
    relative_mse: float  # mean of (a - b)^2 / (b^2 + 0.01)
    mean_difference: float  # of a - b
    max_difference: float
    worst: tuple[int, int]  # the pixel of max_difference: x from the left, y from the top
    worst_a: float
    worst_b: float
    failing_pixels: int


class Comparison(NamedTuple):
    """How far apart two pictures are. It is true if they are within the bounds."""
    passed: bool
    mismatches: list[str]  # why the pictures cannot be equal: sizes, or a channel that only one has
    pixels: int
    failing_pixels: int
    failing_percent: float
    channels: dict[str, ChannelComparison]

    def __bool__(self) -> bool:
        return self.passed


def load(scene: str | os.PathLike[str] | bytes, *, name: str = "bytes", **options: Unpack[LoadOptions]) -> Scene:
    """Reads a glTF, GLB, OBJ, PLY, OFF or STL file, or the bytes of a GLB, which messages call `name`.

    An untrusted file is refused with one line: InputRefused. Warnings are of the class SceneWarning.

    >>> load("scenes/cornell.glb", scale=0.01)
    <metamarch.Scene: 32 triangles, 4 materials>
    >>> load(b"nothing", name="upload.glb")  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    metamarch.InputRefused: upload.glb: not glTF: ...

    Options:
    """
    words = words_of("load", LOAD, options)
    if isinstance(scene, (bytes, bytearray, memoryview)):
        native = _native.Scene(name, bytes(scene), words)
    else:
        native = _native.Scene(os.fsencode(scene), words)
    _warn(native.warnings)
    return Scene(native)


def from_meshes(meshes: Iterable[Mesh], **options: Unpack[LoadOptions]) -> Scene:
    """Makes a scene of meshes in memory. Options are those of load().

    >>> corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    >>> scene = from_meshes([Mesh(corners, name="left"), Mesh([(x + 2, y, z) for x, y, z in corners], name="right")])
    >>> [mesh.name for mesh in scene.meshes]
    ['left', 'right']
    """
    native = _native.Scene("meshes", glb_of(list(meshes)), words_of("from_meshes", LOAD, options))
    _warn(native.warnings)
    return Scene(native)


def from_arrays(positions: ArrayLike, indices: ArrayLike | None = None, *, normals: ArrayLike | None = None,
                uvs: ArrayLike | None = None, colors: ArrayLike | None = None,
                material: dict[str, Any] | None = None, **options: Unpack[LoadOptions]) -> Scene:
    """Makes a scene of one mesh, see Mesh. Options are those of load().

    >>> scene = from_arrays([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)],
    ...                     material={"baseColorFactor": (0.8, 0.1, 0.1, 1), "metallicFactor": 0})
    >>> len(scene.triangles)
    1
    """
    native = _native.Scene("arrays", glb_of([Mesh(positions, indices, normals, uvs, colors, material)]),
                           words_of("from_arrays", LOAD, options))
    _warn(native.warnings)
    return Scene(native)


def _render_words(call: str, options: dict[str, Any]) -> list[tuple[str, str]]:
    if isinstance(options.get("camera"), Camera):
        options["camera"] = options["camera"].index
    return words_of(call, RENDER, options)


def render(scene: Scene, **options: Unpack[RenderOptions]) -> Film:
    """Renders a picture. Other threads of Python run meanwhile; Ctrl-C ends the render with KeyboardInterrupt.

    Without `backend` a graphics processor renders where there is one with a Vulkan driver, otherwise the processor;
    Film.device says which. A software driver such as lavapipe renders only where `backend`, `device` or a `traversal`
    that the processor lacks asks for it: the processor draws the same picture to the bit, and in wheels it is faster.

    >>> scene = load("scenes/cornell.glb")
    >>> white = render(scene, camera=scene.cameras[0], size=(4, 4), integrator="ao", backend="cpu")
    >>> white.device, white.samples
    ('cpu', 64)

    Options:
    """
    native = scene._native.render(_render_words("render", options), False, None)
    _warn(native.warnings)
    return Film(native)


def progressive(scene: Scene, **options: Unpack[RenderOptions]) -> Iterator[Film]:
    """Yields the film after each pass of 16 samples a pixel; the last one is what render() returns. Options are those of
    render() but time_limit. Leaving the loop ends the render.

    >>> scene = load("scenes/cornell.glb")
    >>> [film.samples for film in progressive(scene, size=(4, 4), spp=40, backend="cpu")]
    [16, 32, 40]
    """
    if "time_limit" in options:
        raise TypeError("progressive() has no option 'time_limit'; leave the loop when you have waited enough")
    return _passes(scene, _render_words("progressive", options))


def _passes(scene: Scene, words: list[tuple[str, str]]) -> Iterator[Film]:
    native = scene._native.render(words, True, None)
    _warn(native.warnings)
    yield Film(native)
    while not native.is_complete:
        native = scene._native.render(words, True, native)
        yield Film(native)


def _image(picture: Film | ArrayLike | str | os.PathLike[str]) -> _native.Image:
    if isinstance(picture, Film):
        return picture._native.image()
    if isinstance(picture, (str, os.PathLike)):
        return _native.read_image(os.fsencode(picture))
    array = np.asarray(picture)
    if array.dtype.kind not in "fiu" or array.ndim not in (2, 3) or array.size == 0:
        raise InvalidArgument("give a film, a path, or an array of height x width or height x width x channels")
    scale = 255 if array.dtype == np.uint8 else 1  # as in a file
    array = np.ascontiguousarray(array.reshape(*array.shape[:2], -1) / np.float32(scale), dtype=np.float32)
    count = array.shape[2]
    names = {1: ["Y"], 3: ["R", "G", "B"], 4: ["R", "G", "B", "A"]}.get(count, [str(i) for i in range(count)])
    return _native.Image(array, names)


def compare(a: Film | ArrayLike | str | os.PathLike[str], b: Film | ArrayLike | str | os.PathLike[str], *,
            max_abs: float = 0.0, max_fail_percent: float = 0.0) -> Comparison:
    """Compares two pictures, channel by channel, as `metamarch compare` does; `b` is the reference.

    A picture is a film, the path of a file, or an array of height x width (x channels). A pixel fails if one of its
    channels differs by more than `max_abs`; the pictures may have `max_fail_percent` of such pixels.

    >>> bool(compare([[0.5, 1.0]], [[0.5, 1.25]], max_abs=0.25))
    True
    >>> comparison = compare([[0.5, 1.0]], [[0.5, 1.25]])
    >>> comparison.passed, comparison.failing_pixels, comparison.channels["Y"].worst
    (False, 1, (1, 0))
    """
    report = _native.compare(_image(a), _image(b), max_abs, max_fail_percent)
    report["channels"] = {channel["name"]: ChannelComparison(**channel) for channel in report["channels"]}
    return Comparison(**report)


load.__doc__ = f"{load.__doc__}{help_text(LOAD)}\n"
render.__doc__ = f"{render.__doc__}{help_text(RENDER)}\n"
Film.save.__doc__ = f"{Film.save.__doc__}{help_text(SAVE)}\n"
