import assert from "node:assert/strict";
import { test } from "node:test";
import {
    composed,
    fromAxisAngle,
    inverse,
    slerp,
    toRollPitchYaw,
    transform,
    writeMatrix,
} from "../src/kinematics/pose";
import { close } from "./support";

const POSE = composed(
    [1, 2, 3, 1, 0, 0, 0],
    composed(fromAxisAngle([0, 0, 1], 0.6), composed(fromAxisAngle([0, 1, 0], -0.3), fromAxisAngle([1, 0, 0], 0.9))),
);

test("a pose and its inverse undo each other", () => {
    assert.equal(close(composed(POSE, inverse(POSE)), [0, 0, 0, 1, 0, 0, 0], 1e-12), "");
});

test("the matrix moves points as the pose does", () => {
    const matrix = new Float32Array(16),
        p = [0.5, -1.5, 2];
    writeMatrix(matrix, 0, POSE, 0);
    const moved = [0, 1, 2].map(
        (row) => matrix[row] * p[0] + matrix[4 + row] * p[1] + matrix[8 + row] * p[2] + matrix[12 + row],
    );
    assert.equal(close(moved, transform(POSE, p), 1e-5), "");
});

test("roll, pitch and yaw are those that made the rotation", () => {
    assert.equal(close(toRollPitchYaw(POSE), [0.9, -0.3, 0.6], 1e-12), "");
});

test("between two rotations the way is even and the shorter one, whatever their signs", () => {
    const out = [0, 0, 0, 0],
        from = [1, 0, 0, 0],
        to = fromAxisAngle([0, 0, 1], 2).slice(3);
    slerp(
        out,
        0,
        from,
        0,
        to.map((value) => -value),
        0,
        0.25,
    );
    assert.equal(close(out, [Math.cos(0.25), 0, 0, Math.sin(0.25)], 1e-12), "");
    slerp(out, 0, from, 0, [1, 0, 0, 1e-5], 0, 0.5);
    assert.equal(close(out, [1, 0, 0, 5e-6], 1e-9), "");
});
