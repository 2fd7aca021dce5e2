"""Pictures from Python: the real-time renderer needs an OpenGL context, the path tracer none."""
import os
import tempfile
import unittest

import numpy as np

import welkin


class Pictures(unittest.TestCase):
    def test_render(self):
        sky = welkin.Sky()
        shares = []
        light = sky.render(64, 36, frames=2, progress=shares.append)
        self.assertEqual((light.shape, light.dtype), ((36, 64, 3), np.float32))
        self.assertTrue(np.isfinite(light).all())
        self.assertGreater(light[:8].mean(), 0.1)  # kcd/m^2 of a day's sky
        self.assertEqual(shares, [0.5, 1.0])
        shown = sky.display(light)
        self.assertEqual((shown.shape, shown.dtype), ((36, 64, 3), np.uint8))
        self.assertGreater(shown.max(), 100)

    def test_trace(self):
        light = welkin.Sky("overcast").trace(16, 9, samples=2)
        self.assertEqual(light.shape, (9, 16, 3))
        self.assertTrue(np.isfinite(light).all() and light.mean() > 0.1)

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            sky, light = welkin.Sky(), np.full((4, 6, 3), 2.0, np.float32)
            for name in ("a.png", "a.exr"):
                path = os.path.join(folder, name)
                sky.save_picture(path, light)
                self.assertGreater(os.path.getsize(path), 50)
            with self.assertRaisesRegex(welkin.BadInput, "ends in .png or .exr"):
                sky.save_picture(os.path.join(folder, "a.gif"), light)
            with self.assertRaises(welkin.BadInput):
                sky.save_picture(path, np.zeros((4, 6)))

    def test_cancelling_and_wrong_sizes(self):
        sky = welkin.Sky()
        with self.assertRaises(welkin.Cancelled):
            sky.render(32, 18, progress=lambda done: False)
        with self.assertRaises(welkin.Cancelled):
            sky.trace(32, 18, progress=lambda done: False)
        for width, height in ((0, 5), (5, -1), (20000, 5)):
            with self.assertRaisesRegex(welkin.BadInput, "1 to 16384"):
                sky.render(width, height)


if __name__ == "__main__":
    unittest.main(verbosity=2)
