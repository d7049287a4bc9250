# SPDX-License-Identifier: MIT
"""The types of options, for editors and type checkers. tests/python compares this file with the declarations."""
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal, TypedDict

if TYPE_CHECKING:
    from . import Camera


class LoadOptions(TypedDict, total=False):
    scale: float
    scene: str | int
    variant: str | int
    time: float
    animation: str | int
    allow_missing_textures: bool
    tree_depth: int
    unit: float | Sequence[float]
    cells: int
    table: Literal["unit", "gcd", "rectilinear"]
    quantum: float
    merge: bool
    partition: str | os.PathLike[str]
    no_exit_boxes: bool
    preset: Literal["paper"]


class RenderOptions(TypedDict, total=False):
    size: tuple[int, int] | str
    aov: str | Sequence[str]
    miss_depth: float
    frame_rate: float
    transparent: bool
    denoise: bool
    shadow_catcher: str
    catcher_reflection: float
    camera: "Camera | str | int"
    eye: Sequence[float]
    target: Sequence[float]
    up: Sequence[float]
    vfov: float
    orthographic: float
    aperture: float
    focus_distance: float
    panorama: bool
    filter: Literal["box", "tent", "blackman-harris"]
    backend: Literal["gpu", "cpu"]
    device: str | int
    traversal: str
    integrator: Literal["path", "direct", "ao", "primary"]
    spp: int
    seed: int
    max_bounces: int
    clamp: float
    brdf: Literal["compensated", "gltf"]
    noise_threshold: float
    min_spp: int
    time_limit: float
    crop: Sequence[int]
    env: str | os.PathLike[str]
    env_rotation: float
    env_intensity: float
    env_max: float
    background: Sequence[float]
    sky: bool
    sun: Sequence[float]


class SaveOptions(TypedDict, total=False):
    stamp: bool
    format: Literal["exr", "png", "jpeg", "webp", "tiff"]
    bits: Literal[8, 16]
    half: bool
    compression: str
    tiled: bool
    multipart: bool
    tone_map: Literal["none", "neutral", "aces", "agx"]
    exposure: float
