"""`roboss snapshot`: a picture of the world at a time, drawn by Chromium; it shows something, and what it shows depends on
where one looks from."""
import json
import os
import shutil
import struct
import time
import unittest
import zlib
from pathlib import Path

from running import FOLDER, ROBOSS, WORLDS, RobossTest, roboss

PAGE = Path(ROBOSS).parent.parent / "share/roboss/web/index.html"


def pixels(file):
    """(width, height, the rows' bytes still filtered) of a PNG file."""
    data = file.read_bytes()
    assert data.startswith(b"\x89PNG\r\n\x1a\n"), "no PNG"
    width, height = struct.unpack(">II", data[16:24])
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        packed += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += 12 + size
    return width, height, zlib.decompress(packed)


class Snapshot(RobossTest):
    @unittest.skipUnless(shutil.which("chromium") and PAGE.exists(), "there is no chromium, or the page is not built")
    def test_it_shows_the_world_from_where_one_looks(self):
        shown = []
        for camera in ("top", "0,0,0.5,40,20,6"):
            file = FOLDER / f"pile-{len(shown)}.png"
            done = roboss("snapshot", WORLDS / "pile.sdf", "--at", 1, "--camera", camera, "--width", 640, "--height", 400, "-o", file)
            self.assertEqual(done.returncode, 0, done.stderr)
            width, height, rows = pixels(file)
            self.assertEqual((width, height), (640, 400))
            self.assertGreater(len(set(rows)), 60, "a picture of nothing")
            shown.append(rows)
        self.assertNotEqual(*shown)

    @unittest.skipUnless(shutil.which("chromium") and PAGE.exists(), "there is no chromium, or the page is not built")
    def test_it_takes_all_overlays_of_the_page_and_waits_for_what_they_show(self):
        schema = Path(WORLDS).parent / "src/gateway/protocol.json"
        overlays = json.loads(schema.read_text())["page_overlays"]
        self.assertGreater(len(overlays), 15)
        file = FOLDER / "overlays.png"
        done = roboss("snapshot", WORLDS / "pile.sdf", "--at", 1, "--select", "arm", "--show", ",".join(overlays), "--width", 400,
                      "--height", 300, "-o", file)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(pixels(file)[:2], (400, 300))

    def test_without_the_page_it_is_refused_at_once(self):
        nothing = FOLDER / "no_page"
        nothing.mkdir(exist_ok=True)
        began = time.monotonic()
        self.refused(["snapshot", WORLDS / "pile.sdf", "-o", FOLDER / "none.png", "--web", nothing], 1, "[no-page]",
                     f"is not in the folder {nothing}", "tools/build.sh release web")
        self.assertLess(time.monotonic() - began, 30, "it does not wait for a page that is not there")

    def test_without_a_browser_it_is_refused_with_a_remedy(self):
        page = FOLDER / "page"
        page.mkdir(exist_ok=True)
        (page / "index.html").write_text("<!doctype html>")
        before = dict(os.environ)
        os.environ["ROBOSS_BROWSER"] = "/nowhere/chromium"
        try:
            self.refused(["snapshot", WORLDS / "pile.sdf", "-o", FOLDER / "none.png", "--web", page], 3, "[browser-ended]",
                         "remedy")
        finally:
            os.environ.clear()
            os.environ.update(before)
        self.assertFalse((FOLDER / "none.png").exists())


if __name__ == "__main__":
    unittest.main()
