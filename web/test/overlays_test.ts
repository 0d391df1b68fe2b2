import assert from "node:assert/strict";
import { test } from "node:test";
import { beamDirection } from "../src/overlays/beams";
import { convexHull, hullAround } from "../src/overlays/hull";
import { close, IDENTITY } from "./support";

const LASER = {
    name: "scan",
    kind: "laser",
    link: 0,
    frame: IDENTITY,
    samples: 3,
    min_angle: -Math.PI / 2,
    max_angle: Math.PI / 2,
    vertical_samples: 2,
    vertical_min_angle: 0,
    vertical_max_angle: Math.PI / 2,
};

test("beams run from the least angle to the greatest, row by row upwards", () => {
    assert.equal(close(beamDirection(LASER, 0), [0, -1, 0], 1e-12), "");
    assert.equal(close(beamDirection(LASER, 1), [1, 0, 0], 1e-12), "");
    assert.equal(close(beamDirection(LASER, 2), [0, 1, 0], 1e-12), "");
    assert.equal(close(beamDirection(LASER, 4), [0, 0, 1], 1e-12), "");
});

test("a hull holds its corners and leaves out what lies inside", () => {
    const square = [
        [0, 0],
        [2, 0],
        [2, 2],
        [0, 2],
        [1, 1],
        [1, 0],
    ].map(([x, y]) => ({ x, y }));
    assert.deepEqual(
        convexHull(square)
            .map(({ x, y }) => `${x} ${y}`)
            .sort(),
        ["0 0", "0 2", "2 0", "2 2"],
    );
});

test("the hull round discs is as wide as they reach", () => {
    const hull = hullAround([
        { x: 0, y: 0, radius: 1 },
        { x: 5, y: 0, radius: 0.5 },
    ]);
    assert.ok(Math.abs(Math.min(...hull.map((p) => p.x)) + 1) < 0.03);
    assert.ok(Math.abs(Math.max(...hull.map((p) => p.x)) - 5.5) < 1e-9);
});
