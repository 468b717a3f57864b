"""Figures of people, without faces and folds, as architects put them into drawings."""

from showcase.mesh import Mesh


def upper_body(mesh, drop, sides):
    """Head, neck and trunk of a person, lower than a standing one's by `drop`."""
    mesh.lathe("skin", (0.0, 0, 1.62 - drop),
               [(0, -0.11), (0.05, -0.10), (0.072, -0.05), (0.082, 0.0), (0.076, 0.05), (0.05, 0.1),
                (0, 0.118)], sides, "z", (1.12, 0.92))
    mesh.lathe("hair", (-0.012, 0, 1.635 - drop),
               [(0.088, -0.03), (0.09, 0.02), (0.082, 0.06), (0.055, 0.1), (0, 0.122)], sides, "z",
               (1.1, 0.95))
    mesh.limb("skin", (-0.005, 0, 1.44 - drop), (0, 0, 1.54 - drop), 0.052, 0.05)
    mesh.lathe("jacket", (0, 0, 0.92 - drop),
               [(0, -0.02), (0.155, -0.01), (0.165, 0.05), (0.15, 0.2), (0.155, 0.3), (0.185, 0.42),
                (0.19, 0.47), (0.15, 0.525), (0.07, 0.56), (0, 0.57)], sides + 4, "z",
               (0.66, 1.12))


def person(folder):
    """A standing person, 1.75 m, who looks along +x; one foot before the other."""
    mesh = Mesh()
    upper_body(mesh, 0, 24)
    for side, step, swing in ((1, 0.16, -0.10), (-1, -0.20, 0.12)):
        hip, knee = (0, side * 0.09, 0.92), (0.5 * step + 0.03, side * 0.095, 0.50)
        ankle = (step, side * 0.1, 0.09)
        mesh.limb("trousers", hip, knee, 0.088, 0.062)
        mesh.limb("trousers", knee, ankle, 0.062, 0.046)
        mesh.limb("shoe", (step - 0.04, side * 0.1, 0.045), (step + 0.15, side * 0.11, 0.035),
                  0.045, 0.035)
        shoulder, elbow = (0, side * 0.2, 1.38), (swing * 0.5 - 0.03, side * 0.245, 1.12)
        wrist = (swing + 0.02, side * 0.24, 0.89)
        mesh.limb("jacket", shoulder, elbow, 0.062, 0.048)
        mesh.limb("jacket", elbow, wrist, 0.046, 0.036)
        mesh.limb("skin", wrist, (swing + 0.045, side * 0.235, 0.80), 0.03, 0.028)
    mesh.write(folder / "person.obj", "A person of 1.75 m.")


def seated_person(folder):
    """The same person on a seat of 0.46 m, the forearms on armrests; the hip is at the origin."""
    mesh = Mesh()
    upper_body(mesh, 0.36, 20)
    for side in (1, -1):
        hip, knee = (0.02, side * 0.09, 0.55), (0.44, side * 0.12, 0.51)
        ankle = (0.41 + 0.06 * side, side * 0.12, 0.09)
        mesh.limb("trousers", hip, knee, 0.088, 0.064, 12)
        mesh.limb("trousers", knee, ankle, 0.062, 0.046, 12)
        mesh.limb("shoe", (ankle[0] - 0.04, side * 0.12, 0.045),
                  (ankle[0] + 0.15, side * 0.13, 0.035), 0.045, 0.035, 12)
        shoulder, elbow = (0, side * 0.2, 1.02), (0.03, side * 0.255, 0.75)
        wrist = (0.26, side * (0.245 if side > 0 else 0.13), 0.70)
        mesh.limb("jacket", shoulder, elbow, 0.062, 0.048, 12)
        mesh.limb("jacket", elbow, wrist, 0.046, 0.036, 12)
        mesh.limb("skin", wrist, (wrist[0] + 0.09, wrist[1] - 0.01, 0.69), 0.03, 0.026, 10)
    mesh.write(folder / "seated_person.obj", "A seated person.", 4)
