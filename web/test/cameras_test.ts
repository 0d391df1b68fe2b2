// Pictures of cameras: what the bytes say, which way pixels look, and which colours numbers get.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Cameras } from "../src/model/cameras";
import { BEFORE, BEYOND, colourAt, labelColour, paintNumbers } from "../src/model/colour_maps";
import { cloudOf, pixelRays, undistorted } from "../src/model/pixel_rays";
import { PICTURE_BYTES, PICTURE_KIND } from "../src/protocol";
import { isPicture, numbersOf, readPicture } from "../src/wire/picture";

function message(about: object, file: number[]): ArrayBuffer {
    const text = new TextEncoder().encode(JSON.stringify(about)),
        data = new ArrayBuffer(PICTURE_BYTES + text.length + file.length),
        view = new DataView(data);
    view.setUint8(0, PICTURE_KIND);
    view.setUint32(4, 3, true);
    view.setFloat64(8, 600, true);
    view.setFloat64(16, 1.2, true);
    view.setUint32(24, 7, true);
    view.setUint32(28, 2, true);
    view.setUint32(32, text.length, true);
    new Uint8Array(data).set([...text, ...file], PICTURE_BYTES);
    return data;
}

test("a Picture has its camera, its tick, JSON and a file", async () => {
    const data = message({ shows: "depth", columns: 2, rows: 1, low: 1, high: 3 }, [1, 2, 3]);
    assert.ok(isPicture(data));
    const picture = readPicture(data);
    assert.deepEqual([picture.scene, picture.tick, picture.time, picture.robot, picture.sensor], [3, 600, 1.2, 7, 2]);
    assert.equal(picture.about.high, 3);
    assert.equal(picture.file.type, "image/png");
    assert.deepEqual([...new Uint8Array(await picture.file.arrayBuffer())], [1, 2, 3]);
    const short = data.slice(0, PICTURE_BYTES + 5);
    assert.throws(() => readPicture(short), /ends in its JSON/);
});

test("numbers of 16 bits come back, and what is out of range", () => {
    const pixel = (count: number) => [count >> 8, count & 255, 0, 255],
        rgba = Uint8ClampedArray.from([...pixel(0), ...pixel(1), ...pixel(65534), ...pixel(65535), ...pixel(32768)]),
        values = numbersOf(rgba, 2, 10);
    assert.equal(values[0], -Infinity);
    assert.equal(values[1], 2);
    assert.equal(values[2], 10);
    assert.equal(values[3], Infinity);
    assert.ok(Math.abs(values[4] - 6) < 1e-3);
});

test("colours of numbers have ends, and what is out of range has colours of its own", () => {
    assert.deepEqual([...colourAt("grey", 0)], [255, 255, 255]);
    assert.deepEqual([...colourAt("grey", 1)], [10, 10, 10]);
    const pixels = paintNumbers(Float32Array.from([Infinity, -Infinity, 1]), 1, 2, "grey");
    assert.deepEqual([...pixels.subarray(0, 3)], [...BEYOND]);
    assert.deepEqual([...pixels.subarray(4, 7)], [...BEFORE]);
    assert.deepEqual([...pixels.subarray(8, 12)], [255, 255, 255, 255]);
});

test("labels next to each other have colours that differ", () => {
    for (let label = 1; label < 255; ++label) {
        const [a, b] = [labelColour(label), labelColour(label + 1)];
        assert.ok(Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) > 60, `${label}: ${a} ${b}`);
    }
    assert.notDeepEqual(labelColour(3, 1), labelColour(3, 2));
});

test("pixels look where the lens says, with distortion undone", () => {
    const rays = pixelRays(4, 2, [2, 2, 2, 1], []);
    assert.deepEqual([rays[0], rays[1]], [0.75, 0.25]);
    assert.deepEqual([rays[14], rays[15]], [-0.75, -0.25]);
    const [k1, k2, p1, p2, k3] = [-0.2, 0.05, 0.002, -0.003, 0.001],
        [x, y] = [0.3, -0.4],
        rr = x * x + y * y,
        radial = 1 + rr * (k1 + rr * (k2 + rr * k3)),
        a = x * radial + 2 * p1 * x * y + p2 * (rr + 2 * x * x),
        b = y * radial + p1 * (rr + 2 * y * y) + 2 * p2 * x * y,
        back = undistorted(a, b, [k1, k2, p1, p2, k3]);
    assert.ok(Math.hypot(back[0] - x, back[1] - y) < 1e-9, String(back));
});

test("a cloud has a point for each depth, along the axis", () => {
    const rays = pixelRays(2, 1, [1, 1, 1, 0.5], []),
        { points, pixels } = cloudOf(Float32Array.from([2, Infinity]), rays);
    assert.deepEqual(
        [...points].map((value) => value + 0), // no -0
        [2, 1, 0],
    );
    assert.deepEqual([...pixels], [0]);
});

test("a picture that several parts want is asked for once, in the largest size, and only while it is wanted", () => {
    const cameras = new Cameras(),
        wish = { robot: 1, sensor: 0, shows: "color" as const };
    cameras.want("panel", [
        { ...wish, columns: 128 },
        { ...wish, columns: 640 },
    ]);
    cameras.want("clouds", [{ ...wish, columns: 200 }]);
    assert.deepEqual(cameras.wishes.value, [{ ...wish, columns: 640 }]);
    cameras.want("panel", []);
    assert.deepEqual(cameras.wishes.value, [{ ...wish, columns: 200 }]);
    cameras.want("clouds", []);
    assert.deepEqual(cameras.wishes.value, []);
});
