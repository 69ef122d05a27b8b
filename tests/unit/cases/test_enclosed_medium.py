"""Whether a medium stayed whole: distances, depths and areas of a made-up channel, worked by hand."""

import subprocess
import sys
import tempfile
import unittest

import numpy as np

import enclosed_medium


def wall(name, low, high):
    return {"name": name, "box": {"min": low, "max": high}}


def rising(v):
    return {"about": [1.0, 0.0], "poses": [[0.0, 1.0, 0.0, 0.0, 0.0, v], [9.0, 1.0, 9 * v, 0.0, 0.0, v]]}


CASE = {"case": {"end_time": 2.0},
        "fluid": {"region": [{"box": {"min": [0.0, 0.0], "max": [2.0, 5.0]}}],
                  "hole": [{"min": [0, 2], "max": [1, 3]}]},
        "wall": [wall("below", [0.0, -1.0], [2.0, 0.0]), wall("above", [0.0, 5.0], [2.0, 6.0])]}
MOTIONS = {0: rising(0.5), 1: rising(0.25)}


class EnclosedMedium(unittest.TestCase):
    def test_the_space_is_what_is_between_the_pistons(self):
        space = enclosed_medium.Space(CASE, MOTIONS)
        self.assertAlmostEqual(space.area_at(0.0), 2 * 5 - 1)
        self.assertAlmostEqual(space.area_at(2.0), 2 * (5 - 1 + 0.5) - 1, places=6)

    def test_depth_is_that_of_the_nearest_side(self):
        boxes = [(np.array([0.0, 0.0]), np.array([1.0, 1.0]))]
        self.assertTrue(np.allclose(enclosed_medium.depth_in(boxes, np.array([[0.1, 0.5], [1.2, 0.5]])), [0.1, -0.2]))

    def test_a_particle_past_the_walls_is_seen(self):
        points = np.array([[0.5, 0.2], [1.7, 0.5], [0.5, -0.4]])
        outside = enclosed_medium.distance_outside(np.zeros(2), np.ones(2), points)
        self.assertTrue(np.allclose(outside, [-0.2, 0.7, 0.4]))

    def test_a_void_is_seen_and_a_wall_is_none(self):
        centres = np.arange(10) + 0.5
        points = np.array([(x, y) for x in centres for y in centres])
        low, high = np.zeros(2), np.full(2, 10.0)
        self.assertAlmostEqual(enclosed_medium.farthest_point(points, low, high, [], 1.0), 0.5 ** 0.5, delta=0.1)
        gap = points[(abs(points - 4.5) > 0.1).any(axis=1)]
        self.assertAlmostEqual(enclosed_medium.farthest_point(gap, low, high, [], 1.0), 1.0, delta=0.1)
        self.assertLess(enclosed_medium.farthest_point(gap, low, high, [(np.full(2, 4.0), np.full(2, 5.0))], 1.0), 0.8)

    def test_results_that_are_not_there(self):
        with tempfile.TemporaryDirectory() as folder:
            ended = subprocess.run([sys.executable, enclosed_medium.__file__, folder, "--cycle", "1"],
                                   capture_output=True, text=True)
        self.assertEqual(ended.returncode, 2)
        self.assertEqual(ended.stderr, f"{folder}: error: holds no used_case.toml: it takes a run that is done, with "
                                       "frames\n")


if __name__ == "__main__":
    unittest.main()
