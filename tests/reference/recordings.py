"""What was decided in a recording (core/recording/README.md), without a line of mrose's own code."""
import ctypes
import ctypes.util
import struct

ATTACHMENT = 9
zstd = ctypes.CDLL(ctypes.util.find_library("zstd") or "libzstd.so.1")
zstd.ZSTD_getFrameContentSize.restype = ctypes.c_ulonglong
zstd.ZSTD_decompress.restype = ctypes.c_size_t


def decompressed(data):
    size = zstd.ZSTD_getFrameContentSize(data, ctypes.c_size_t(len(data)))
    if size > 1 << 32:
        raise ValueError("no Zstandard frame of a known size")
    out = ctypes.create_string_buffer(max(size, 1))
    got = zstd.ZSTD_decompress(out, ctypes.c_size_t(size), data, ctypes.c_size_t(len(data)))
    if got != size:
        raise ValueError("a damaged Zstandard frame")
    return out.raw[:size]


class Bytes:
    """Little-endian numbers, one after the other."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, size):
        self.at += size
        if self.at > len(self.data):
            raise ValueError("ends too early")
        return self.data[self.at - size : self.at]

    def number(self, form):
        return struct.unpack("<" + form, self.take(struct.calcsize("<" + form)))[0]

    def text(self, length="Q"):
        return self.take(self.number(length))

    def count(self):
        value = shift = 0
        while True:
            byte = self.take(1)[0]
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value

    def done(self):
        return self.at >= len(self.data)


def attachments(path):
    """Name and content of each attachment of an MCAP file."""
    with open(path, "rb") as file:
        records = Bytes(file.read())
    records.take(8)
    while len(records.data) - records.at > 8:
        kind = records.number("B")
        content = Bytes(records.text())
        if kind == ATTACHMENT:
            content.take(16)
            name, _ = content.text("I").decode(), content.text("I")
            yield name, content.text()


def decision(data):
    """As text, numbers to the bit."""
    flags = data.number("B")
    command = lambda: f"v {data.number('d').hex()} w {data.number('d').hex()}"
    words = [command()] if flags & 1 else []
    if flags & 2:
        words += [f"at {data.number('q')} ns {command()}" for _ in range(data.count())]
    if flags & 4:
        words += [f"kick {data.count()} with {data.number('d').hex()}" for _ in range(data.count())]
    if flags & 8:
        words.append("fault " + data.take(data.count()).decode(errors="replace"))
    if flags & 32:
        words += [f"to {data.number('I')}: kind {data.number('I')}, {data.take(data.count()).hex()}" for _ in range(data.count())]
    if flags & 16:
        words.append("from outside")
    return ", ".join(words) or "nothing"


def decisions_1(block):
    """Format 1: first tick, and of each tick the decisions by robot."""
    _, first, _ = block.number("I"), block.number("q"), block.text()
    ticks = block.number("Q")
    block.take(16 * ticks)
    data = Bytes(block.text())
    for tick in range(first, first + ticks):
        decided, robot = {}, -1
        for _ in range(data.count()):
            robot += 1 + data.count()
            decided[robot] = decision(data)
        yield tick, decided


READERS = {1: decisions_1, 2: decisions_1}  # by the version that a block begins with; a new one is added here


def decisions(path):
    """Tick -> robot -> what it decided, of the run itself."""
    run = {}
    for name, content in attachments(path):
        if not name.startswith("mrose/block/0/"):
            continue
        block = Bytes(decompressed(content))
        version = block.number("I")
        if version not in READERS:
            raise ValueError(f"blocks of version {version}: tests/reference/recordings.py has no reader for them")
        run.update(READERS[version](block))
    return run
