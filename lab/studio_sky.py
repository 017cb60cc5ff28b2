"""Writes scenes/studio.hdr, the image of the sky of scenes/studio.toml: a dim room with two soft boxes and a lamp.

    python3 lab/studio_sky.py scenes/studio.hdr
"""

import math
import pathlib
import sys

WIDTH, HEIGHT = 128, 64
# Azimuth and elevation of the middle, half width and half height, in degrees; edge of the fall-off; radiance.
LIGHTS = ((125.0, 38.0, 22.0, 16.0, 3.0, (9.0, 8.6, 8.0)), (-20.0, 20.0, 9.0, 24.0, 3.0, (2.2, 2.9, 4.4)),
          (40.0, 58.0, 1.5, 1.5, 0.5, (950.0, 620.0, 330.0)))


def radiance(azimuth, elevation):
    """Of a direction, degrees: walls that grow brighter upwards, a warm floor, and the lights."""
    up = max(elevation, 0.0) / 90.0
    colour = [0.05 + 0.22 * up, 0.055 + 0.24 * up, 0.07 + 0.3 * up] if elevation > 0.0 else [0.06, 0.05, 0.042]
    for middle, height, half_width, half_height, edge, light in LIGHTS:
        across = abs((azimuth - middle + 180.0) % 360.0 - 180.0) - half_width
        along = abs(elevation - height) - half_height
        part = min(max(0.5 - max(across, along) / edge, 0.0), 1.0)
        colour = [own + part * its for own, its in zip(colour, light)]
    return colour


def rgbe(colour):
    """A pixel of a Radiance image (G. Ward 1991, "Real Pixels", Graphics Gems II)."""
    fraction, exponent = math.frexp(max(colour))
    scale = 256.0 * fraction / max(colour)
    return bytes([*(int(scale * value) for value in colour), exponent + 128])


def component_runs(values):
    """A component of a row as runs of equal values, and of others."""
    out, start = bytearray(), 0
    while start < len(values):
        end = start + 1
        while end < len(values) and values[end] == values[start] and end - start < 127:
            end += 1
        if end - start > 2:
            out += bytes([128 + end - start, values[start]])
        else:
            out += bytes([end - start, *values[start:end]])
        start = end
    return bytes(out)


def image():
    out = bytearray(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {HEIGHT} +X {WIDTH}\n".encode())
    for row in range(HEIGHT):
        elevation = 90.0 - 180.0 * (row + 0.5) / HEIGHT
        pixels = [rgbe(radiance(180.0 - 360.0 * (column + 0.5) / WIDTH, elevation)) for column in range(WIDTH)]
        out += bytes([2, 2, WIDTH >> 8, WIDTH & 255])
        for component in range(4):
            out += component_runs([pixel[component] for pixel in pixels])
    return bytes(out)


if __name__ == "__main__":
    pathlib.Path(sys.argv[1]).write_bytes(image())
