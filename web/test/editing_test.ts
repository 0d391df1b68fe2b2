// What is added has the inertia of its shape, free names, and poses as the run reads them.
import assert from "node:assert/strict";
import { test } from "node:test";
import { quaternionOf, toRollPitchYaw } from "../src/kinematics/pose";
import { poseText } from "../src/model/editing";
import { freeName } from "../src/model/names";
import { halfHeight, moments, type NewShape, shapeFault, shapeSdf } from "../src/model/new_shape";
import { basePose, framePose } from "../src/model/placing";
import { inertiaBox, principal } from "../src/overlays/inertia_box";
import type { PoseArray, TypeInfo } from "../src/wire/messages";

const near = (a: number, b: number, what = "") => assert.ok(Math.abs(a - b) < 1e-9, `${what} ${a} is not ${b}`);
const box: NewShape = { kind: "box", sizes: [0.2, 0.4, 0.6], mass: 3, colour: "#ff8000" };

test("a free name counts on", () => {
    const taken = new Set(["car", "car_1", "box_7"]);
    assert.equal(
        freeName("tree", (name) => taken.has(name)),
        "tree",
    );
    assert.equal(
        freeName("car", (name) => taken.has(name)),
        "car_2",
    );
    assert.equal(
        freeName("box_7", (name) => taken.has(name)),
        "box_1",
    );
    assert.equal(
        freeName("house::door", () => false),
        "house_door",
    );
});

test("shapes out of range are named, and those in range have the moments of their kind", () => {
    assert.equal(shapeFault(box), "");
    assert.match(shapeFault({ ...box, sizes: [0, 1, 1] }), /Sizes/);
    assert.match(shapeFault({ ...box, mass: NaN }), /mass/);
    near(moments(box)[0], (3 * (0.16 + 0.36)) / 12);
    near(moments({ ...box, kind: "sphere", sizes: [0.5] })[1], 0.4 * 3 * 0.25);
    near(moments({ ...box, kind: "cylinder", sizes: [0.5, 2] })[2], 0.5 * 3 * 0.25);
    near(halfHeight(box), 0.3);
    const text = shapeSdf(box, 'a"<b');
    assert.match(text, /<size>0.2 0.4 0.6<\/size>/);
    assert.match(text, /name="a&#34;&#60;b"/);
    assert.match(text, /<diffuse>1.0000 0.5020 0.0000 1<\/diffuse>/);
});

test("the box of equal inertia is the box, however its axes lie", () => {
    const [x, y, z] = moments(box),
        { sizes, edges } = inertiaBox(3, [x, y, z, 0, 0, 0]);
    [0.2, 0.4, 0.6].forEach((size, k) => near(sizes[k], size));
    assert.equal(edges.length, 12);
    const turned = principal([
        [2, 1, 0],
        [1, 2, 0],
        [0, 0, 5],
    ]);
    assert.deepEqual(turned.values.map((value) => Number(value.toFixed(9))).sort(), [1, 3, 5]);
});

test("poses go to text and to the base and back", () => {
    const q = quaternionOf(0.3, -0.4, 1.2),
        pose: PoseArray = [1, 2, 3, ...q],
        [roll, pitch, yaw] = toRollPitchYaw(pose);
    near(roll, 0.3);
    near(pitch, -0.4);
    near(yaw, 1.2);
    const numbers = poseText(pose).split(" ").map(Number);
    [1, 2, 3, 0.3, -0.4, 1.2].forEach((value, k) => near(numbers[k], value));
    const type = { free_base: true, origin: [0.1, 0, -0.2, ...quaternionOf(0, 0, 0.5)] } as unknown as TypeInfo;
    framePose(type, basePose(type, pose)).forEach((value, k) => near(value, pose[k], `number ${k}`));
    assert.deepEqual(basePose({ ...type, free_base: false }, pose), pose);
});
