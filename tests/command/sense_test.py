"""`roboss sense` and `roboss dataset`: readings as files, which agree with each other, and clear errors."""
import json
import math
import struct
import unittest

from png import read_png
from running import FOLDER, WORLDS, RobossTest, on_terminal, roboss, summary

WORLD = WORLDS / "cameras.sdf"


def numbers(line):
    return [float(word) for word in line.split()]


def sensed(sensor, name, at=2):
    file = FOLDER / name
    done = roboss("sense", WORLD, "--robot", "rover", "--sensor", sensor, "--at", at, "-o", file)
    assert done.returncode == 0, done.stderr
    return file


def recorded(name, *arguments):
    folder = FOLDER / name
    done = roboss("dataset", WORLD, "-o", folder, "--quiet", *arguments)
    assert done.returncode == 0, done.stderr
    return folder, done


class Sense(RobossTest):
    def test_an_image_and_an_array_have_the_shape_of_the_sensor(self):
        rows = read_png(sensed("eye", "eye.png"))
        self.assertEqual((len(rows), len(rows[0]), len(rows[0][0])), (240, 320, 3))
        data = sensed("scan", "scan.npy").read_bytes()
        self.assertEqual(data[:6], b"\x93NUMPY")
        self.assertIn(b"'shape': (5760, )", data)

    def test_a_long_way_to_the_reading_shows_its_progress_on_a_terminal(self):
        for quiet, shown in ((), True), (("--quiet",), False):
            with self.subTest(quiet=quiet):
                text = on_terminal("sense", WORLDS / "city.sdf", "--robot", "car_0", "--sensor", "gps", "--at", 1200, "-o",
                                   FOLDER / "far.csv", *quiet)
                self.assertEqual("50 robots  50 islands" in text, shown, text)

    def test_a_picture_is_red_where_the_camera_puts_blue_first_too(self):
        text = WORLD.read_text()
        self.assertIn("<height>240</height></image>", text)
        blue_first = FOLDER / "blue_first.sdf"
        blue_first.write_text(text.replace("<height>240</height></image>",
                                           "<height>240</height><format>B8G8R8</format></image>"))
        def picture(world, name):
            file = FOLDER / name
            done = roboss("sense", world, "--path", WORLDS / "models", "--robot", "rover", "--sensor", "eye",
                          "--at", 1, "-o", file)
            self.assertEqual(done.returncode, 0, done.stderr)
            return file
        self.assertEqual(read_png(picture(blue_first, "blue.png")), read_png(picture(WORLD, "red.png")))
        blue, red = (picture(world, name).read_bytes()
                     for world, name in ((blue_first, "blue.npy"), (WORLD, "red.npy")))
        self.assertNotEqual(blue, red)
        self.assertEqual(blue[-3:], red[:-4:-1])

    def test_a_depth_image_counts_the_millimetres_of_its_points(self):
        rows = read_png(sensed("depth", "depth.png"))
        header, points = sensed("depth", "depth.pcd").read_bytes().split(b"DATA binary\n")
        self.assertIn(f"POINTS {sum(value > 0 for row in rows for value in row)}\n".encode(), header)
        ahead = [struct.unpack_from("<f", points, at)[0] for at in range(0, len(points), 12)]
        seen = [value for row in rows for value in row if value > 0]
        self.assertLess(max(abs(1000 * x - mm) for x, mm in zip(ahead, seen)), 0.51)

    def test_numbers_are_lines_of_a_table(self):
        lines = sensed("imu", "imu.csv").read_text().splitlines()
        self.assertEqual(lines[0], "name,index,value,unit")
        self.assertTrue(any(line.startswith("angular_velocity,2,") for line in lines), lines)

    def test_what_does_not_fit_is_refused(self):
        to = ["-o", FOLDER / "none.png"]
        self.refused(["sense", WORLD, "--robot", "rower", "--sensor", "eye", *to], 1, "[no-robot]", "'rover'")
        self.refused(["sense", WORLD, "--robot", "rover", "--sensor", "eyes", *to], 1, "[no-sensor]", "'eye'")
        self.refused(["sense", WORLD, "--robot", "rover", "--sensor", "imu", *to], 3, "[reading-format]", ".csv")


class Dataset(RobossTest):
    def test_coco_masks_are_the_pixels_of_the_segmentation_camera_at_the_same_place(self):
        folder, _ = recorded("coco", "--frames", 4, "--every", 1.5)
        coco = json.loads((folder / "annotations/instances.json").read_text())
        self.assertEqual({one["name"] for one in coco["categories"]}, {"rover", "box", "drum", "ball"})
        self.assertEqual(len(coco["images"]), 4)
        self.assertGreater(len(coco["annotations"]), 6)
        for image in coco["images"]:
            self.assertEqual(len(read_png(folder / image["file_name"])), 240)
            labels = read_png(folder / f"rover/labels/labels/{image['frame']:06}.png")
            masks = [[0] * 320 for _ in range(240)]
            for one in coco["annotations"]:
                if one["image_id"] == image["id"]:
                    self.paint(one, masks)
            self.assertEqual([list(row) for row in labels], masks)

    def paint(self, annotation, masks):
        """Writes the category into the pixels of the mask, and checks box and area."""
        at, inside, pixels = 0, False, []
        for count in annotation["segmentation"]["counts"]:
            pixels += range(at, at + count) if inside else ()
            at, inside = at + count, not inside
        places = [divmod(pixel, 240) for pixel in pixels]  # column, row
        left, top = min(u for u, _ in places), min(v for _, v in places)
        right, bottom = max(u for u, _ in places), max(v for _, v in places)
        self.assertEqual(annotation["bbox"], [left, top, right - left + 1, bottom - top + 1])
        self.assertEqual(annotation["area"], len(pixels))
        self.assertTrue(0 < annotation["visible"] <= 1)
        for u, v in places:
            masks[v][u] = annotation["category_id"]

    def test_kitti_points_lie_at_the_depths_of_the_camera_after_calibration(self):
        folder, _ = recorded("kitti", "--format", "kitti", "--frames", 2, "--every", 3)
        near = total = 0
        for frame in range(2):
            calibration = dict(line.split(":") for line in
                               (folder / f"training/calib/{frame:06}.txt").read_text().splitlines())
            P, T = numbers(calibration["P2"]), numbers(calibration["Tr_velo_to_cam"])
            depth = read_png(folder / f"rover/depth/depth/{frame:06}.png")
            scan = (folder / f"training/velodyne/{frame:06}.bin").read_bytes()
            for at in range(0, len(scan), 16):
                p = (*struct.unpack_from("<3f", scan, at), 1)
                x, y, z = (sum(T[4 * r + c] * p[c] for c in range(4)) for r in range(3))
                if not 0.1 < z < 15:  # far ahead a pixel covers metres of the ground
                    continue
                u, v = math.floor(P[0] * x / z + P[2]), math.floor(P[5] * y / z + P[6])
                if 1 <= u < 319 and 1 <= v < 239:
                    around = [depth[b][a] for b in (v - 1, v, v + 1) for a in (u - 1, u, u + 1)]
                    total += 1
                    near += min(around) - 20 < 1000 * z < max(around) + 20  # mm
        self.assertGreater(total, 400)
        self.assertGreater(near / total, 0.98, total)

    def test_kitti_labels_have_the_boxes_of_the_world(self):
        folder, _ = recorded("boxes", "--format", "kitti", "--frames", 1)
        lines = (folder / "training/label_2/000000.txt").read_text().splitlines()
        self.assertEqual({line.split()[0] for line in lines}, {"box", "drum", "ball"})
        sizes = {"box": (0.5, 0.5, 0.5), "drum": (0.8, 0.5, 0.5), "ball": (0.6, 0.6, 0.6)}
        for line in lines:
            kind, *rest = line.split()
            values = [float(word) for word in rest]
            for got, wanted in zip(values[7:10], sizes[kind]):
                self.assertAlmostEqual(got, wanted, delta=2e-3)
            x, _, z = values[10:13]
            self.assertAlmostEqual(math.remainder(values[13] - math.atan2(x, z) - values[2], 2 * math.pi), 0, delta=2e-3)

    def test_recording_changes_no_bit_and_depends_on_no_thread(self):
        wanted = summary(WORLD, "--duration", 1.5, "--headless")["state_hash"]
        one, done = recorded("one", "--frames", 4, "--every", 0.5, "--threads", 1)
        self.assertIn(wanted, done.stdout)
        two, done = recorded("two", "--frames", 4, "--every", 0.5, "--threads", 2, "--simulators", 2)
        self.assertIn(wanted, done.stdout)
        files = sorted(file.relative_to(one) for file in one.rglob("*") if file.is_file())
        self.assertGreater(len(files), 20)
        for file in files:
            self.assertEqual((one / file).read_bytes(), (two / file).read_bytes(), file)

    def test_bad_input_is_refused(self):
        folder = FOLDER / "full"
        folder.mkdir()
        (folder / "something").write_text("")
        self.refused(["dataset", WORLD, "-o", folder], 1, "[folder-not-empty]")
        self.refused(["dataset", WORLD, "-o", FOLDER / "no", "--sensors", "rover/ey"], 1, "[no-sensor]", "rover/eye")
        self.refused(["dataset", WORLDS / "pile.sdf", "-o", FOLDER / "no"], 1, "[no-sensor]", "no cameras")
        self.refused(["dataset", WORLD, "-o", FOLDER / "no", "--sensors", "*/scan", "--format", "kitti"], 1, "[no-sensor]",
                     "colour camera")
        self.assertEqual([file.name for file in folder.iterdir()], ["something"])


if __name__ == "__main__":
    unittest.main()
