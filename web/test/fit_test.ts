// The whole world is inside the free part of the picture, whatever its shape, and as near as that allows.
import assert from "node:assert/strict";
import { test } from "node:test";
import { type Thing, worthSeeing } from "../src/camera/extent";
import { type Ball, fitted, type FreePart, seenAt } from "../src/camera/fit";
import { beside } from "../src/camera/free_part";
import { DIRECTIONS, NAMED_VIEWS, wordsOfCamera } from "../src/camera/named_views";
import { thinned } from "../src/overlays/beams";
import { viewAt, viewports } from "../src/view/viewports";
import type { SensorInfo, Triple } from "../src/wire/messages";

const PICTURES: [number, number][] = [
    [390, 844],
    [844, 390],
    [1024, 768],
    [1440, 900],
    [2560, 800],
    [300, 1600],
];

/** A random box's corners, from a seed. */
function corners(seed: number): Ball[] {
    const random = (k: number) => Math.abs((Math.sin(seed * 12.9898 + k * 78.233) * 43758.5453) % 1),
        low = [0, 1, 2].map((k) => -100 * random(k)),
        high = low.map((value, k) => value + 20 + 80 * random(k + 7));
    return [0, 1, 2, 3, 4, 5, 6, 7].map((n) => ({
        at: [0, 1, 2].map((k) => ((n >> k) & 1 ? high[k] : low[k])) as Triple,
        radius: 0,
    }));
}

function freeOf([width, height]: [number, number], cut = 0): FreePart {
    return { width, height, left: cut * width, right: 0, top: 0, bottom: 2 * cut * height };
}

function check(balls: Ball[], free: FreePart, sight: { azimuth: number; elevation: number }, orthographic: boolean) {
    const camera = fitted(balls, { ...sight, orthographic }, free),
        left = (2 * free.left) / free.width - 1,
        right = 1 - (2 * free.right) / free.width,
        bottom = (2 * free.bottom) / free.height - 1,
        top = 1 - (2 * free.top) / free.height;
    let fill = 0;
    for (const { at } of balls) {
        const [x, y] = seenAt(at, camera, free, orthographic),
            told = `${JSON.stringify(free)} ${JSON.stringify(sight)}: ${x} ${y}`;
        assert.ok(x > left && x < right && y > bottom && y < top, `outside: ${told}`);
        const share = (value: number, low: number, high: number) => Math.abs((2 * value - low - high) / (high - low));
        fill = Math.max(fill, share(x, left, right), share(y, bottom, top));
    }
    return fill;
}

test("all corners of a world are seen at every aspect ratio, from every named view", () => {
    for (let seed = 1; seed <= 20; ++seed)
        for (const picture of PICTURES)
            for (const cut of [0, 0.15])
                for (const name of NAMED_VIEWS)
                    for (const flat of [false, true]) {
                        const fill = check(corners(seed), freeOf(picture, cut), DIRECTIONS[name], flat);
                        assert.ok(fill > 0.8, `the picture is used: ${fill} of it, ${picture}, ${name}`);
                    }
});

test("a ball is inside with all of its surface", () => {
    const ball: Ball = { at: [3, -2, 5], radius: 4 },
        free = freeOf([390, 844]),
        surface = Array.from({ length: 400 }, (_, k): Ball => {
            const z = 1 - (2 * (k + 0.5)) / 400,
                flat = Math.sqrt(1 - z * z);
            return { at: [3 + 4 * flat * Math.cos(k), -2 + 4 * flat * Math.sin(k), 5 + 4 * z], radius: 0 };
        });
    const camera = fitted([ball], { azimuth: 1, elevation: 0.6, orthographic: false }, free);
    for (const { at } of surface) {
        const [x, y] = seenAt(at, camera, free, false);
        assert.ok(Math.abs(x) < 1 && Math.abs(y) < 1, `${x} ${y}`);
    }
});

function thing(x: number, radius: number, isFlat = false): Thing {
    return { balls: [{ at: [x, 0, 0], radius }], centre: [x, 0, 0], radius, isFlat };
}

test("one outlier far away is left out, a world of two things is not", () => {
    const near = [0, 1, 2, 3, 4].map((x) => thing(x, 0.5));
    assert.equal(worthSeeing([...near, thing(5000, 1)]).length, 5);
    assert.equal(worthSeeing([...near, thing(20, 1)]).length, 6, "what lies a little farther counts");
    assert.equal(worthSeeing([thing(0, 1), thing(5000, 1)]).length, 2);
});

test("a ground is left out, a hall of walls is not", () => {
    assert.equal(worthSeeing([thing(0, 1), thing(0, 500, true)]).length, 1);
    assert.equal(worthSeeing([thing(0, 10), thing(0, 14, true)]).length, 2);
    assert.equal(worthSeeing([thing(0, 500, true)]).length, 1, "a ground alone is the world");
});

test("what lies over the picture cuts it at one side", () => {
    const area = { left: 0, right: 1000, top: 0, bottom: 500 };
    assert.deepEqual(beside(area, { left: 0, right: 200, top: 0, bottom: 500 }), { ...area, left: 200 });
    assert.deepEqual(beside(area, { left: 0, right: 1000, top: 400, bottom: 600 }), { ...area, bottom: 400 });
    assert.deepEqual(beside(area, { left: 1000, right: 1200, top: 0, bottom: 500 }), area, "beside it");
    assert.deepEqual(beside(area, { left: 0, right: 1000, top: 0, bottom: 500 }), area, "a dialog over all of it");
});

test("the file's camera looks from its place along its x axis", () => {
    const half = Math.PI / 8; // 45 degrees down about y
    const camera = wordsOfCamera(
        { name: "c", frame: [-10, 0, 10, Math.cos(half), 0, Math.sin(half), 0], orthographic: false },
        20,
    );
    assert.ok(Math.hypot(...camera.target) < 1e-9, `${camera.target}`);
    assert.ok(Math.abs(camera.distance - Math.hypot(10, 10)) < 1e-9);
    assert.ok(Math.abs(camera.elevation - Math.PI / 4) < 1e-9 && Math.abs(Math.abs(camera.azimuth) - Math.PI) < 1e-9);
});

test("views cover the picture and each point belongs to one", () => {
    for (const [width, height] of PICTURES)
        for (const count of [1, 2, 4] as const) {
            const views = viewports(count, width, height),
                area = views.reduce((sum, view) => sum + view.width * view.height, 0);
            assert.equal(Math.round(area), width * height);
            views.forEach((view, k) =>
                assert.equal(viewAt(views, view.left + view.width / 2, view.top + view.height / 2), k),
            );
        }
});

test("a lidar of 64 rows is thinned evenly to the stated number", () => {
    const lidar = { samples: 1024, vertical_samples: 64 } as SensorInfo,
        count = 64 * 1024;
    for (const most of [720, 12_000]) {
        const drawn = thinned(lidar, count, most),
            kept = Array.from({ length: count }, (_, k) => k).filter(drawn),
            rows = new Set(kept.map((k) => Math.floor(k / 1024)));
        assert.ok(kept.length <= most && kept.length > most / 4, `${kept.length} of ${most}`);
        assert.ok(rows.size > 5 && kept.length / rows.size > 5, `${rows.size} rows`);
    }
    assert.ok(thinned({ samples: 360 } as SensorInfo, 360, 720)(359), "a small one is drawn whole");
});
