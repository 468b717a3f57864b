"""Procedural textures: periodic lattice noise and plain shapes, as 8-bit PNG files.

A function that takes a folder writes the picture of its name into it.
"""

import math
import random
import struct
import zlib


def write_png(path, width, height, pixel, channels):
    """pixel(x, y) gives values of 0 to 1, sRGB-encoded, as a tuple of `channels`."""
    rows = bytearray()
    for y in range(height):
        row = bytearray()
        for x in range(width):
            for value in pixel(x, y):
                row.append(max(0, min(255, round(255 * value))))
        # Filter 1 (Sub): neighbours are alike.
        rows.append(1)
        for i, byte in enumerate(row):
            rows.append((byte - (row[i - channels] if i >= channels else 0)) & 255)

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    colour = {1: 0, 3: 2}[channels]
    path.write_bytes(b"\x89PNG\r\n\x1a\n"
                     + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, colour, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(bytes(rows), 9)) + chunk(b"IEND", b""))


class Noise:
    """Smooth values of -1 to 1 on a torus of `nx` by `ny` lattice points."""

    def __init__(self, nx, ny, seed):
        draw = random.Random(seed)
        self.nx, self.ny = nx, ny
        self.values = [[draw.uniform(-1, 1) for _ in range(nx)] for _ in range(ny)]

    def at(self, u, v):
        """u and v: 0 to 1 around the torus."""
        x, y = u % 1 * self.nx, v % 1 * self.ny
        i, j = int(x) % self.nx, int(y) % self.ny
        a, b = x - int(x), y - int(y)
        a, b = a * a * (3 - 2 * a), b * b * (3 - 2 * b)
        k, m = (i + 1) % self.nx, (j + 1) % self.ny
        low = self.values[j][i] * (1 - a) + self.values[j][k] * a
        high = self.values[m][i] * (1 - a) + self.values[m][k] * a
        return low * (1 - b) + high * b


def mixed(dark, light, share):
    share = max(0.0, min(1.0, share))
    return tuple(d + (w - d) * share for d, w in zip(dark, light))


def wood(grain, fine, pores, u, v):
    """Share of light wood; the grain runs along v."""
    bend = grain.at(u, v)
    rings = 0.5 + 0.5 * math.sin(2 * math.pi * (6 * u + 1.1 * bend))
    return 0.52 + 0.16 * rings + 0.2 * bend + 0.16 * fine.at(u, v) + 0.12 * min(0, pores.at(u, v))


def parquet(folder):
    """Planks of 0.15 m by 1.2 m: 1.2 m by 1.2 m. Rows are shifted, ends are joints."""
    size, planks = 640, 8
    grain, fine = Noise(24, 3, 1), Noise(320, 10, 2)
    pores = Noise(480, 40, 3)
    draw = random.Random(4)
    shift = [draw.random() for _ in range(planks)]
    tone = [[draw.uniform(-0.16, 0.16) for _ in range(2)] for _ in range(planks)]
    dark, light = (0.43, 0.29, 0.18), (0.74, 0.57, 0.39)

    def pixel(x, y):
        u, v = (x + 0.5) / size, (y + 0.5) / size
        row = int(u * planks)
        across = u * planks - row
        along = (v + shift[row]) % 1
        end = min(along, 1 - along, abs(along - 0.5))
        half = int(along * 2)
        share = wood(grain, fine, pores, u + 0.37 * half, v + shift[row]) + tone[row][half]
        joint = min(across, 1 - across) * 0.15 < 0.0012 or end * 1.2 < 0.0012
        return mixed((0.16, 0.10, 0.06), mixed(dark, light, share), 0.25 if joint else 1)

    write_png(folder / "parquet.png", size, size, pixel, 3)


def veneer(folder):
    """A door's leaf of oak veneer: 0.9 m by 2.1 m, four sheets side by side."""
    width, height, sheets = 360, 840, 4
    grain, fine, pores = Noise(5, 4, 11), Noise(180, 12, 12), Noise(300, 60, 13)
    dark, light = (0.52, 0.38, 0.25), (0.80, 0.66, 0.48)

    def pixel(x, y):
        u, v = (x + 0.5) / width, (y + 0.5) / height
        sheet = int(u * sheets)
        within = u * sheets - sheet
        within = within if sheet % 2 == 0 else 1 - within  # book-matched
        arch = 5.5 * ((within - 0.5) ** 2 + 0.05) + 0.9 * v + 0.18 * grain.at(within, v)
        rings = 0.5 + 0.5 * math.sin(2 * math.pi * 4 * arch)
        share = 0.5 + 0.2 * rings + 0.14 * fine.at(u, v) + 0.14 * min(0, pores.at(u, v))
        return mixed(dark, light, share)

    write_png(folder / "veneer.png", width, height, pixel, 3)


def ceiling_tile(folder):
    """A mineral tile of 0.6 m in half of its grid's bars."""
    size, bar = 384, 0.012
    draw = random.Random(21)
    holes = [[1.0] * size for _ in range(size)]
    for _ in range(2600):
        x, y, dark = draw.randrange(size), draw.randrange(size), draw.uniform(0.55, 0.9)
        for _ in range(draw.choice((1, 1, 2, 4, 7))):
            holes[y % size][x % size] = dark
            x, y = x + draw.choice((0, 1, 1)), y + draw.choice((-1, 0, 1))
    rough = Noise(96, 96, 22)

    def pixel(x, y):
        u, v = (x + 0.5) / size * 0.6, (y + 0.5) / size * 0.6
        edge = min(u, v, 0.6 - u, 0.6 - v)
        if edge < bar:
            return (0.97,)
        if edge < bar + 0.0035:
            return (0.62 + 0.3 * (edge - bar) / 0.0035,)
        return ((0.945 + 0.012 * rough.at(u / 0.6, v / 0.6)) * holes[y][x],)

    write_png(folder / "ceiling_tile.png", size, size, pixel, 1)


def plaster(folder):
    """Painted plaster: 1.2 m by 1.2 m."""
    size = 448
    octaves = [(Noise(7, 7, 31), 0.012), (Noise(40, 40, 32), 0.012), (Noise(150, 150, 33), 0.022)]

    def pixel(x, y):
        u, v = (x + 0.5) / size, (y + 0.5) / size
        return (round(64 * (0.955 + sum(a * n.at(u, v) for n, a in octaves))) / 64 * 1.0,)

    write_png(folder / "plaster.png", size, size, pixel, 1)


def carpet(folder):
    """Four carpet tiles of 0.5 m, laid a quarter turn from each other."""
    size = 448
    pile, streaks, flecks = Noise(224, 224, 41), Noise(16, 224, 42), Noise(112, 112, 43)
    dark, light = (0.20, 0.23, 0.28), (0.43, 0.47, 0.53)

    def pixel(x, y):
        u, v = (x + 0.5) / size, (y + 0.5) / size
        turned = (u < 0.5) != (v < 0.5)
        a, b = (v, u) if turned else (u, v)
        share = 0.5 + 0.28 * pile.at(a, b) + 0.26 * streaks.at(a, b) + 0.12 * flecks.at(a, b)
        joint = min(u % 0.5, 0.5 - u % 0.5, v % 0.5, 0.5 - v % 0.5) < 0.003
        return mixed(dark, light, share - (0.18 if joint else 0))

    write_png(folder / "carpet.png", size, size, pixel, 3)


def terrazzo(folder):
    """Stone chips in grey cement: 0.6 m by 0.6 m."""
    size = 384
    draw = random.Random(71)
    ground = [[0.0] * size for _ in range(size)]
    for _ in range(3400):
        x, y, r = draw.uniform(0, size), draw.uniform(0, size), draw.uniform(1.2, 5.2)
        tone = draw.choice((-0.3, -0.16, 0.1, 0.16, 0.22))
        angle, flat = draw.uniform(0, math.pi), draw.uniform(0.5, 1)
        for j in range(int(y - r), int(y + r) + 1):
            for i in range(int(x - r), int(x + r) + 1):
                dx, dy = i - x, j - y
                along = dx * math.cos(angle) + dy * math.sin(angle)
                across = (-dx * math.sin(angle) + dy * math.cos(angle)) / flat
                if along * along + across * across <= r * r:
                    ground[j % size][i % size] = tone
    fine = Noise(190, 190, 72)

    def pixel(x, y):
        value = 0.66 + 0.5 * ground[y][x] + 0.02 * fine.at((x + 0.5) / size, (y + 0.5) / size)
        return value, value * 0.985, value * 0.95

    write_png(folder / "terrazzo.png", size, size, pixel, 3)


def prints(folder):
    """Two prints on the walls: fields of colour."""
    for number, (seed, colours) in enumerate(
            ((51, ((0.10, 0.20, 0.32), (0.85, 0.80, 0.70), (0.75, 0.38, 0.22))),
             (52, ((0.80, 0.74, 0.62), (0.20, 0.36, 0.34), (0.88, 0.66, 0.30)))), 1):
        bend, rough = Noise(4, 3, seed), Noise(48, 48, seed + 10)

        def pixel(x, y, bend=bend, rough=rough, colours=colours):
            u, v = (x + 0.5) / 330, (y + 0.5) / 230
            if min(u * 33, v * 23, (1 - u) * 33, (1 - v) * 23) < 3:
                return (0.93, 0.92, 0.89)
            field = v + 0.22 * bend.at(u, v)
            base = colours[0] if field < 0.42 else colours[1] if field < 0.62 else colours[2]
            return tuple(c + 0.02 * rough.at(u, v) for c in base)
        write_png(folder / f"print{number}.png", 330, 230, pixel, 3)


def upholstery(folder):
    """A woven fabric in two shades, plain weave with slubs: 0.25 m by 0.25 m."""
    size, threads = 256, 64
    slub, tone = Noise(64, 16, 81), Noise(6, 6, 82)
    dark, light = (0.11, 0.27, 0.31), (0.33, 0.54, 0.57)

    def pixel(x, y):
        u, v = (x + 0.5) / size, (y + 0.5) / size
        i, j = int(u * threads), int(v * threads)
        warp = (i + j) % 2 == 0
        a, b = u * threads % 1, v * threads % 1
        across = a if warp else b
        round_ = 1 - (2 * across - 1) ** 2
        fleck = slub.at(u, v) if warp else slub.at(v, u)
        return mixed(dark, light, 0.16 + 0.4 * round_ + 0.22 * fleck + 0.10 * tone.at(u, v)
                     + (0.06 if warp else 0))

    write_png(folder / "upholstery.png", size, size, pixel, 3)
