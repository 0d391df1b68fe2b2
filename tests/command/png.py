"""Reads PNG files of 8 and 16 bits, without a library."""
import struct
import zlib


def read_png(file):
    """Rows of a PNG file from the top; a pixel is a number, or a tuple of its channels."""
    data = file.read_bytes()
    assert data.startswith(b"\x89PNG\r\n\x1a\n"), f"{file} is no PNG"
    width, height, bits, colour = struct.unpack(">IIBB", data[16:26])
    channels = {0: 1, 2: 3}[colour]
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        packed += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += 12 + size
    step = channels * bits // 8
    raw, stride, before, rows = zlib.decompress(packed), step * width, bytes(step * width), []
    for y in range(height):
        line = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        unfilter(raw[y * (stride + 1)], line, before, step)
        before = bytes(line)
        values = struct.unpack(f">{width * channels}{'H' if bits == 16 else 'B'}", before)
        rows.append(values if channels == 1 else [values[i:i + 3] for i in range(0, len(values), 3)])
    return rows


def unfilter(kind, line, before, step):
    """The filters of the PNG specification, section 9."""
    for i in range(len(line)):
        left = line[i - step] if i >= step else 0
        above, corner = before[i], before[i - step] if i >= step else 0
        if kind == 1:
            line[i] = (line[i] + left) & 255
        elif kind == 2:
            line[i] = (line[i] + above) & 255
        elif kind == 3:
            line[i] = (line[i] + (left + above) // 2) & 255
        elif kind == 4:
            guess = left + above - corner
            line[i] = (line[i] + min((left, above, corner), key=lambda value: abs(guess - value))) & 255
