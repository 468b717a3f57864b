"""Promises of the Python module: results equal those of the program, errors give file and line, and
a run stops on request."""
import gc
import json
import math
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import types
import unittest
import unittest.mock

try:
    import numpy as np
except ModuleNotFoundError:
    print("left out: NumPy is not installed (Debian: python3-numpy)", file=sys.stderr)
    sys.exit(77)

import luxodus

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("LUXODUS", str(ROOT / "build/release/luxodus"))

ROOM = """
title = "A grey room with one lamp"
[run]
seed = 3
max_bands = 1
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [6, 4, 3]
material = "grey50"
[[emitter]]
name = "lamp"
shape = "point"
distribution = "isotropic"
position = [3, 2, 2.5]
flux_lm = 1000
spectrum = "E"
[[plane]]
name = "desks"
corner = [0.5, 0.5, 0.8]
edge_u = [5, 0, 0]
edge_v = [0, 3, 0]
cell_m = 0.5
[[probe]]
name = "below"
position = [3, 2, 0]
[[medium]]
name = "haze"
kind = "homogeneous"
extinction = 0.05
albedo = 0.5
phase = "isotropic"
[[camera]]
name = "door"
eye = [0.2, 0.2, 1.65]
target = [4, 2.6, 1.2]
width = 32
height = 24
[[scenario]]
name = "haze"
operation = "mains"
[[scenario]]
name = "clear"
operation = "mains"
smoke_factor = 0
"""

class Axes:
    """Axes of matplotlib that note what is drawn."""

    def __init__(self, drawn):
        self.drawn = drawn
        self.figure = types.SimpleNamespace(colorbar=lambda drawn, ax, label: None)

    def pcolormesh(self, *values, **style):
        self.drawn["pcolormesh"] = (values, style)

    def imshow(self, *values, **style):
        self.drawn["imshow"] = (values, style)

    def set(self, **said):
        self.drawn.update(said)


ROUTE = """
[[route]]
name = "out"
path = [[0.5, 2, 0], [5.5, 2, 0]]
width = 1.2
[assessment]
irritant_smoke = false
rules = ["en1838-2024"]
"""



class Module(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def scene_file(self, text=ROOM, name="room.toml"):
        path = self.folder / name
        path.write_text(text)
        return path


class Scenes(Module):
    def test_a_scene_lists_its_names(self):
        scene = luxodus.load(self.scene_file())
        self.assertEqual(scene.name, "room")
        self.assertEqual(scene.title, "A grey room with one lamp")
        self.assertEqual(scene.scenarios, ["haze", "clear"])
        self.assertEqual(scene.planes, ["desks"])
        self.assertEqual(scene.luminaires, ["lamp"])
        self.assertEqual(scene.media, ["haze"])
        self.assertEqual(scene.cameras, ["door"])
        self.assertEqual(scene.signs, [])
        self.assertEqual(scene.file, str(self.folder / "room.toml"))

    def test_a_mistake_is_an_error_with_file_line_and_the_message_of_the_program(self):
        path = self.scene_file(ROOM.replace("flux_lm = 1000", 'flux_lm = "bright"'))
        line = path.read_text().splitlines().index('flux_lm = "bright"') + 1
        with self.assertRaises(luxodus.Error) as caught:
            luxodus.load(path)
        error = caught.exception
        self.assertEqual(error.file, str(path))
        self.assertEqual(error.line, line)
        printed = subprocess.run([PROGRAM, "check", str(path)], capture_output=True, text=True)
        self.assertIn(str(error).splitlines()[0], printed.stderr)
        self.assertEqual(printed.returncode, 2)

    def test_all_mistakes_are_reported_at_once(self):
        text = ROOM.replace("flux_lm = 1000", "flux_lm = -1").replace("cell_m = 0.5", "cell_m = 0")
        with self.assertRaises(luxodus.Error) as caught:
            luxodus.load(self.scene_file(text))
        self.assertEqual(len(caught.exception.problems), 2)
        self.assertEqual(len(str(caught.exception).splitlines()), 2)

    def test_a_missing_file_is_an_error_without_a_line(self):
        with self.assertRaises(luxodus.Error) as caught:
            luxodus.load(self.folder / "none.toml")
        self.assertEqual(caught.exception.file, str(self.folder / "none.toml"))
        self.assertIsNone(caught.exception.line)

    def test_a_change_has_the_effect_of_one_in_a_variant(self):
        path = self.scene_file()
        changes = [{"kind": "luminaire", "of": "lamp", "factor": 2},
                   {"kind": "medium", "of": "haze", "factor": np.float64(0.0)}]
        variant = self.scene_file(
            'include = ["room.toml"]\n[[change]]\nkind = "luminaire"\nof = "lamp"\nfactor = 2\n'
            '[[change]]\nkind = "medium"\nof = "haze"\nfactor = 0.0\n', "variant.toml")
        changed = luxodus.load(path, changes=changes).run("haze", particles=20e3, threads=1)
        written = luxodus.load(variant).run("haze", particles=20e3, threads=1)
        np.testing.assert_array_equal(changed.planes["desks"].illuminance_lx,
                                      written.planes["desks"].illuminance_lx)
        plain = luxodus.load(path).run("clear", particles=20e3, threads=1)
        ratio = changed.planes["desks"].direct_illuminance_lx / \
            plain.planes["desks"].direct_illuminance_lx
        np.testing.assert_allclose(ratio, 2, rtol=1e-6)

    def test_a_wrong_change_names_its_number_as_a_line(self):
        path = self.scene_file()
        with self.assertRaises(luxodus.Error) as caught:
            luxodus.load(path, changes=[{"kind": "medium", "of": "haze", "factor": 2},
                                        {"kind": "medium", "of": "mist", "factor": 2}])
        self.assertEqual((caught.exception.file, caught.exception.line), ("changes", 2))
        self.assertIn('there is no medium "mist"', str(caught.exception))
        for change in [{"kind": "luminaire", "of": "lamp", "position": {"x": 1}}, "lamp"]:
            with self.assertRaises(luxodus.Error) as caught:
                luxodus.load(path, changes=[change])
            self.assertEqual((caught.exception.file, caught.exception.line), ("changes", 1))

    def test_a_name_is_quoted_safely_in_its_change(self):
        path = self.scene_file()
        with self.assertRaises(luxodus.Error) as caught:
            luxodus.load(path, changes=[{"kind": "medium", "of": 'x"}\n[run]\nseed = 9',
                                         "factor": 2}])
        self.assertIn("there is no medium", str(caught.exception))
        with self.assertRaises(luxodus.Error) as caught:
            luxodus.load(path, changes=[{"kind": "luminaire", "of": "lamp", 'a"b': 1}])
        self.assertEqual(caught.exception.line, 1)

    def test_a_pack_gives_the_light_of_its_scene_and_rejects_changes(self):
        path = self.scene_file()
        pack = self.folder / "room.luxpack"
        subprocess.run([PROGRAM, "pack", str(path), "--out", str(pack)], check=True,
                       capture_output=True)
        packed = luxodus.load(pack).run("haze", particles=20e3).planes["desks"]
        written = luxodus.load(path).run("haze", particles=20e3).planes["desks"]
        np.testing.assert_array_equal(packed.illuminance_lx, written.illuminance_lx)
        for asked in ({"changes": [{"kind": "medium", "of": "haze", "factor": 2}]}, {"at_s": 3}):
            with self.assertRaises(luxodus.Error) as caught:
                luxodus.load(pack, **asked)
            self.assertEqual(caught.exception.file, str(pack))

    def test_drawings_of_signs_are_read_in_another_process(self):
        scene = luxodus.load(ROOT / "scenes/library/office_floor.toml")
        self.assertGreater(len(scene.signs), 0)
        self.assertEqual([f for f in scene.check() if f["severity"] == "error"], [])


class Runs(Module):
    def test_results_equal_those_of_the_program_bit_for_bit(self):
        path = self.scene_file()
        out = self.folder / "out"
        subprocess.run([PROGRAM, "run", str(path), "--particles", "50k", "--no-views",
                        "--out", str(out)], check=True, capture_output=True)
        program = json.loads((out / "result.json").read_text())
        run = luxodus.load(path).run("haze", particles=50e3, threads=2)
        self.assertEqual(run.result.keys(), program.keys())
        for key in ("planes", "probes", "surfaces", "ledger", "particles", "state", "scene_hash",
                    "stopped_by", "stop_rule", "media", "scene_file"):
            self.assertEqual(run.result[key], program[key], key)
        self.assertEqual(run.probes, program["probes"])
        table = np.genfromtxt(out / "planes" / "desks.csv", delimiter=",", names=True)
        desks = run.planes["desks"]
        np.testing.assert_array_equal(desks.illuminance_lx.ravel(), table["total_lx"])
        np.testing.assert_array_equal(
            desks.standard_error_lx.ravel(), table["indirect_standard_error_lx"])
        np.testing.assert_array_equal(desks.grid_m[..., 0].ravel(), table["x"])
        np.testing.assert_array_equal(desks.grid_m[..., 1].ravel(), table["y"])

    def test_arrays_have_the_shape_of_their_cells(self):
        run = luxodus.load(self.scene_file()).run("haze", particles=20e3)
        desks = run.planes["desks"]
        self.assertEqual(desks.illuminance_lx.shape, (6, 10))
        self.assertEqual(desks.grid_m.shape, (6, 10, 3))
        self.assertEqual(desks.illuminance_lx.dtype, np.float64)
        self.assertAlmostEqual(float(desks.illuminance_lx.mean()),
                               desks.mean_illuminance["value"], places=6)
        patches = run.patches
        self.assertEqual(patches.incident_front_lx.shape, (len(patches.triangles),))
        self.assertTrue((patches.triangles < len(patches.points_m)).all())
        a, b, c = (patches.points_m[patches.triangles[:, i]] for i in range(3))
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
        incident = sum(s["incident"]["value"] for s in run.surfaces)
        total = float((area * (patches.incident_front_lx + patches.incident_back_lx)).sum())
        self.assertAlmostEqual(total / incident, 1, places=4)
        voxels = run.voxels
        self.assertEqual(voxels.vector_flux_lm_m2.shape, voxels.fluence_lm_m2.shape + (3,))
        self.assertGreater(float(voxels.fluence_lm_m2.mean()), 0)
        self.assertIsNone(luxodus.load(self.scene_file()).run("clear", particles=1e4).voxels)

    def test_the_energy_balance_closes_in_integers(self):
        balance = luxodus.load(self.scene_file()).run("haze", particles=20e3).energy_balance
        self.assertTrue(balance["closes"])
        self.assertEqual(balance["emitted"] + balance["roulette_gain"],
                         balance["absorbed_surfaces"] + balance["absorbed_media"] +
                         balance["escaped"] + balance["roulette_loss"] + balance["lost"])

    def test_nodes_give_the_same_bits_as_threads(self):
        scene = luxodus.load(self.scene_file())
        threads = scene.run("haze", particles=50e3, threads=2).planes["desks"].illuminance_lx
        nodes = scene.run("haze", particles=50e3, nodes=2).planes["desks"].illuminance_lx
        np.testing.assert_array_equal(threads, nodes)

    def test_particles_are_allocated_adaptively(self):
        lamp = ROOM[ROOM.index("[[emitter]]"):ROOM.index("[[plane]]")]
        second = lamp.replace('"lamp"', '"second"').replace("[3, 2, 2.5]", "[5.9, 3.9, 2.9]")
        text = ROOM.replace("seed = 3", 'seed = 3\ngroups = "emitter"').replace(lamp, lamp + second)
        run = luxodus.load(self.scene_file(text)).run("haze", particles=50e3, adaptive=True,
                                                      error_of=["plane desks"])
        shares = [group["batch_share"] for group in run.source_groups]
        self.assertEqual(len(shares), 2)
        self.assertAlmostEqual(sum(shares), 1)
        self.assertEqual(run.error_of, ["plane desks"])

    def test_a_continued_run_equals_a_longer_one_bit_for_bit(self):
        scene = luxodus.load(self.scene_file())
        run = scene.run("haze", particles=20e3)
        first = run.planes["desks"].illuminance_lx.copy()
        run.go_on(particles=60e3)
        whole = scene.run("haze", particles=60e3)
        self.assertEqual(run.particles, whole.particles)
        np.testing.assert_array_equal(run.planes["desks"].illuminance_lx,
                                      whole.planes["desks"].illuminance_lx)
        self.assertFalse(np.array_equal(first, run.planes["desks"].illuminance_lx))

    def test_arguments_are_checked(self):
        scene = luxodus.load(self.scene_file())
        for wrong in ({"particles": 0}, {"particles": 1.5}, {"particles": math.nan},
                      {"error": 0}, {"error": 2}, {"time_s": -1}, {"threads": 0},
                      {"cells": 0}, {"nodes": 1000}, {"scenario": "fire"},
                      {"error_of": ["plane none"]}, {"particles": 1e3, "adaptive": True}):
            with self.assertRaises(luxodus.Error, msg=str(wrong)):
                scene.run(**{"scenario": "haze", **wrong})

    def test_a_picture_is_an_array_of_luminance(self):
        run = luxodus.load(self.scene_file()).run("haze", particles=50e3)
        view = run.render("door", paths=8)
        self.assertEqual(view.luminance_cd_m2.shape, (24, 32))
        self.assertEqual(view.xyz_cd_m2.shape, (24, 32, 3))
        np.testing.assert_array_equal(view.xyz_cd_m2[..., 1], view.luminance_cd_m2)
        self.assertGreater(float(view.filtered_luminance_cd_m2.mean()), 0)
        with self.assertRaises(luxodus.Error):
            run.render("window")

    def test_one_of_several_scenarios_must_be_named(self):
        with self.assertRaises(luxodus.Error) as caught:
            luxodus.load(self.scene_file()).run(particles=1e3)
        self.assertIn('name one of its scenarios: "haze", "clear"', str(caught.exception))

    def test_an_unknown_plane_is_answered_by_the_names_of_planes(self):
        planes = luxodus.load(self.scene_file()).run("haze", particles=1e3).planes
        with self.assertRaises(KeyError) as caught:
            planes["floor"]
        self.assertEqual(caught.exception.args[0],
                         "there is no plane 'floor'; there are: 'desks'")
        self.assertNotIn("floor", planes)

    def test_results_are_shown_in_short_and_as_a_table(self):
        run = luxodus.load(self.scene_file()).run("haze", particles=1e3)
        desks = run.planes["desks"]
        mean = desks.mean_illuminance["value"]
        self.assertEqual(repr(desks),
                         f"<luxodus.Plane 'desks': 10 x 6 cells, {mean:.4g} lx on average>")
        self.assertIn("incident_front_lx", repr(run.patches))
        table = desks._repr_html_()
        self.assertIn("<th>illuminance_lx</th><td>[6, 10], ", table)
        self.assertEqual(repr(run.render("door", paths=4)),
                         "<luxodus.View 'door': 32 x 24 pixels, 4 paths each>")

    def test_planes_and_views_are_plotted_where_matplotlib_is(self):
        run = luxodus.load(self.scene_file()).run("haze", particles=1e4)
        drawn = {}
        matplotlib = types.ModuleType("matplotlib")
        matplotlib.colors = types.SimpleNamespace(LogNorm=lambda: "log")
        axes = Axes(drawn)
        matplotlib.pyplot = types.SimpleNamespace(subplots=lambda: (None, axes))
        fakes = {"matplotlib": matplotlib, "matplotlib.colors": matplotlib.colors,
                 "matplotlib.pyplot": matplotlib.pyplot}
        with unittest.mock.patch.dict(sys.modules, fakes):
            desks = run.planes["desks"]
            self.assertIs(desks.plot(), axes)
            x, y, shown = drawn["pcolormesh"][0]
            np.testing.assert_array_equal(shown, desks.illuminance_lx)
            np.testing.assert_allclose((x[0, 0], x[-1, -1], y[0, 0], y[-1, -1]),
                                       (0.5, 5.5, 0.5, 3.5))
            self.assertEqual(drawn["title"], "desks")
            view = run.render("door", paths=4)
            view.plot(cmap="gray")
            np.testing.assert_array_equal(drawn["imshow"][0][0], view.filtered_luminance_cd_m2)
            self.assertEqual(drawn["imshow"][1], {"cmap": "gray", "norm": "log"})
        with unittest.mock.patch.dict(sys.modules, {"matplotlib": None}):
            with self.assertRaises(ImportError) as caught:
                desks.plot()
            self.assertIn("python3-matplotlib", str(caught.exception))

    def test_lines_and_upright_planes_are_plotted_with_their_size(self):
        more = """
[[plane]]
name = "line"
corner = [1, 2, 0.8]
edge_u = [2, 0, 0]
edge_v = [0, 0.25, 0]
cell_m = 0.5
[[plane]]
name = "wall"
corner = [0.1, 0.5, 0.5]
edge_u = [0, 3, 0]
edge_v = [0, 0, 2]
cell_m = 0.5
"""
        planes = luxodus.load(self.scene_file(ROOM + more)).run("haze", particles=1e3).planes
        sizes = {}
        for name in ("line", "wall"):
            x, y, across, _ = planes[name]._corners()
            sizes[name] = (np.ptp(x), np.ptp(y), across)
        np.testing.assert_allclose(sizes["line"][:2], (2, 0.25))
        np.testing.assert_allclose(sizes["wall"][:2], (3, 2))
        self.assertEqual(sizes["line"][2], "x [m]")
        self.assertEqual(sizes["wall"][2], "along the first edge [m]")

    def test_results_outlive_their_scene_and_run(self):
        desks = luxodus.load(self.scene_file()).run("haze", particles=20e3).planes["desks"]
        gc.collect()
        self.assertGreater(float(desks.illuminance_lx.min()), 0)

    def test_an_unknown_attribute_is_an_attribute_error(self):
        run = luxodus.load(self.scene_file()).run("haze", particles=1e4)
        self.assertFalse(hasattr(run, "illumination"))
        self.assertIn("worst_relative_error", dir(run))


class Progress(Module):
    def test_progress_is_reported_on_the_calling_thread(self):
        told = []
        luxodus.load(self.scene_file()).run(
            "haze",
            particles=50e3, progress=lambda p: told.append((threading.get_ident(), p.particles)))
        self.assertTrue(told)
        self.assertEqual({ident for ident, _ in told}, {threading.get_ident()})
        self.assertGreaterEqual(told[-1][1], 50e3)

    def test_other_threads_continue_during_a_run(self):
        counted = []
        done = threading.Event()

        def count():
            while not done.is_set():
                counted.append(1)
                done.wait(0.001)

        other = threading.Thread(target=count)
        seen = []
        other.start()
        luxodus.load(self.scene_file()).run(
            "haze",
            time_s=0.3, progress=lambda p: seen.append(len(counted)))
        done.set()
        other.join()
        self.assertGreater(seen[-1], seen[0] if len(seen) > 1 else 0)

    def test_a_callable_that_returns_false_stops_a_run_and_keeps_its_results(self):
        run = luxodus.load(self.scene_file()).run("haze", particles=1e15, progress=lambda p: False)
        self.assertEqual(run.stopped_by, "interrupted")
        self.assertGreater(run.particles, 0)
        self.assertTrue(run.energy_balance["closes"])

    def test_an_exception_of_the_callable_stops_the_run_and_is_raised(self):
        def refuse(progress):
            raise KeyError("enough")

        before = threading.active_count()
        scene = luxodus.load(self.scene_file())
        with self.assertRaisesRegex(KeyError, "enough"):
            scene.run("haze", particles=1e15, progress=refuse)
        with self.assertRaisesRegex(KeyError, "enough"):
            scene.run("haze", particles=1e15, nodes=2, progress=refuse)
        self.assertEqual(threading.active_count(), before)
        self.assertGreater(scene.run("haze", particles=1e4).particles, 0)

    def test_ctrl_c_stops_a_run(self):
        def interrupt(progress):
            os.kill(os.getpid(), signal.SIGINT)

        with self.assertRaises(KeyboardInterrupt):
            luxodus.load(self.scene_file()).run("haze", particles=1e15, progress=interrupt)

    def test_another_thread_cannot_read_a_run_while_it_traces(self):
        run = luxodus.load(self.scene_file()).run("haze", particles=1e4)
        refused = []

        def read():
            try:
                run.patches
            except luxodus.Error as error:
                refused.append(str(error))

        def read_beside(progress):
            other = threading.Thread(target=read)
            other.start()
            other.join()
            return False

        run.go_on(particles=1e15, progress=read_beside)
        self.assertIn("another thread", refused[0])


class Assessments(Module):
    def test_an_assessment_equals_that_of_the_program(self):
        path = ROOT / "scenes/library/office_floor.toml"
        out = self.folder / "assessed"
        subprocess.run([PROGRAM, "assess", str(path), "--codes-alone", "--out", str(out)],
                       check=True, capture_output=True)
        program = json.loads((out / "assessment.json").read_text())
        told = []
        made = luxodus.load(path).assess(codes_alone=True,
                                         progress=lambda p: told.append((p.what, p.share)))
        self.assertEqual(made.result.keys(), program.keys())
        for key in ("checks", "signs", "luminaires", "verdict", "counts", "state"):
            self.assertEqual(made.result[key], program[key], key)
        self.assertEqual(made.checks, program["checks"])
        self.assertTrue(told)
        self.assertFalse(hasattr(made, "nothing"))

    def test_a_scene_of_a_relative_path_is_assessed_until_its_file_changes(self):
        clock = "[time]\nfrom = 0\nto = 30\nstep = 30\n"
        path = self.scene_file(ROOM + clock + ROUTE)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        scene = luxodus.load(path.name)
        self.assertEqual(scene.file, str(path))
        os.chdir(ROOT)
        before = scene.assess(codes_alone=True, scenario="haze").verdict
        again = luxodus.load(path).assess(codes_alone=True, scenario="haze")
        self.assertEqual(before, again.verdict)
        path.write_text(path.read_text() + "# a word\n")
        with self.assertRaises(luxodus.Error) as caught:
            scene.assess(codes_alone=True, scenario="haze")
        self.assertEqual(caught.exception.file, str(path))
        self.assertIn("the scene has changed on disk", str(caught.exception))

    def test_a_scene_without_a_route_has_nothing_to_assess(self):
        with self.assertRaises(luxodus.Error) as caught:
            luxodus.load(self.scene_file()).assess()
        self.assertIn("nothing to assess", str(caught.exception))


if __name__ == "__main__":
    sys.exit(unittest.main())
