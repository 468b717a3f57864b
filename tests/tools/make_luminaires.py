#!/usr/bin/env python3
"""Writes the sample luminaires of scenes/library/luminaires from analytic intensity functions.

    python3 tests/tools/make_luminaires.py [folder]

Each luminaire is a function of C and gamma, sampled at the file's angles and scaled so that the
integral of the table, bilinear between its angles, gives the stated flux; LORL is then computed
from the rounded values that the file holds. The same run writes the same bytes.
"""

import math
import pathlib
import sys

INTENSITY_DIGITS = 3  # decimals of an intensity; the peak is some hundred cd, so 1e-5 of it


def steps(first, last, step):
    return [first + i * step for i in range(round((last - first) / step) + 1)]


def cell_moments(start, width):
    """Integrals over [start, start + width] of sin(x) and of (x - start) sin(x)."""
    end = start + width
    even = math.cos(start) - math.cos(end)
    sloped = math.sin(end) - math.sin(start) - width * math.cos(end)
    return even, sloped


def flux(azimuths, gammas, columns, below_horizon=False):
    """Exact integral over the listed azimuths of a table that is bilinear in both angles [lm]."""
    total = 0.0
    for a in range(len(azimuths) - 1):
        dphi = math.radians(azimuths[a + 1] - azimuths[a])
        for p in range(len(gammas) - 1):
            if below_horizon and gammas[p] >= 90:
                continue
            width = math.radians(gammas[p + 1] - gammas[p])
            even, sloped = cell_moments(math.radians(gammas[p]), width)
            m0 = 0.5 * (columns[a][p] + columns[a + 1][p])
            m1 = 0.5 * (columns[a][p + 1] + columns[a + 1][p + 1])
            total += dphi * (m0 * even + (m1 - m0) / width * sloped)
    return total


def smooth_step(x, edge, width):
    """1 well below the edge, 0 well above it."""
    return 1.0 / (1.0 + math.exp((x - edge) / width))


# ---- intensity functions: relative, of C and gamma in degrees ------------------------------------


def wide_beam(c, gamma):
    """Uniform light on the floor to 60 degrees (1/cos^3), then off; a faint tail to the horizon."""
    if gamma >= 90:
        return 0.0
    g = min(gamma, 68.0)
    floor = 1.0 / math.cos(math.radians(g)) ** 3
    return floor * smooth_step(gamma, 60.0, 2.0) + 0.05 * math.cos(math.radians(gamma))


def along_corridor(c, gamma):
    """A strip of uniform light, 2.4 mounting heights to both sides along C0-C180, 0.6 across it."""
    if gamma >= 85:
        return 0.0
    tangent = math.tan(math.radians(gamma))
    x = abs(tangent * math.cos(math.radians(c)))
    y = abs(tangent * math.sin(math.radians(c)))
    strip = smooth_step(x, 2.4, 0.12) * smooth_step(y, 0.6, 0.08)
    floor = 1.0 / max(math.cos(math.radians(gamma)), 0.3) ** 3
    return floor * strip + 0.04 * math.cos(math.radians(gamma))


def panel(c, gamma):
    """A flat diffuser with prisms: somewhat narrower than cosine, slightly wider across C90-C270."""
    if gamma >= 90:
        return 0.0
    power = 1.35 - 0.1 * math.sin(math.radians(c)) ** 2
    return math.cos(math.radians(gamma)) ** power


def downlight(c, gamma):
    """A reflector of 40 degrees half-value angle, cut off at 70 degrees."""
    return math.exp(-math.log(2.0) * (gamma / 40.0) ** 2) * smooth_step(gamma, 70.0, 3.0)


def opal(c, gamma):
    """An opal dish under a ceiling: its cosine below, the light of its rim above the horizon."""
    cosine = math.cos(math.radians(gamma))
    rim = 0.22 * math.sin(math.radians(gamma)) ** 2 * smooth_step(gamma, 110.0, 6.0)
    return max(cosine, 0.0) + rim


def spot(c, gamma):
    """A lens of 7 degrees half-value angle with a dim field to 20 degrees."""
    return math.exp(-math.log(2.0) * (gamma / 7.0) ** 2) + 0.004 * smooth_step(gamma, 20.0, 1.5)


def wall_light(c, gamma):
    """On a wall at its back (C180): emits down and forward to C0, nothing backwards."""
    g = math.radians(gamma)
    forward = math.sin(g) * math.cos(math.radians(c))
    down = math.cos(g)
    lobe = 0.8 * max(forward, 0.0) + 0.6 * max(down, 0.0)
    behind = smooth_step(-forward, 0.15, 0.06)
    return lobe * behind * smooth_step(gamma, 100.0, 5.0)


# ---- writers -------------------------------------------------------------------------------------


def listed_planes(symmetry, planes):
    """The planes an EULUMDAT file of this symmetry lists, and the share of the circle they span."""
    listed = {1: [0.0], 2: [c for c in planes if c <= 180], 4: [c for c in planes if c <= 90]}
    return listed[symmetry]


def write_ldt(folder, name, *, title, number, symmetry, kind, c_step, gammas, gamma_step, function,
              luminaire_flux, light_output_ratio, absolute, watts, colour, rendering, housing,
              opening):
    planes = [0.0] if symmetry == 1 else steps(0.0, 360.0 - c_step, c_step)
    listed = listed_planes(symmetry, planes)
    span, images = (([0.0, 360.0], 1) if symmetry == 1 else (listed, 360.0 / listed[-1]))

    def integral(table, below=False):
        columns = [table[0], table[0]] if symmetry == 1 else table
        return images * flux(span, gammas, columns, below)

    raw = [[function(c, g) for g in gammas] for c in listed]
    scale = 1000.0 * light_output_ratio / integral(raw)  # cd/klm of the lamps
    table = [[round(scale * value, INTENSITY_DIGITS) for value in column] for column in raw]
    lorl = 100.0 * integral(table) / 1000.0
    down = 100.0 * integral(table, True) / integral(table)
    lamp_flux = luminaire_flux / light_output_ratio

    lines = ["Luxodus sample", kind, symmetry, len(planes), c_step if symmetry != 1 else 0,
             len(gammas), gamma_step, "analytic", title, number, name + ".ldt",
             "make_luminaires.py"]
    lines += list(housing) + list(opening)
    lines += [f"{down:.2f}", f"{lorl:.4f}", "1.0", "0.0"]
    lines += [1, -1 if absolute else 1, "LED", f"{lamp_flux:.2f}", colour, rendering, watts]
    lines += ["0.0"] * 10  # utilances: not used
    lines += [f"{c:g}" for c in planes] + [f"{g:g}" for g in gammas]
    lines += [f"{value:.{INTENSITY_DIGITS}f}" for column in table for value in column]
    text = "".join(f"{line}\r\n" for line in lines)
    (folder / (name + ".ldt")).write_bytes(text.encode("latin-1"))
    print(f"{name}.ldt: {lamp_flux * lorl / 100:.3f} lm, LORL {lorl:.4f} %, peak "
          f"{max(map(max, table)) * lamp_flux / 1000:.1f} cd")


def wrapped(values, width=12):
    return [" ".join(values[i:i + width]) for i in range(0, len(values), width)]


def write_ies(folder, name, *, title, number, horizontals, verticals, function, luminaire_flux,
              watts, colour, width, length, height):
    images = 360.0 / horizontals[-1]
    raw = [[function(c, g) for g in verticals] for c in horizontals]
    scale = luminaire_flux / (images * flux(horizontals, verticals, raw))
    table = [[round(scale * value, 4) for value in column] for column in raw]
    total = images * flux(horizontals, verticals, table)
    lines = ["IESNA:LM-63-2002", "[TEST] analytic", "[TESTLAB] make_luminaires.py",
             "[ISSUEDATE] 2024-01-01", "[MANUFAC] Luxodus sample", f"[LUMCAT] {number}",
             f"[LUMINAIRE] {title}",
             f"[LAMP] LED {colour}", f"[OTHER] luminaire flux {total:.2f} lm",
             "[MORE] absolute photometry", "TILT=NONE",
             f"1 -1 1.0 {len(verticals)} {len(horizontals)} 1 2 {width:g} {length:g} {height:g}",
             f"1.0 1 {watts:g}"]
    lines += wrapped([f"{v:g}" for v in verticals]) + wrapped([f"{h:g}" for h in horizontals])
    for column in table:
        lines += wrapped([f"{value:.4f}" for value in column])
    text = "".join(f"{line}\r\n" for line in lines)
    (folder / (name + ".ies")).write_bytes(text.encode("ascii"))
    print(f"{name}.ies: {total:.3f} lm, peak {max(map(max, table)):.1f} cd")


def main():
    here = pathlib.Path(__file__).resolve().parent.parent.parent
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else here / "scenes/library/luminaires"
    fine, coarse = steps(0.0, 180.0, 2.5), steps(0.0, 180.0, 5.0)
    write_ldt(folder, "emergency_downlight", title="Emergency downlight, wide beam",
              number="LX-ED200", symmetry=1, kind=1, c_step=0.0, gammas=fine, gamma_step="2.5",
              function=wide_beam,
              luminaire_flux=200.0, light_output_ratio=1.0, absolute=True, watts="2.5",
              colour="5000 K", rendering="70", housing=(85, 0, 40), opening=(30, 0, 0, 0, 0, 0))
    write_ldt(folder, "emergency_corridor", title="Emergency corridor light, long throw",
              number="LX-EC180", symmetry=4, kind=3, c_step=5.0, gammas=fine, gamma_step="2.5",
              function=along_corridor, luminaire_flux=180.0, light_output_ratio=0.9, absolute=False,
              watts="2.5", colour="5000 K", rendering="70", housing=(85, 0, 40),
              opening=(30, 0, 0, 0, 0, 0))
    write_ldt(folder, "office_panel", title="Office panel 600 x 600", number="LX-OP4000",
              symmetry=4, kind=2, c_step=15.0, gammas=coarse, gamma_step="5.0", function=panel,
              luminaire_flux=4000.0, light_output_ratio=1.0, absolute=True, watts="32",
              colour="4000 K", rendering="80", housing=(597, 597, 30),
              opening=(570, 570, 0, 0, 0, 0))
    write_ldt(folder, "corridor_downlight", title="Corridor downlight", number="LX-CD1500",
              symmetry=1, kind=1, c_step=0.0, gammas=fine, gamma_step="2.5", function=downlight,
              luminaire_flux=1500.0, light_output_ratio=0.85, absolute=False, watts="15",
              colour="4000 K", rendering="80", housing=(200, 0, 90), opening=(160, 0, 0, 0, 0, 0))
    write_ldt(folder, "bulkhead", title="Opal bulkhead", number="LX-BH250", symmetry=1, kind=1,
              c_step=0.0, gammas=coarse, gamma_step="5.0", function=opal, luminaire_flux=250.0,
              light_output_ratio=0.62, absolute=False, watts="5", colour="4000 K", rendering="80",
              housing=(260, 0, 90), opening=(230, 0, 60, 60, 60, 60))
    # Unequal gamma steps (Dg = 0): fine in the beam, coarse outside it.
    beam = steps(0.0, 20.0, 0.5) + steps(21.0, 30.0, 1.0) + steps(35.0, 90.0, 5.0) + [180.0]
    write_ldt(folder, "stage_spot", title="Stage spot", number="LX-SP6000", symmetry=1, kind=1,
              c_step=0.0, gammas=beam, gamma_step="0", function=spot, luminaire_flux=6000.0,
              light_output_ratio=0.7, absolute=False, watts="150", colour="3200 K", rendering="95",
              housing=(180, 0, 320), opening=(120, 0, 0, 0, 0, 0))
    write_ies(folder, "wall_bulkhead", title="Wall bulkhead", number="LX-WB400",
              horizontals=steps(0.0, 180.0, 15.0), verticals=coarse, function=wall_light,
              luminaire_flux=400.0, watts=6.0, colour="3000K", width=0.24, length=0.12, height=0.0)


if __name__ == "__main__":
    main()
