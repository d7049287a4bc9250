# SPDX-License-Identifier: MIT
"""A handler for a server without a machine of its own: a GLB comes in, a PNG goes out, both in base64.

    {"glb": "...", "width": 512, "height": 512, "spp": 32}  ->  {"statusCode": 200, "body": "..."}

Without a Vulkan driver the processor renders. A scene that is refused is the sender's fault, and gets the reason.
"""
import base64
import tempfile
from pathlib import Path

import metamarch

MOST_PIXELS = 1 << 20
MOST_SAMPLES = 256


def handler(event, context=None):
    size = int(event.get("width", 512)), int(event.get("height", 512))
    spp = int(event.get("spp", 32))
    if size[0] * size[1] > MOST_PIXELS or spp > MOST_SAMPLES:
        return {"statusCode": 413, "body": f"at most {MOST_PIXELS} pixels and {MOST_SAMPLES} samples"}
    try:
        scene = metamarch.load(base64.b64decode(event["glb"]), name="the scene")
        film = metamarch.render(scene, size=size, spp=spp)
    except (metamarch.InputRefused, metamarch.InvalidArgument) as error:
        return {"statusCode": 400, "body": str(error)}
    with tempfile.TemporaryDirectory() as folder:
        picture = Path(folder) / "picture.png"
        film.save(picture)
        return {"statusCode": 200, "headers": {"Content-Type": "image/png"}, "isBase64Encoded": True,
                "body": base64.b64encode(picture.read_bytes()).decode()}
