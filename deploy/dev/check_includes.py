"""Fails on an include that its layer must not have: upward, or of a library with another home.

The table is the one in README.md. Layers are named by the longest prefix of a path that is a key.
"""

import pathlib
import re
import subprocess
import sys

SCENE_MODEL = ["renderer/scene/camera", "renderer/scene/channels", "renderer/scene/control_states",
               "renderer/scene/default_scene", "renderer/scene/layer_fields", "renderer/scene/picked",
               "renderer/scene/ray_models", "renderer/scene/scale", "renderer/scene/scene_diff",
               "renderer/scene/scene", "renderer/scene/user_controls", "renderer/scene/user_shader",
               "renderer/scene/validate"]
BASE = ["renderer/base"]
MODEL = BASE + ["renderer/data", "renderer/user_shader", *SCENE_MODEL]
DRAWING = MODEL + ["renderer/plan", "renderer/gpu", "renderer/shading"]
MEASUREMENT = "renderer/accuracy/measurement"  # Plain structs, for the server too.
# Both ends of the channel between server and worker; no GL.
MESSAGES = [f"renderer/worker/{part}" for part in
            ("channel", "exit_codes", "fault_names", "frame_message", "measure_message", "pick_message",
             "scene_json", "scene_message", "slot_layout", "user_shader_message")]
WORKERS = MODEL + MESSAGES + ["renderer/plan", MEASUREMENT, "server/workers"]
SESSION = WORKERS + ["protocol", "server/video", "server/metrics", "server/session",
                     "server/settings"]

ALLOWED = {
    "renderer/base": BASE,
    "renderer/data": BASE + ["renderer/data"],
    "renderer/data/load": BASE + ["renderer/data", "renderer/data/load"],
    "renderer/user_shader": BASE + ["renderer/user_shader"],
    "renderer/gpu": BASE + ["renderer/gpu"],
    "renderer/shading": BASE + ["renderer/gpu", "renderer/shading", "shaders/shared"],
    **{part: MODEL for part in SCENE_MODEL},
    "renderer/reference": MODEL + ["renderer/reference"],
    "renderer/pick": MODEL + ["renderer/plan", "renderer/reference", "renderer/pick"],
    "renderer/plan": MODEL + ["renderer/plan"],
    "renderer/drawing": DRAWING + ["renderer/drawing"],
    "renderer/mesh": DRAWING + ["renderer/drawing", "renderer/mesh", "shaders/shared"],
    "renderer/volume": DRAWING + ["renderer/drawing", "renderer/volume", "shaders/shared"],
    "renderer/scene": DRAWING + ["renderer/mesh", "renderer/volume", "renderer/scene",
                                 "shaders/shared"],
    **{part: MODEL + ["renderer/plan", MEASUREMENT, *MESSAGES] for part in MESSAGES},
    "renderer/accuracy": DRAWING + ["renderer/reference", "renderer/accuracy", "renderer/scene"],
    MEASUREMENT: MODEL + ["renderer/plan", MEASUREMENT],
    "renderer/worker": ["renderer", "shaders/shared"],
    "protocol": BASE + ["protocol"],
    "server/video": BASE + ["server/video"],
    "server/workers": WORKERS,
    "server/metrics": BASE + ["protocol", "server/metrics"],
    "server/session": SESSION,
    "server/net": SESSION + ["server/net"],
    "server/load": SESSION + ["server/net/client_loop", "server/load"],
    "server/commands": MODEL + MESSAGES + ["renderer/plan", MEASUREMENT, "protocol", "server"],
    "server/settings": BASE + ["server"],
    "server/main": ["server/commands"],
    "server/import": BASE + ["renderer/data", "renderer/worker/channel",
                                         "renderer/worker/fault_names", "server/import"],
    "tests": [""],
}
GL_HOMES = ["renderer/gpu", "renderer/shading", "renderer/drawing", "renderer/mesh",
            "renderer/volume", "renderer/scene", "tests"]
HOMES = {  # what an angle include names -> who may name it
    r"boost/(asio|beast)": ["server/net", "tests/support", "tests/e2e", "tests/bench"],
    r"glslang/": ["renderer/user_shader"],
    r"EGL/": ["renderer/gpu"],
    r"epoxy/": GL_HOMES,
    r"tetgen|OpenImageIO": ["renderer/data/load", "tests"],
    r"turbojpeg|libdeflate|webp/|xxhash|libav|libsw": ["server/video", "tests"],
    r"openssl/": ["server/session", "server/net", "tests"],
    r"prometheus/": ["server/metrics"],
    r"seccomp|linux/landlock": ["renderer/base"],
}
INCLUDE = re.compile(r'^\s*#include\s+([<"])([^>"]+)[>"]', re.M)


def layer(path, table):
    """Longest key of `table` that `path` starts with, or None."""
    return max((key for key in table if path.startswith(key)), key=len, default=None)


def complaints(path, text):
    row = layer(path, ALLOWED)
    for kind, name in INCLUDE.findall(text):
        if kind == '"' and name.split("/")[0] in ("renderer", "server", "protocol", "shaders"):
            if row is None or not any(name.startswith(a) for a in ALLOWED[row]):
                yield f"{path}: may not include {name} (layer {row})"
        for pattern, homes in HOMES.items():
            if kind == "<" and re.match(pattern, name):
                if not any(path.startswith(home) for home in homes):
                    yield f"{path}: may not include <{name}>; its home is {', '.join(homes)}"


def main():
    root = pathlib.Path(__file__).resolve().parents[2]
    listed = subprocess.run(["git", "ls-files", "*.cpp", "*.h"], cwd=root, check=True,
                            capture_output=True, text=True).stdout.split()
    bad = [line for path in listed if (root / path).exists()
           for line in complaints(path, (root / path).read_text())]
    print("\n".join(bad) if bad else f"{len(listed)} files include only what their layer may")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
