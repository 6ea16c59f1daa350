#!/usr/bin/python3
"""Volcast's protocol from outside: opens a view, orbits it, saves the final picture.

Needs python3-websockets (Debian). Frames are binary messages with a 16-byte prefix; all else is
JSON. See protocol/README.md.
"""

import argparse
import asyncio
import json
import math
import struct
import sys

import websockets

VIEW = 1


def take_apart(message):
    """(prefix as a dict, header as a dict, picture as bytes) of a frame."""
    version, kind, flags, length, view, sequence = struct.unpack_from("<BBHIII", message)
    if (version, kind, flags & 1) != (1, 1, 1):
        raise ValueError(f"not a frame with a JSON header: {message[:16].hex()}")
    header = json.loads(message[16:16 + length])
    return {"view": view, "sequence": sequence}, header, message[16 + length:]


def turned(camera, angle):
    """The camera, turned about the z axis through its center; angle in radians."""
    eye, center = camera["eye"], camera.get("center", {})
    x, y = eye["x"] - center.get("x", 0), eye["y"] - center.get("y", 0)
    c, s = math.cos(angle), math.sin(angle)
    place = {"x": center.get("x", 0) + c * x - s * y, "y": center.get("y", 0) + s * x + c * y}
    return {**camera, "eye": {**eye, **place}}


async def talk(options):
    async with websockets.connect(options.url, subprotocols=["volcast.v1"], max_size=None,
                                  compression=None) as socket:
        async def send(name, body):
            await socket.send(json.dumps({name: body}))

        await send("hello", {"major": 1, "client": "client.py"})
        await send("openView", {"view": VIEW, "dataset": options.dataset, "inputSeq": "1",
                                "viewport": {"width": options.width, "height": options.height}})
        camera, asked, frames, size = None, 1, 0, 0
        async for message in socket:
            if isinstance(message, str):
                body = json.loads(message)
                if "error" in body:
                    raise RuntimeError(body["error"]["message"])
                camera = body.get("viewOpened", {}).get("scene", {}).get("camera", camera)
                continue
            prefix, header, picture = take_apart(message)
            frames, size = frames + 1, size + len(message)
            await send("ack", prefix)
            shown = int(header.get("inputSeq", 0))
            if shown == asked and asked <= options.steps:
                asked += 1
                await send("update", {"view": VIEW, "inputSeq": str(asked),
                                      "camera": turned(camera, 2 * math.pi * asked / options.steps)})
            elif shown == asked and header.get("final") and header["codec"] == "CODEC_PNG":
                with open(options.output, "wb") as file:
                    file.write(picture)
                print(f"{frames} frames, {size} bytes; {header['width']} x {header['height']} "
                      f"lossless in {options.output}")
                return
        raise RuntimeError("the server closed the connection")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("url", nargs="?", default="ws://127.0.0.1:8080/v1/ws")
    parser.add_argument("--dataset", default="", help="none: the first that the server lists")
    parser.add_argument("--steps", type=int, default=36, help="of one turn")
    parser.add_argument("--width", type=int, default=512)
    parser.add_argument("--height", type=int, default=512)
    parser.add_argument("--output", default="final.png")
    parser.add_argument("--timeout", type=float, default=120, help="seconds")
    options = parser.parse_args()
    try:
        asyncio.run(asyncio.wait_for(talk(options), options.timeout))
    except asyncio.TimeoutError:  # An OSError, too.
        sys.exit(f"client.py: not done within {options.timeout:g} s")
    except (OSError, RuntimeError, ValueError, websockets.WebSocketException) as error:
        sys.exit(f"client.py: {error}")


if __name__ == "__main__":
    main()
