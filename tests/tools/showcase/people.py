"""Figures of people, without faces and folds, as architects put them into drawings."""

from showcase.mesh import Mesh


def person(folder):
    """A standing person, 1.75 m, who looks along +x; one foot before the other."""
    mesh = Mesh()
    mesh.lathe("skin", (0.0, 0, 1.62), [(0, -0.11), (0.05, -0.10), (0.072, -0.05), (0.082, 0.0),
                                        (0.076, 0.05), (0.05, 0.1), (0, 0.118)], 24, "z",
               (1.12, 0.92))
    mesh.lathe("hair", (-0.012, 0, 1.635), [(0.088, -0.03), (0.09, 0.02), (0.082, 0.06),
                                            (0.055, 0.1), (0, 0.122)], 24, "z", (1.1, 0.95))
    mesh.limb("skin", (-0.005, 0, 1.44), (0, 0, 1.54), 0.052, 0.05)
    mesh.lathe("jacket", (0, 0, 0.92),
               [(0, -0.02), (0.155, -0.01), (0.165, 0.05), (0.15, 0.2), (0.155, 0.3), (0.185, 0.42),
                (0.19, 0.47), (0.15, 0.525), (0.07, 0.56), (0, 0.57)], 28, "z", (0.66, 1.12))
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
