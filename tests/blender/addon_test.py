"""The add-on in Blender without a window: a long test, for where Blender is installed."""
import json
import os
import shutil
import subprocess
import tempfile
import unittest

import numpy as np

import welkin

HERE = os.path.dirname(os.path.abspath(__file__))


@unittest.skipUnless(shutil.which("blender"), "Blender is not installed (Debian: blender)")
class AddOn(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = os.environ.get("WELKIN_KEEP") or tempfile.mkdtemp()
        if "WELKIN_KEEP" not in os.environ:
            cls.addClassCleanup(shutil.rmtree, cls.folder)
        archive = cls.archive = os.path.join(cls.folder, "welkin_sky.zip")
        subprocess.run([os.environ["WELKIN_MAKE_ADDON"], archive], check=True, capture_output=True)
        environment = cls.environment = dict(os.environ, BLENDER_USER_SCRIPTS=cls.folder + "/scripts",
                           BLENDER_USER_CONFIG=cls.folder + "/config")
        environment.pop("PYTHONPATH", None)  # Blender's Python is its own
        done = subprocess.run(["blender", "-b", "--factory-startup", "-noaudio", "-t", "2", "--python-exit-code", "1",
                               "--python", HERE + "/inside.py", "--", archive, cls.folder],
                              env=environment, capture_output=True, text=True)
        lines = [line for line in done.stdout.splitlines() if line.startswith("FOUND ")]
        if done.returncode or not lines:
            raise AssertionError(done.stdout[-3000:] + done.stderr[-3000:])
        cls.found = json.loads(lines[-1][6:])

    def test_properties_come_from_the_field_tables(self):
        rows = {row["path"]: row for row in welkin.fields()}
        self.assertEqual(self.found["properties"], rows["sun.elevation"]["range"][1])
        self.assertAlmostEqual(self.found["wind"], rows["wind.speed"]["default"])

    def test_presets_and_species(self):
        sky = welkin.Sky("hero_congestus")
        self.assertEqual(self.found["loaded"], [len(sky.layers), len(sky.heroes), sky.heroes[0].species])
        other = welkin.Sky()
        other.heroes.append(species="mediocris")
        self.assertAlmostEqual(self.found["width"], other.heroes[0].form.width, places=3)
        saved = welkin.Sky(os.path.join(self.folder, "saved.sky.toml"))
        self.assertEqual(saved.heroes[0].position, (0.0, 4000.0, 1200.0))
        self.assertEqual(saved.heroes[0].form.height, other.heroes[0].form.height)

    def test_sun_and_world(self):
        azimuth, elevation = np.radians(130), np.radians(35)
        expected = [np.sin(azimuth) * np.cos(elevation), np.cos(azimuth) * np.cos(elevation), np.sin(elevation)]
        np.testing.assert_allclose(self.found["to_sun"], expected, atol=2e-3)
        luminance = np.dot(self.found["sun"], [0.2126, 0.7152, 0.0722])
        self.assertTrue(60 < luminance < 128, luminance)  # klx, less than outside the air
        self.assertTrue(0.5 < self.found["sky"] < 20, self.found["sky"])  # kcd/m^2

    def test_volume_and_material(self):
        self.assertEqual(self.found["grids"], ["density"])
        self.assertAlmostEqual(self.found["material"][0], 0.1, places=5)
        self.assertTrue(0.8 < self.found["material"][1] < 0.95)

    def test_the_cloud_is_where_the_sky_has_it(self):
        self.assertTrue(0.02 < self.found["changed"] < 0.6, self.found["changed"])
        self.assertGreater(self.found["middle"], 0.5)

    def test_preview(self):
        self.assertEqual(self.found["preview"], [64, 36])

    def test_sequences(self):
        self.assertEqual(self.found["frames"], ["flow.0005.vdb", "flow.0007.vdb"])

    def test_live_nodes_have_the_laws_statistics(self):
        made = self.found["classic"]
        sky = welkin.Sky()
        del sky.layers[0]
        values = {k: v for k, v in made["classic"].items()}
        sky.heroes.append(species="congestus", position=(0, 0, 0), extinction=1, age=0.75, classic=values,
                          form={k: made[k] for k in made if k != "classic"} | {"shape": "classic"})
        edge = (np.arange(128) + 0.5) / 128 * 2000 - 1000
        x, y = np.meshgrid(edge, edge)
        law = {"mean": [], "sd": [], "cover": []}
        for seed in range(8):  # the law of many clouds: the nodes' is one more
            sky.heroes[0].seed = seed
            clouds = sky.clouds()
            for row in self.found["slices"]:
                values = clouds.extinction(np.stack([x, y, np.full_like(x, 2000 * row["height"])], -1))
                for name, value in (("mean", values.mean()), ("sd", values.std()), ("cover", (values > 0).mean())):
                    law[name].append(value)
        for name, tolerance in (("mean", 0.1), ("sd", 0.1), ("cover", 0.1)):
            expected, found = np.mean(law[name]), np.mean([row[name] for row in self.found["slices"]])
            print(f"{name}: law {expected:.4f}, nodes {found:.4f}")
            self.assertLess(abs(found / expected - 1), tolerance, name)

    @unittest.skipUnless(shutil.which("xvfb-run"), "no display: xvfb-run is not installed (Debian: xvfb xauth)")
    def test_buttons_wait_and_can_be_cancelled(self):
        done = subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 1200x900x24", "blender", "--factory-startup",
                               "-noaudio", "--window-geometry", "0", "0", "1200", "900", "--python",
                               HERE + "/window.py", "--", self.archive, self.folder],
                              env=dict(self.environment, LIBGL_ALWAYS_SOFTWARE="1"), capture_output=True, text=True)
        path = os.path.join(self.folder, "window.json")
        self.assertTrue(os.path.exists(path), done.stdout[-2000:] + done.stderr[-2000:])
        with open(path, encoding="utf-8") as file:
            found = json.load(file)
        self.assertNotIn("error", found, found.get("error"))
        self.assertEqual((found["pressed"], found["bake"]), (["RUNNING_MODAL"], ["RUNNING_MODAL"]))
        self.assertTrue(found["preview"])
        self.assertEqual(found["busy"], "Bake clouds")
        self.assertIn("still at work", found["refused"])
        self.assertEqual((found["left"], found["progress"]), ([], ""))

    def test_disabling_leaves_nothing(self):
        self.assertTrue(self.found["gone"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
