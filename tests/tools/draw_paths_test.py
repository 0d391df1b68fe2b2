"""tools/draw_paths: every robot gets its path, static scenery is drawn in its place, and an empty trace is told."""
import os
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

TOOL = Path(os.environ["ROBOSS_TOOLS"]) / "draw_paths"
SVG = "{http://www.w3.org/2000/svg}"
HEADER = "time_s,robot,link,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n"
REST = ",0,1,0,0,0,0,0,0,0,0,0\n"
WORLD = """<sdf version="1.9"><world name="w">
<model name="house"><static>true</static><pose>10 0 0 0 0 1.5707963267948966</pose>
  <link name="l"><pose>2 0 0 0 0 0</pose><collision name="c"><geometry><box><size>4 6 3</size></box></geometry></collision></link></model>
<model name="car"><link name="l"><collision name="c"><geometry><box><size>9 9 9</size></box></geometry></collision></link></model>
</world></sdf>"""


def draw(trace, world=WORLD):
    """Exit code, error text and the picture's root element (None without a picture)."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "trace.csv").write_text(trace)
        (Path(folder) / "world.sdf").write_text(world)
        out = Path(folder) / "out.svg"
        done = subprocess.run([sys.executable, TOOL, f"{folder}/trace.csv", "--world", f"{folder}/world.sdf", "--out", out],
                              capture_output=True, text=True, check=False)
        return done.returncode, done.stderr, xml.parse(out).getroot() if out.exists() else None


class DrawPaths(unittest.TestCase):
    def test_draws_the_path_of_each_robots_first_link(self):
        code, error, picture = draw(HEADER + "0,b,base,0,0" + REST + "0,b,wheel,50,50" + REST + "0,a&b,base,5,5" + REST
                                    + "1,b,base,1,2" + REST + "1,b,wheel,60,60" + REST)
        self.assertEqual(code, 0, error)
        paths = {group.findtext(f"{SVG}title"): group.find(f"{SVG}polyline").get("points")
                 for group in picture.iter(f"{SVG}g") if group.find(f"{SVG}title") is not None}
        self.assertEqual(paths, {"a&b": "5.00,5.00", "b": "0.00,0.00 1.00,2.00"})

    def test_draws_static_boxes_where_model_and_link_put_them_and_no_movable_ones(self):
        _, _, picture = draw(HEADER + "0,a,base,0,0" + REST)
        boxes = [rect for rect in picture.iter(f"{SVG}rect") if rect.get("transform")]
        self.assertEqual(len(boxes), 1)
        self.assertEqual((boxes[0].get("width"), boxes[0].get("height")), ("4.000", "6.000"))
        self.assertEqual(boxes[0].get("transform"), "translate(10.000 2.000) rotate(90.000)")

    def test_tells_when_the_trace_is_empty(self):
        code, error, picture = draw(HEADER)
        self.assertEqual(code, 1)
        self.assertIn("holds no robots", error)
        self.assertIsNone(picture)


if __name__ == "__main__":
    unittest.main()
