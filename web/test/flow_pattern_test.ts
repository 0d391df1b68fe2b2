// Marks on moving surfaces lie where the surface turns or runs, and go exactly as fast.
import assert from "node:assert/strict";
import { test } from "node:test";
import { flowOf, FlowPhase, rowsOf, shapeIn } from "../src/overlays/flow_pattern";
import type { Triple, Visual } from "../src/wire/messages";
import { close, IDENTITY } from "./support";

const NONE: Triple = [0, 0, 0];
const box = (size: Triple): Visual => ({ name: "box", shape: "box", size, frame: IDENTITY });
const roller: Visual = { name: "roller", shape: "cylinder", radius: 0.05, length: 0.2, frame: [1, 0, 2, 1, 0, 0, 0] };

test("a straight belt goes straight", () => {
    const flow = flowOf({ linear: [0.5, 0, 0], angular: NONE, belt: NONE }, box([3, 0.6, 0.1]));
    assert.deepEqual(flow.linear, [0.5, 0, 0]);
    assert.deepEqual(flow.angular, NONE);
});

test("a turn that is not about the link's origin has its axis where nothing moves", () => {
    // About (0, 2, 0) with 3 rad/s: at the origin v = w x (p - c) = (0, 0, 3) x (0, -2, 0) = (6, 0, 0).
    const flow = flowOf({ linear: [6, 0, 0], angular: [0, 0, 3] }, box([1, 1, 1]));
    assert.equal(close(flow.at, [0, 2, 0], 1e-12), "");
    assert.deepEqual(flow.linear, NONE);
    const elsewhere = flowOf({ linear: NONE, angular: [0, 0, 3] }, box([1, 1, 1]), [4, 5, 6]);
    assert.deepEqual(elsewhere.at, [4, 5, 6]);
});

test("a belt around a roller turns it: its surface goes as fast as the belt", () => {
    const flow = flowOf({ linear: NONE, angular: NONE, belt: [0, 0.4, 0] }, roller);
    assert.equal(close(flow.angular, [0, 8, 0], 1e-12), "");
    assert.deepEqual(flow.at, [1, 0, 2]);
    const flat = flowOf({ linear: NONE, angular: NONE, belt: [0, 0.4, 0] }, box([3, 0.6, 0.1]));
    assert.deepEqual(flat.belt, [0, 0.4, 0], "on a flat belt it is a straight motion of each face");
});

test("marks have gone as far as the surface, back and forth", () => {
    const flow = flowOf({ linear: [0.5, 0, 0], angular: NONE }, box([3, 0.6, 0.1])),
        phase = new FlowPhase();
    for (let k = 0; k < 60; ++k) phase.advance(flow, 1 / 30, 0.3);
    assert.equal(close(phase.moved, [1, 0, 0], 1e-9), "");
    phase.advance(flow, -2, 0.3);
    assert.equal(close(phase.moved, [0, 0, 0], 1e-9), "", "time was turned back");
});

test("over hours the way stays short, by whole marks", () => {
    const flow = flowOf({ linear: [0, 7, 0], angular: NONE }, box([3, 0.6, 0.1])),
        phase = new FlowPhase();
    for (let k = 0; k < 36_000; ++k) phase.advance(flow, 0.1, 0.3);
    assert.ok(Math.hypot(...phase.moved) <= 31, String(phase.moved));
    const over = (25_200 - phase.moved[1]) / 0.3;
    assert.ok(Math.abs(over - Math.round(over)) < 1e-4, `${over} marks were left out`);
    const turn = new FlowPhase();
    turn.advance(flowOf({ linear: NONE, angular: [0, 0, 2] }, box([1, 1, 1])), Math.PI * 1.25, 0.3);
    assert.ok(Math.abs(turn.angle - Math.PI / 2) < 1e-9, "the angle stays within a turn");
});

test("whole rows fill a belt, and whole rings a disc", () => {
    assert.deepEqual(rowsOf(box([5, 0.2, 0.1])), { pitch: 0.2, rows: 1, side: 0.2, sides: 1 });
    const wide = rowsOf(box([5, 2, 0.1]));
    assert.equal(wide.rows, 5);
    assert.ok(Math.abs(wide.pitch * wide.rows - 2) < 1e-12);
    const disc = rowsOf({ ...roller, radius: 0.8, length: 0.1 });
    assert.deepEqual([disc.pitch, disc.rows, disc.side, disc.sides], [0.4, 2, 0.1, 1]);
});

test("scenery that a robot's link drives is placed in the frame of that link", () => {
    const s = Math.SQRT1_2,
        link = [1, 2, 3, s, 0, 0, s], // a quarter turn to the left
        shape = shapeIn(link, { ...box([1, 1, 1]), frame: [1, 4, 3, s, 0, 0, s] });
    assert.equal(close(shape.frame, [2, 0, 0, 1, 0, 0, 0], 1e-12), "");
});
