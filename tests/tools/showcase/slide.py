"""The slide on the screen of the auditorium: a title, a formula and a diagram."""

import math

from showcase.textures import write_png

WIDTH, HEIGHT = 800, 450
# Letters as lines between places of a grid, 4 wide and 6 high, from below left.
LETTERS = {
    "L": ["06 00 40"], "I": ["00 06"], "H": ["00 06", "40 46", "03 43"], "T": ["06 46", "26 20"],
    "G": ["45 36 16 05 01 10 30 41 43 23"], "N": ["00 06 40 46"], "M": ["00 06 22 46 40"],
    "S": ["45 36 16 05 04 13 33 42 41 30 10 01"], "O": ["01 05 16 36 45 41 30 10 01"],
    "K": ["00 06", "46 02", "13 40"], "E": ["46 06 00 40", "03 33"], "X": ["00 46", "06 40"],
    "P": ["00 06 36 45 44 33 03"], "D": ["00 06 26 44 42 20 00"], "(": ["26 14 12 20"],
    ")": ["06 14 12 00"], "=": ["02 42", "04 44"], "-": ["03 33"]}
NARROW = {"I": 1, "(": 3, ")": 3}


class Sheet:
    """Colours of 0 to 1, drawn over each other; lines have soft edges."""

    def __init__(self, ground):
        self.rows = [[ground] * WIDTH for _ in range(HEIGHT)]

    def put(self, x, y, colour, share):
        old = self.rows[y][x]
        self.rows[y][x] = tuple(o + (c - o) * share for o, c in zip(old, colour))

    def fill(self, x0, y0, x1, y1, colour):
        for y in range(y0, y1):
            self.rows[y][x0:x1] = [colour] * (x1 - x0)

    def lines(self, places, thick, colour):
        """Lines from place to place, as one stroke: where they overlap they are drawn once."""
        shares = {}
        for (ax, ay), (bx, by) in zip(places, places[1:]):
            length = max(1e-9, math.hypot(bx - ax, by - ay))
            reach = thick / 2 + 1
            for y in range(max(0, int(min(ay, by) - reach)),
                           min(HEIGHT, int(max(ay, by) + reach) + 1)):
                for x in range(max(0, int(min(ax, bx) - reach)),
                               min(WIDTH, int(max(ax, bx) + reach) + 1)):
                    t = ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length ** 2
                    t = max(0.0, min(1.0, t))
                    away = math.hypot(x - ax - t * (bx - ax), y - ay - t * (by - ay))
                    share = max(0.0, min(1.0, thick / 2 + 0.5 - away))
                    if share > shares.get((x, y), 0):
                        shares[x, y] = share
        for (x, y), share in shares.items():
            self.put(x, y, colour, share)

    def text(self, words, x, y, size, thick, colour):
        """Words from x on above the line y; letters are `size` high."""
        unit = size / 6
        for letter in words:
            for stroke in LETTERS.get(letter, []):
                self.lines([(x + int(p[0]) * unit, y - int(p[1]) * unit) for p in stroke.split()],
                           thick, colour)
            x += (NARROW.get(letter, 4) + 1.6) * unit


def slide(folder):
    ink, grey, pale = (0.13, 0.20, 0.30), (0.45, 0.50, 0.56), (0.80, 0.83, 0.86)
    sheet = Sheet((0.97, 0.97, 0.96))
    sheet.fill(0, 0, WIDTH, 84, (0.10, 0.33, 0.38))
    sheet.fill(0, 84, WIDTH, 90, (0.90, 0.62, 0.22))
    sheet.text("LIGHT IN SMOKE", 48, 60, 36, 5.5, (0.97, 0.97, 0.96))
    sheet.text("T = EXP(-K D)", 48, 180, 26, 3.6, ink)
    for k, wide in enumerate((205, 240, 180)):  # lines of text that are too small to be read
        y = 240 + 50 * k
        sheet.fill(48, y, 58, y + 10, (0.90, 0.62, 0.22))
        sheet.fill(74, y, 74 + wide, y + 9, pale)
        sheet.fill(74, y + 16, 74 + wide - 45, y + 25, pale)
    left, low, wide, high = 430, 385, 320, 240
    for k in range(1, 5):
        y = low - high * k / 4
        sheet.lines([(left, y), (left + wide, y)], 1.2, pale)
    for extinction, colour in ((1, (0.10, 0.50, 0.46)), (2.5, (0.90, 0.55, 0.15)),
                               (7, (0.72, 0.22, 0.20))):
        sheet.lines([(left + wide * i / 60, low - high * math.exp(-extinction * i / 60))
                     for i in range(61)], 4, colour)
    sheet.lines([(left, low - high - 12), (left, low), (left + wide + 12, low)], 2.5, grey)
    sheet.text("T", left - 32, low - high + 16, 18, 2.6, grey)
    sheet.text("D", left + wide - 12, low + 34, 18, 2.6, grey)
    write_png(folder / "slide.png", WIDTH, HEIGHT, lambda x, y: sheet.rows[y][x], 3)
