# SPDX-License-Identifier: MIT
"""A handler for a server without a machine of its own: a GLB comes in, a PNG goes out, both in base64.

    {"glb": "...", "width": 512, "height": 512, "spp": 32}  ->  {"statusCode": 200, "body": "..."}

The request may also be the text `body` of a request by HTTP. Without a Vulkan driver the processor renders. What is wrong
with a request, or with its scene, is answered in one line.
"""
import base64
import json
import tempfile
from pathlib import Path

import metamarch

MOST_PIXELS = 1 << 20
MOST_SAMPLES = 256


class BadRequest(Exception):
    """What the sender has to change, in one line."""


def request_of(event):
    """Returns the object that the request is."""
    request = event
    if isinstance(event, dict) and "body" in event:
        try:
            request = json.loads(event["body"])
        except (TypeError, ValueError, RecursionError):
            raise BadRequest("the request is not JSON") from None
    if not isinstance(request, dict):
        raise BadRequest('the request is not an object: give {"glb": "..."}')
    return request


def count_of(request, name, default):
    count = request.get(name, default)
    if type(count) is not int:  # True is an int too
        raise BadRequest(f"{name}: give a whole number")
    return count


def glb_of(request):
    try:
        return base64.b64decode(request["glb"], validate=True)
    except KeyError:
        raise BadRequest("glb is missing") from None
    except (TypeError, ValueError):
        raise BadRequest("glb: give the file in base64") from None


def handler(event, context=None):
    def refuse(status, error):
        return {"statusCode": status, "headers": {"Content-Type": "text/plain"}, "body": str(error)}

    try:
        request = request_of(event)
        size = count_of(request, "width", 512), count_of(request, "height", 512)
        spp = count_of(request, "spp", 32)
        if size[0] * size[1] > MOST_PIXELS or spp > MOST_SAMPLES:
            return refuse(413, f"at most {MOST_PIXELS} pixels and {MOST_SAMPLES} samples")
        scene = metamarch.load(glb_of(request), name="the scene")
        film = metamarch.render(scene, size=size, spp=spp)
    except (BadRequest, metamarch.InputRefused, metamarch.InvalidArgument) as error:
        return refuse(400, error)
    except metamarch.OutOfMemory as error:
        return refuse(413, error)
    with tempfile.TemporaryDirectory() as folder:
        picture = Path(folder) / "picture.png"
        film.save(picture)
        return {"statusCode": 200, "headers": {"Content-Type": "image/png"}, "isBase64Encoded": True,
                "body": base64.b64encode(picture.read_bytes()).decode()}
