#!/usr/bin/python3
"""placement_scenes.py SCENE: prints the scenes for the figures of docs/performance/placement.md.
SCENE is one of

    tower STOREYS           storeys between slabs, no light from one to the next
    tower-with-stair STOREYS
                            with an opening of 2 m by 4 m in each slab
    five-types FAILURE      the office floor of this source tree without luminaires, five types;
                            FAILURE is a value of 'failure' in [design], such as two or full
    whole-floor FAILURE     the same with its rooms as open areas, places further apart
    corridor CANDIDATES     a corridor in smoke with three luminaires and 0, 33 or 110 candidates
"""
import pathlib
import sys

LIBRARY = pathlib.Path(__file__).resolve().parents[2] / "scenes" / "library"
STOREY_M, WIDE_M, DEEP_M, SLAB_M, WALL_M = 3.2, 24, 12, 0.2, 0.2


def box(name, low, high):
    return (f'[[object]]\nname = "{name}"\nshape = "box"\nlow = {low}\nhigh = {high}\n'
            'material = "white50"\n\n')


def slab(number, top, open_stair):
    low, high = round(top - SLAB_M, 3), round(top, 3)
    if not open_stair:
        return box(f"slab {number}", [0, 0, low], [WIDE_M, DEEP_M, high])
    parts = [(0, 0, 9, DEEP_M), (11, 0, WIDE_M, DEEP_M), (9, 0, 11, 7), (9, 11, 11, DEEP_M)]
    return "".join(box(f"slab {number} {k}", [x0, y0, low], [x1, y1, high])
                   for k, (x0, y0, x1, y1) in enumerate(parts))


def storey(number, with_stair):
    floor = round(number * STOREY_M, 3)
    ceiling = round((number + 1) * STOREY_M - SLAB_M, 3)
    below = round(floor - SLAB_M, 3)
    walls = [("west", [-WALL_M, -WALL_M, below], [0, DEEP_M + WALL_M, ceiling]),
             ("east", [WIDE_M, -WALL_M, below], [WIDE_M + WALL_M, DEEP_M + WALL_M, ceiling]),
             ("south", [0, -WALL_M, below], [WIDE_M, 0, ceiling]),
             ("north", [0, DEEP_M, below], [WIDE_M, DEEP_M + WALL_M, ceiling]),
             ("core", [8, 4, floor], [16, 6 if with_stair else 8, ceiling])]
    out = "".join(box(f"{name} {number}", low, high) for name, low, high in walls)
    path = [[x, y, floor] for x, y in ((2, 2), (18, 2), (22, 2), (22, 10))]
    out += f'[[route]]\nname = "route {number}"\npath = {path}\nwidth = 1.6\n\n'
    outline = [[1, 4.5], [7.5, 4.5], [7.5, 11.5], [1, 11.5]]
    return out + (f'[[open_area]]\nname = "area {number}"\noutline = {outline}\n'
                  f'z = {floor}\n\n')


def tower(storeys, with_stair=False):
    out = 'title = "A tower"\n\n'
    for number in range(storeys + 1):
        out += slab(number, number * STOREY_M, with_stair and 0 < number < storeys)
    out += "".join(storey(number, with_stair) for number in range(storeys))
    return out + ('[assessment]\nrules = ["en1838-2024"]\n\n'
                  '[design]\nspacing_m = 1.5\nfailure = "none"\nplace_signs = false\n')


def five_types(failure):
    """The luminaire of the corridors dimmed to five fluxes, each with its price."""
    out = f'''include = ["{LIBRARY / "office_floor.toml"}"]
[design]
place_signs = false
existing = "removed"
spacing_m = 1.6
objective = "cost"
failure = "{failure}"
over = ["corridor, west", "corridor, east", "side corridor", "open plan"]
'''
    prices = {0.5: 130, 0.75: 145, 1: 160, 1.5: 190, 2: 220}
    for number, (factor, cost) in enumerate(prices.items(), 1):
        out += f'''[[design.type]]
name = "type {number}"
file = "{LIBRARY / "luminaires" / "emergency_corridor.ldt"}"
emergency = "non-maintained"
emergency_factor = {factor}
maintenance_factor = 0.8
emergency_flux_is = "initial"
end_of_duration_factor = 0.8
cost = {cost}
turns_deg = [0]
'''
    return out


ROOMS = {  # of the office floor, between their walls [m]
    "meeting room": (14.1, 0.1, 19.4, 6.9), "archive": (24.1, 0.1, 29.9, 4.8),
    "office 1": (0.1, 9.2, 4.9, 15.9), "office 2": (5.1, 9.2, 9.9, 15.9),
    "office 3": (10.1, 9.2, 13.9, 15.9),
    "print room": (16.1, 9.2, 20.9, 15.9), "training room": (21.1, 11.2, 29.9, 15.9)}


def whole_floor(failure):
    """The office floor, with all rooms as areas to illuminate."""
    out = five_types(failure).replace("spacing_m = 1.6", "spacing_m = 2.3")
    names = ", ".join(f'"{name}"' for name in ROOMS)
    out = out.replace('"open plan"]', f'"open plan", {names}]')
    for name, (x0, y0, x1, y1) in ROOMS.items():
        outline = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
        out += f'[[open_area]]\nname = "{name}"\noutline = {outline}\n'
    return out


def luminaire(name, x, y):
    return f'''[[emitter]]
name = "{name}"
shape = "disc"
diameter = 0.1
position = [{round(x, 2)}, {y}, 2.97]
flux_lm = 200
emergency = "non-maintained"
emergency_flux = 200
maintenance_factor = 0.8
emergency_flux_is = "initial"
end_of_duration_factor = 0.7
'''


def candidates(count):
    if count == 0:
        return []
    if count == 33:
        return [(1 + 1.4 * i, y) for i in range(11) for y in (-1, 0.1, 1)]
    if count == 110:
        return [(0.7 + 0.67 * i, y) for i in range(22) for y in (-1.3, -0.7, 0.1, 0.7, 1.3)]
    sys.exit("a corridor has 0, 33 or 110 candidates")


def corridor(count):
    out = '''[[object]]
name = "corridor"
shape = "room"
low = [0, -2, 0]
high = [16, 2, 3]
material = "grey50"
[[medium]]
name = "smoke"
kind = "homogeneous"
extinction = 0.4
albedo = 0.6
[run]
groups = "emitter"
[[sign]]
name = "exit"
position = [15.95, 0, 2.2]
facing = [-1, 0, 0]
width = 0.4
height = 0.2
text = "EXIT"
letter_height = 0.15
mains_white = 500
mains_green = 50
emergency_white = 100
emergency_green = 10
lighting = "internal"
[[observer]]
name = "mid"
eye = [9, 0, 1.65]
target = [15.9, 0, 2.2]
[[scenario]]
name = "fire"
operation = "emergency"
'''
    out += "".join(luminaire(f"there {i}", x, 0) for i, x in enumerate((3, 8, 13)))
    return out + "".join(luminaire(f"candidate {i}", x, y)
                         for i, (x, y) in enumerate(candidates(count)))


def number_of(text):
    if not text.isascii() or not text.isdigit() or int(text) > 1000:
        sys.exit(f'"{text}" must be a whole number up to 1000')
    return int(text)


def main(scene, value):
    if scene == "tower":
        return tower(number_of(value))
    if scene == "tower-with-stair":
        return tower(number_of(value), with_stair=True)
    if scene == "five-types":
        return five_types(value)
    if scene == "whole-floor":
        return whole_floor(value)
    if scene == "corridor":
        return corridor(number_of(value))
    sys.exit(__doc__)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    print(main(*sys.argv[1:]), end="")
