import assert from "node:assert/strict";
import { test } from "node:test";
import { bodyAt, placeBodies } from "../src/kinematics/tree";
import type { PoseArray, TypeInfo } from "../src/wire/messages";
import { body, close, IDENTITY, typeOf } from "./support";

function placed(type: TypeInfo, base: PoseArray, q: number[], which: number): number[] {
    const out = new Float64Array((type.bodies.length + 1) * 7);
    placeBodies(type, base, 0, q, 0, out);
    return [...out.subarray(bodyAt(which), bodyAt(which) + 7)];
}

const HALF = Math.SQRT1_2;

test("a wheel stands where the chassis carries it, turned about its axle", () => {
    const car = typeOf(
        [body("free", -1, 0), body("revolute", 0, 0, { frame: [0.15, 0.13, -0.03, 1, 0, 0, 0], axis: [0, 1, 0] })],
        [Math.PI],
    );
    const base: PoseArray = [10, 20, 0.08, HALF, 0, 0, HALF]; // a quarter turn about z: x points along y
    const wheel = placed(car, base, [Math.PI / 2], 1);
    assert.equal(close(wheel, [10 - 0.13, 20 + 0.15, 0.05], 1e-12), "");
    // q = rz(90) * ry(90) = (1/2, -1/2, 1/2, 1/2)
    assert.equal(close(wheel.slice(3), [0.5, -0.5, 0.5, 0.5], 1e-12), "");
});

test("an arm of two revolute joints reaches where trigonometry says", () => {
    const arm = typeOf(
        [
            body("revolute", -1, 0, { frame: [0, 0, 1, 1, 0, 0, 0] }),
            body("revolute", 0, 1, { frame: [2, 0, 0, 1, 0, 0, 0] }),
            body("prismatic", 1, 2, { frame: [1, 0, 0, 1, 0, 0, 0], axis: [1, 0, 0] }),
        ],
        [Math.PI, Math.PI, 1],
        { free_base: false },
    );
    const [a, b, way] = [0.7, -0.4, 0.25],
        tip = placed(arm, IDENTITY, [a, b, way], 2);
    const expected = [2 * Math.cos(a) + 1.25 * Math.cos(a + b), 2 * Math.sin(a) + 1.25 * Math.sin(a + b), 1];
    assert.equal(close(tip, [...expected, Math.cos((a + b) / 2), 0, 0, Math.sin((a + b) / 2)], 1e-12), "");
});

test("a screw goes its pitch for each radian that it turns", () => {
    const screw = typeOf([body("screw", -1, 0, { axis: [0, 0, 1], slide: 0.02 })], [Math.PI], { free_base: false });
    assert.equal(
        close(placed(screw, IDENTITY, [1.5], 0), [0, 0, 0.03, Math.cos(0.75), 0, 0, Math.sin(0.75)], 1e-12),
        "",
    );
});

test("a ball joint turns as its quaternion says, on the end of what carries it", () => {
    const ball = typeOf(
        [body("revolute", -1, 0), body("ball", 0, 1, { frame: [1, 0, 0, 1, 0, 0, 0] })],
        [Math.PI, 1, 1, 1, 1],
        { free_base: false },
    );
    const pose = placed(ball, IDENTITY, [Math.PI / 2, HALF, HALF, 0, 0], 1);
    // rz(90) * rx(90) = (1/2, 1/2, 1/2, 1/2)
    assert.equal(close(pose, [0, 1, 0, 0.5, 0.5, 0.5, 0.5], 1e-12), "");
});

test("links welded to a fixed base stand at the base frame", () => {
    const post = typeOf([body("revolute", -1, 0)], [Math.PI], { free_base: false });
    assert.equal(close(placed(post, [1, 2, 3, HALF, 0, HALF, 0], [1], -1), [1, 2, 3, HALF, 0, HALF, 0], 1e-12), "");
});
