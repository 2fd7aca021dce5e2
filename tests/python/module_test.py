"""The Python module without pictures: parameters, files, errors, density, volumes."""
import copy
import os
import pickle
import subprocess
import tempfile
import threading
import unittest

import numpy as np

import welkin


class Skies(unittest.TestCase):
    def test_default_sky(self):
        sky = welkin.Sky()
        self.assertEqual(len(sky.layers), 1)
        self.assertEqual(sky["wind.speed"], 8.0)
        self.assertEqual(sky.wind.speed, 8.0)

    def test_every_preset_loads_and_survives_a_round_trip(self):
        presets = welkin.presets()
        self.assertGreater(len(presets), 20)
        for preset in presets:
            sky = welkin.Sky(preset["name"])
            self.assertEqual(welkin.parse(sky.text(), preset["file"]), sky, preset["name"])

    def test_every_parameter_can_be_read_and_set_to_what_it_is(self):
        sky = welkin.Sky("hero_congestus")
        before = sky.copy()
        for path in sky.paths():
            if not path.endswith((".preset", ".species")):  # these reset others
                sky[path] = sky[path]
        self.assertEqual(sky, before)

    def test_every_field_has_a_value_of_its_kind(self):
        kinds = {"real": float, "integer": int, "boolean": bool, "choice": str, "text": str, "file": str,
                 "vector": tuple}
        for row in welkin.fields():
            self.assertIsInstance(row["default"], kinds[row["kind"]], row["path"])
            self.assertTrue(row["help"], row["path"])

    def test_values_are_those_of_files(self):
        sky = welkin.Sky()
        sky.sun.elevation = 20
        sky.layers[0].weather.coverage = 0.1
        sky.camera.position = np.array([1.0, 2.0, 300.0])
        sky.seed = np.int64(7)
        self.assertEqual(sky.sun.elevation, 20.0)  # degrees, no rest of radians
        self.assertEqual(sky.layers[0].weather.coverage, 0.1)  # a single inside
        self.assertEqual(sky["camera.position"], (1.0, 2.0, 300.0))
        self.assertIn("elevation = 20.0", sky.text())
        self.assertEqual(sky.seed, 7)

    def test_lists(self):
        sky = welkin.Sky()
        sky.heroes.append(form={"anvil": 8000}, position=(0, 9000, 1000), species="incus")
        self.assertEqual(sky.heroes[0].form.anvil, 8000.0)
        self.assertEqual(sky.heroes[-1].form.width, 9000.0)  # the species'
        del sky.layers[0]
        self.assertEqual(len(sky.layers), 0)
        with self.assertRaises(IndexError):
            sky.layers[0]
        for _ in range(4):
            sky.sheets.append()
        with self.assertRaisesRegex(welkin.BadInput, "at most 4"):
            sky.sheets.append()

    def test_append_undoes_itself_when_a_value_is_wrong(self):
        sky = welkin.Sky()
        with self.assertRaises(welkin.BadInput):
            sky.heroes.append(scale=-1)
        self.assertEqual(sky, welkin.Sky())

    def test_copies_are_independent(self):
        sky = welkin.Sky("cumulus")
        for other in (sky.copy(), copy.deepcopy(sky), pickle.loads(pickle.dumps(sky))):
            self.assertEqual(other, sky)
            other.wind.speed = 33
            self.assertNotEqual(other, sky)

    def test_saving(self):
        with tempfile.TemporaryDirectory() as folder:
            sky = welkin.Sky("stratus")
            path = os.path.join(folder, "mine.sky.toml")
            sky.save(path)
            self.assertEqual(welkin.Sky(path), sky)
            self.assertEqual(os.listdir(folder), ["mine.sky.toml"])

    def test_names_are_listed(self):
        sky = welkin.Sky()
        self.assertIn("layers", dir(sky))
        self.assertIn("coverage", dir(sky.layers[0].weather))
        self.assertIn("weather", dir(sky.layers[0]))
        self.assertIn("coverage=", repr(sky.layers[0].weather))


class Errors(unittest.TestCase):
    def test_they_say_what_the_command_says(self):
        sky = welkin.Sky()
        with self.assertRaisesRegex(welkin.BadInput, "outside -?[0-9.]+ to") as caught:
            sky.layers[0].weather.coverage = 7
        self.assertEqual(caught.exception.where, "layer.0.weather.coverage=7")
        self.assertIsInstance(caught.exception, ValueError)
        with self.assertRaisesRegex(welkin.BadInput, "did you mean 'sun.elevation'"):
            sky["sun.elevaton"] = 3
        with self.assertRaisesRegex(AttributeError, "did you mean 'sun.elevation'"):
            sky.sun.elevaton
        with self.assertRaisesRegex(welkin.BadInput, "did you mean 'cumulus'"):
            welkin.Sky("cumulos")
        with self.assertRaisesRegex(welkin.BadInput, "mine:2:1: "):
            welkin.parse("format = 1\nspeed = 3\n", "mine")

    def test_wrong_types(self):
        sky = welkin.Sky()
        for value in (None, "fast", [1, 2], [1, 2, "x"], float("nan"), float("inf"), {}, 10**30, True):
            with self.assertRaises(welkin.BadInput, msg=repr(value)):
                sky.wind.speed = value
        with self.assertRaises(welkin.BadInput):
            sky.seed = 1.5
        self.assertEqual(sky, welkin.Sky())

    def test_files(self):
        with self.assertRaises(welkin.Error):
            welkin.Sky("/nowhere/at/all.sky.toml")
        with self.assertRaises(welkin.Failed):
            welkin.Sky().save("/nowhere/at/all.sky.toml")
        with self.assertRaisesRegex(welkin.BadInput, "ends in .vdb"):
            welkin.Sky().bake("cloud.txt")


def density_by_cpp(sky, points):
    """The same sky's extinction by a program in C++, which reads the saved file."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "sky.toml")
        sky.save(path)
        text = "\n".join(" ".join(repr(c) for c in p) for p in points.tolist())
        out = subprocess.run([os.environ["WELKIN_DENSITY_AT"], path], input=text, text=True, check=True,
                             capture_output=True).stdout
    return np.array(out.split(), dtype=np.float64)


class Density(unittest.TestCase):
    def assert_it_is_that_of_cpp(self, sky, points, name, in_cloud):
        expected = density_by_cpp(sky, points)
        found = sky.clouds().extinction(points)
        self.assertEqual(found.dtype, np.float32)
        self.assertGreater((expected > 0).sum(), in_cloud, name)
        # One asks point by point, the other for all at once, whose shared anchor rounds their places: of an edge of a
        # few metres that is more than 1e-4 at single points.
        error = np.abs(found - expected) / expected.max()
        self.assertLess(np.quantile(error, 0.99), 1e-4, name)
        self.assertLess(error.max(), 5e-3, name)

    def test_it_is_that_of_cpp(self):
        random = np.random.default_rng(5)
        for name, low, high in (("default", (-4e3, -4e3, 500), (4e3, 4e3, 3000)),
                                ("stratocumulus", (-4e3, -4e3, 200), (4e3, 4e3, 2500)),
                                ("hero_congestus", (-2e3, 4e3, 800), (2e3, 9e3, 5000))):
            sky = welkin.Sky(name)
            if name == "hero_congestus":
                x, y, z = sky.heroes[0].position
                low, high = (x - 1500, y - 1500, z), (x + 1500, y + 1500, z + 3500)
            self.assert_it_is_that_of_cpp(sky, random.uniform(low, high, (4000, 3)), name, 50)

    def test_random_hero_clouds_are_those_of_cpp(self):
        random = np.random.default_rng(6)

        def parameters(table):
            return {f["path"].rpartition(".")[2]: random.uniform(*f["slider"]) if f["kind"] == "real" else
                    int(random.integers(f["slider"][0], f["slider"][1] + 1))
                    for f in welkin.fields() if f["path"].startswith(table + ".") and f["kind"] in ("real", "integer")}

        shapes = next(f for f in welkin.fields() if f["path"] == "hero.form.shape")["choices"]
        self.assertEqual(len(shapes), 9)
        for shape in shapes:
            sky = welkin.Sky()
            sky.layers.clear()
            form = parameters("hero.form")
            sky.heroes.append(position=(300, -200, 900), heading=random.uniform(0, 360), age=0.7, extinction=0.1,
                              form={**form, "shape": shape}, surface=parameters("hero.surface"),
                              classic=parameters("hero.classic"))
            half = 0.5 * max(form["width"], form["width"] * form["breadth"])
            low, high = (300 - half, -200 - half, 900), (300 + half, -200 + half, 900 + form["height"])
            self.assert_it_is_that_of_cpp(sky, random.uniform(low, high, (4000, 3)), shape, 10)

    def test_shapes(self):
        clouds = welkin.Sky().clouds()
        self.assertEqual(clouds.extinction([0, 0, 1000]).shape, ())
        self.assertEqual(clouds.extinction(np.zeros((2, 5, 3))).shape, (2, 5))
        self.assertEqual(clouds.extinction(np.zeros((0, 3))).shape, (0,))
        self.assertEqual(clouds.optical_depth(np.zeros((4, 2)), 0, 4000).shape, (4,))
        for wrong in (np.zeros((4, 2)), 3.0, [[np.nan, 0, 0]]):
            with self.assertRaises(welkin.BadInput):
                clouds.extinction(wrong)

    def test_voxels_are_the_density_at_their_centres(self):
        clouds = welkin.Sky().clouds()
        grid, origin = clouds.voxels(voxel=50, region=(0, 0, 1600, 800))
        self.assertEqual(grid.shape[:2], (32, 16))
        self.assertGreater(grid.max(), 0)
        centres = np.stack(np.meshgrid(*(np.arange(n) for n in grid.shape), indexing="ij"), -1)
        expected = clouds.extinction(np.array(origin) + (centres + 0.5) * 50)
        np.testing.assert_allclose(grid, expected, rtol=1e-4, atol=1e-6)

    def test_clouds_are_of_the_moment(self):
        sky = welkin.Sky()
        points = np.random.default_rng(1).uniform((-4e3, -4e3, 700), (4e3, 4e3, 2000), (3000, 3))
        before = sky.clouds()
        first = before.extinction(points)
        sky.time = 600
        self.assertFalse(np.array_equal(sky.clouds().extinction(points), first))
        self.assertTrue(np.array_equal(before.extinction(points), first))

    def test_threads(self):
        clouds = welkin.Sky().clouds()
        points = np.random.default_rng(2).uniform((-4e3, -4e3, 700), (4e3, 4e3, 2000), (2000, 3))
        expected, found = clouds.extinction(points), [None] * 4

        def ask(i):
            found[i] = clouds.extinction(points)
        threads = [threading.Thread(target=ask, args=(i,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for one in found:
            self.assertTrue(np.array_equal(one, expected))


class Volumes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "cloud.vol")
        self.sky = welkin.Sky("cumulus")
        self.box = (0, 0, 1600, 1600)

    def test_baking(self):
        shares = []
        made = self.sky.bake(self.path, voxel=100, region=self.box, progress=shares.append)
        self.assertGreater(os.path.getsize(self.path), 16 * 16 * 4)
        self.assertAlmostEqual(made["density"], self.sky.layers[0].extinction, places=6)
        self.assertEqual(made["shape"][:2], (16, 16))
        self.assertEqual(sorted(shares), shares)
        self.assertAlmostEqual(shares[-1], 1.0)

    def test_cancelling(self):
        with self.assertRaises(welkin.Cancelled):
            self.sky.bake(self.path, voxel=100, region=self.box, progress=lambda done: False)
        self.assertFalse(os.path.exists(self.path))

    def test_what_the_callback_raises_comes_out(self):
        def fail(done):
            raise KeyError("mine")
        with self.assertRaisesRegex(KeyError, "mine"):
            self.sky.bake(self.path, voxel=100, region=self.box, progress=fail)

    def test_wrong_arguments(self):
        for wrong in ({"voxel": 0}, {"voxel": float("nan")}, {"region": (1, 2)}, {"region": (5, 5, 1, 1)},
                      {"target": "maya"}, {"density": "thick"}, {"precision": "double"}):
            with self.assertRaises(welkin.BadInput, msg=str(wrong)):
                self.sky.bake(self.path, **wrong)


if __name__ == "__main__":
    unittest.main(verbosity=2)
