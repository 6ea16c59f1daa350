"""A link between two network namespaces that is as slow and as long as one likes.

The kernel's TCP at both ends; between them a thread carries packets from one TUN device to the
other, at a rate, after a delay, and drops what finds the queue full: as tc's netem does, which many
kernels lack.
"""

import collections
import fcntl
import os
import select
import shutil
import struct
import subprocess
import threading
import time

TUNSETIFF, IFF_TUN, IFF_NO_PI = 0x400454CA, 0x0001, 0x1000
PACKET_BYTES = 2048  # More than the device's 1500.
QUEUE_BYTES = 1000 * 1500  # A thousand packets, as many devices have.


def run(*words):
    subprocess.run(words, check=True, capture_output=True, text=True)


def why_not():
    """Why there can be no links here; empty where there can."""
    if not shutil.which("ip"):
        return "ip (iproute2) is not installed"
    if os.geteuid() != 0:
        return "only root may make network namespaces"
    try:
        with ShapedLink(f"volcast-try{os.getpid()}"):
            return ""
    except (OSError, subprocess.CalledProcessError) as error:
        return f"no link between network namespaces: {getattr(error, 'stderr', None) or error}".strip()


class Way:
    """One direction: `rate` in bytes/s (0: as fast as it comes), `delay` in seconds."""

    def __init__(self, source, target):
        self.source, self.target = source, target
        self.rate, self.delay = 0.0, 0.0
        self.free = 0.0  # When all that came has passed the slow part.
        self.waiting = collections.deque()  # (when it arrives, packet)
        self.dropped = 0

    def take(self):
        """Reads what there is."""
        try:
            while True:
                packet, now = os.read(self.source, PACKET_BYTES), time.monotonic()
                if self.rate and (self.free - now) * self.rate > QUEUE_BYTES:
                    self.dropped += 1
                    continue
                self.free = max(self.free, now) + (len(packet) / self.rate if self.rate else 0)
                self.waiting.append((self.free + self.delay, packet))
        except BlockingIOError:
            pass

    def give(self):
        """Writes what has arrived; seconds until the next does, None where there is none."""
        while self.waiting:
            left = self.waiting[0][0] - time.monotonic()
            if left > 0:
                return left
            try:
                os.write(self.target, self.waiting.popleft()[1])
            except OSError:
                self.dropped += 1  # The device is not up, or full.
        return None


class ShapedLink:
    """Two namespaces and the link; a context manager, which takes them away."""

    address = "10.203.77.1"  # Of the server; seen in the two namespaces alone.

    def __init__(self, name):
        self.server, self.client = f"{name}s", f"{name}c"
        self.devices, self.thread = [], None
        self.end, self.ended = os.pipe()

    def __enter__(self):
        try:
            for space, address in ((self.server, self.address), (self.client, "10.203.77.2")):
                device = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK | os.O_CLOEXEC)
                self.devices.append(device)
                name = f"vc{os.getpid()}{space[-1]}"  # At most 15 bytes.
                fcntl.ioctl(device, TUNSETIFF,
                            struct.pack("16sH22x", name.encode(), IFF_TUN | IFF_NO_PI))
                run("ip", "netns", "add", space)
                run("ip", "link", "set", name, "netns", space)
                run("ip", "-n", space, "address", "add", f"{address}/24", "dev", name)
                run("ip", "-n", space, "link", "set", name, "up")
                run("ip", "-n", space, "link", "set", "lo", "up")
        except BaseException:
            self.__exit__()
            raise
        server, client = self.devices
        self.down, self.up = Way(server, client), Way(client, server)
        self.thread = threading.Thread(target=self.carry)
        self.thread.start()
        return self

    def __exit__(self, *_):
        os.close(self.ended)
        if self.thread:
            self.thread.join()
        for descriptor in (*self.devices, self.end):
            os.close(descriptor)
        for space in (self.server, self.client):
            subprocess.run(["ip", "netns", "delete", space], capture_output=True, check=False)

    def carry(self):
        ways = (self.down, self.up)
        while True:
            left = [wait for wait in (way.give() for way in ways) if wait is not None]
            ready, _, _ = select.select([self.end, *self.devices], [], [], min(left, default=None))
            if self.end in ready:
                return
            for way in ways:
                if way.source in ready:
                    way.take()

    def in_server(self):
        return ["ip", "netns", "exec", self.server]

    def in_client(self):
        return ["ip", "netns", "exec", self.client]

    def shape(self, mbit, delay_ms):
        """`mbit` towards the client, half of `delay_ms` each way."""
        self.down.rate = mbit * 1e6 / 8
        self.down.delay = self.up.delay = delay_ms / 2e3
