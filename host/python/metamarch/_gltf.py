# SPDX-License-Identifier: MIT
"""Puts meshes of NumPy arrays into the bytes of a GLB, which the importer then checks like any file."""
import json
import struct
import zlib

import numpy as np

from ._native import InvalidArgument

_FLOAT, _UINT = 5126, 5125
_OF_PBR = ("baseColorFactor", "baseColorTexture", "metallicFactor", "roughnessFactor", "metallicRoughnessTexture")


def _png(pixels):
    """Returns the PNG of an array of height x width x 3 or 4 bytes."""
    height, width, channels = pixels.shape
    rows = np.zeros((height, 1 + width * channels), np.uint8)  # each begins with its filter: none
    rows[:, 1:] = pixels.reshape(height, -1)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2 if channels == 3 else 6, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows.tobytes(), 1))
            + chunk(b"IEND", b""))


class _Glb:
    def __init__(self):
        self.binary = bytearray()
        self.root = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
                     "materials": [], "accessors": [], "bufferViews": [], "images": [], "textures": []}

    def view(self, data):
        self.binary += b"\0" * (-len(self.binary) % 4)
        self.root["bufferViews"].append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)})
        self.binary += data
        return len(self.root["bufferViews"]) - 1

    def accessor(self, array, kind):
        accessor = {"bufferView": self.view(array.tobytes()), "count": len(array), "type": kind,
                    "componentType": _FLOAT if array.dtype == np.float32 else _UINT}
        self.root["accessors"].append(accessor)
        return len(self.root["accessors"]) - 1

    def texture(self, pixels, what):
        pixels = np.asarray(pixels)
        if pixels.dtype != np.uint8 or pixels.ndim != 3 or pixels.shape[2] not in (3, 4) or pixels.size == 0:
            raise InvalidArgument(f"{what}: give an array of height x width x 3 or 4 of uint8")
        self.root["images"].append({"bufferView": self.view(_png(pixels)), "mimeType": "image/png"})
        self.root["textures"].append({"source": len(self.root["images"]) - 1})
        return {"index": len(self.root["textures"]) - 1}

    def plain(self, value, what):
        """Returns the value as JSON has it: arrays of textures become textures, other arrays lists."""
        if isinstance(value, dict):
            return {key: self.texture(member, f"{what}{key}")
                    if key.endswith("Texture") and not isinstance(member, dict) else
                    self.plain(member, f"{what}{key}.") for key, member in value.items()}
        if isinstance(value, (np.ndarray, np.generic)):
            return value.tolist()
        return [self.plain(member, what) for member in value] if isinstance(value, (list, tuple)) else value

    def material(self, given, name):
        if given is None:
            return None
        if not isinstance(given, dict):
            raise InvalidArgument(f"{name}: give the material as a dictionary with glTF's names")
        material = self.plain(given, f"{name}: material ")
        pbr = {key: material.pop(key) for key in _OF_PBR if key in material}
        if pbr:
            material.setdefault("pbrMetallicRoughness", {}).update(pbr)
        used = self.root.setdefault("extensionsUsed", [])
        used += [key for key in material.get("extensions", {}) if key not in used]
        self.root["materials"].append(material)
        return len(self.root["materials"]) - 1

    def bytes(self):
        self.binary += b"\0" * (-len(self.binary) % 4)
        root = {key: value for key, value in self.root.items() if value != []}
        root["buffers"] = [{"byteLength": len(self.binary)}]
        try:
            text = json.dumps(root, allow_nan=False).encode()
        except (TypeError, ValueError) as error:
            raise InvalidArgument(f"a material holds what glTF cannot: {error}") from None
        text += b" " * (-len(text) % 4)
        length = 12 + 8 + len(text) + 8 + len(self.binary)
        if length >= 1 << 32:
            raise InvalidArgument("the meshes take more than 4 GiB")
        return (struct.pack("<4sII", b"glTF", 2, length) + struct.pack("<I4s", len(text), b"JSON") + text
                + struct.pack("<I4s", len(self.binary), b"BIN\0") + bytes(self.binary))


def _rows(array, columns, kind, what, count=None):
    """Returns the array as rows of `columns` numbers. Raises InvalidArgument for another shape."""
    try:
        with np.errstate(over="ignore"):  # becomes infinite, and is judged as such
            rows = np.ascontiguousarray(array, dtype=kind)
    except (TypeError, ValueError, OverflowError):
        rows = None
    if rows is None or rows.ndim != 2 or rows.shape[1] not in columns or len(rows) == 0:
        wanted = " or ".join(str(number) for number in columns)
        raise InvalidArgument(f"{what}: give an array of N x {wanted}")
    if count is not None and len(rows) != count:
        raise InvalidArgument(f"{what}: {len(rows)} rows for {count} positions")
    return rows


def _bounds(positions, indices, what):
    """Returns the least and the greatest corner of the finite positions. Like in a file, a position that is not finite is
    refused only if a triangle has it."""
    finite = np.isfinite(positions).all(1)
    used = np.arange(len(positions)) if indices is None else indices.reshape(-1)
    broken = used[~finite[used]]
    if len(broken):
        raise InvalidArgument(f"{what}: position of vertex {broken[0]} is not finite")
    return {"min": positions[finite].min(0).tolist(), "max": positions[finite].max(0).tolist()}


def _indices(indices, count, what):
    array = np.asarray(indices)
    if array.dtype.kind not in "iu":
        raise InvalidArgument(f"{what}: give whole numbers")
    if array.size and (array.min() < 0 or array.max() >= count):
        raise InvalidArgument(f"{what}: {array.min() if array.min() < 0 else array.max()} names none of {count} positions")
    return _rows(array, (3,), np.uint32, what)


def glb_of(meshes):
    """Returns the bytes of a GLB with one node for each mesh."""
    glb = _Glb()
    for number, mesh in enumerate(meshes):
        name = mesh.name or f"mesh {number}"
        positions = _rows(mesh.positions, (3,), np.float32, f"{name}: positions")
        count = len(positions)
        indices = None if mesh.indices is None else _indices(mesh.indices, count, f"{name}: indices")
        attributes = {"POSITION": glb.accessor(positions, "VEC3")}
        glb.root["accessors"][-1].update(_bounds(positions, indices, f"{name}: positions"))
        if mesh.normals is not None:
            normals = _rows(mesh.normals, (3,), np.float32, f"{name}: normals", count)
            attributes["NORMAL"] = glb.accessor(normals, "VEC3")
        if mesh.uvs is not None:
            uvs = _rows(mesh.uvs, (2,), np.float32, f"{name}: uvs", count)
            attributes["TEXCOORD_0"] = glb.accessor(uvs, "VEC2")
        if mesh.colors is not None:
            colors = _rows(mesh.colors, (3, 4), np.float32, f"{name}: colors", count)
            attributes["COLOR_0"] = glb.accessor(colors, f"VEC{colors.shape[1]}")
        primitive = {"attributes": attributes}
        if indices is not None:
            primitive["indices"] = glb.accessor(indices.reshape(-1), "SCALAR")
        material = glb.material(mesh.material, name)
        if material is not None:
            primitive["material"] = material
        glb.root["meshes"].append({"name": name, "primitives": [primitive]})
        glb.root["nodes"].append({"name": name, "mesh": number})
        glb.root["scenes"][0]["nodes"].append(number)
    return glb.bytes()
