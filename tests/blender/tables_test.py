"""The parts of the Blender add-on that need no Blender: skies as text, and the command as a process."""
import json
import os
import pathlib
import struct
import sys
import tempfile
import time
import unittest

import numpy as np
import welkin

sys.path.insert(0, os.environ["WELKIN_ADDON"])
import command  # noqa: E402
import table  # noqa: E402

PROGRAM = os.environ["WELKIN"]


def single(value):
    return struct.unpack("f", struct.pack("f", value))[0]


def as_properties(value):
    """A value as Blender's properties keep it: numbers in single precision."""
    if isinstance(value, float):
        return single(value)
    return [single(v) for v in value] if isinstance(value, list) else value


class Text(unittest.TestCase):
    def assertSameSky(self, found, expected, name=""):
        """Equal up to a step of single precision: properties hold degrees, skies radians."""
        self.assertEqual(found.paths(), expected.paths(), name)
        for path in expected.paths():
            a, b = found[path], expected[path]
            if isinstance(b, (float, tuple)):
                np.testing.assert_allclose(a, b, rtol=3e-7, atol=1e-12, err_msg=f"{name} {path}")
            else:
                self.assertEqual(a, b, f"{name} {path}")

    @classmethod
    def setUpClass(cls):
        cls.root = table.tree(json.loads(command.ask(PROGRAM, "fields", "--json")))

    def test_every_preset_survives_the_properties(self):
        for preset in command.presets(PROGRAM):
            rows = {tuple(r["path"].split(".")): r for r in command.values(PROGRAM, preset["name"])}

            def read(place, row):
                place = tuple(str(p) for p in place)
                if row is None:
                    return len({p[1] for p in rows if p[0] == place[0] and len(p) > 1 and p[1].isdigit()})
                return as_properties(rows[(*place, row["name"])]["value"])

            text = table.text(self.root, read)
            self.assertSameSky(welkin.parse(text, preset["file"]), welkin.Sky(preset["name"]), preset["name"])

    def test_lists_nobody_has_touched_give_the_default_sky(self):
        defaults = {row["path"]: row["default"] for row in json.loads(command.ask(PROGRAM, "fields", "--json"))}

        def read(place, row):
            return defaults[".".join([*place, row["name"]])] if row else None
        self.assertSameSky(welkin.parse(table.text(self.root, read)), welkin.Sky())

    def test_numbers_are_short_and_exact(self):
        for value, text in ((0.1, "0.1"), (0.99, "0.99"), (20.0, "20.0"), (1e-5, "1e-05"), (-3.0, "-3.0")):
            self.assertEqual(table.number(single(value)), text)
        for value in (1 / 3, 16777215.0, 1e7 + 1, 4.7123889):
            self.assertEqual(single(float(table.number(single(value)))), single(value))

    def test_texts_are_quoted(self):
        row = {"kind": "text"}
        sky = welkin.parse("format = 1\ntitle = " + table.literal(row, 'a "b" \\ \n é') + "\n")
        self.assertEqual(sky.title, 'a "b" \\ \n é')


class Command(unittest.TestCase):
    def test_a_missing_program_is_named(self):
        with self.assertRaisesRegex(command.WelkinError, "/nowhere/welkin is not a program"):
            command.find("/nowhere/welkin")
        self.assertEqual(command.find(PROGRAM), PROGRAM)

    def test_errors_are_the_commands(self):
        with self.assertRaisesRegex(command.WelkinError, "did you mean 'cumulus'"):
            command.values(PROGRAM, "cumulos")

    def test_baking(self):
        with tempfile.TemporaryDirectory() as folder:
            job = command.Job(PROGRAM, ["vdb", "cumulus", "-o", f"{folder}/a.vdb", "--voxel", 100, "--region",
                                        "0,0,1600,1600", "--target", "blender", "--frames", "3-4", "--json"], folder)
            made = json.loads(job.result())
            self.assertEqual(job.progress, 1.0)
            self.assertEqual([os.path.basename(f) for f in made["files"]], ["a.0003.vdb", "a.0004.vdb"])
            self.assertTrue(all(os.path.getsize(f) > 1000 for f in made["files"]))
            sky = welkin.Sky("cumulus")
            self.assertAlmostEqual(made["density"], sky.layers[0].extinction, places=6)
            self.assertTrue(0.8 < made["asymmetry"] < 0.95)
            self.assertEqual(made["low"][:2] + made["high"][:2], [0, 0, 1600, 1600])

    def test_cancelling(self):
        with tempfile.TemporaryDirectory() as folder:
            job = command.Job(PROGRAM, ["vdb", "cumulus", "-o", f"{folder}/a.vdb", "--voxel", 2, "--tiles", "8x8",
                                        "--json"], folder)
            left = pathlib.Path(folder) / f".a.vdb.{job._process.pid}.0.part"  # what a killed command may leave
            left.write_text("half")
            time.sleep(0.5)
            self.assertTrue(job.running())
            begin = time.time()
            job.cancel()
            self.assertLess(time.time() - begin, 10)
            self.assertFalse(job.running())
            self.assertFalse(left.exists())
            with self.assertRaisesRegex(command.WelkinError, "cancelled"):
                job.result()


if __name__ == "__main__":
    unittest.main(verbosity=2)
