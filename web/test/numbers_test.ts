// Own numbers of robots as people write them, and the orders that set them and take that back.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
    numberOf,
    numbersAction,
    numberText,
    ownAt,
    ownCount,
    placesOf,
    samePlace,
    withPartners,
} from "../src/model/numbers";
import { surroundingsRows } from "../src/model/surroundings";
import type { JointInfo } from "../src/wire/messages";
import type { NumberRow, OwnNumbers } from "../src/wire/numbers";
import { IDENTITY, typeOf } from "./support";

const row = (name: string, value: number | null, endless = false): NumberRow => ({ name, unit: "", value, endless });
const LIMITS = [row("lower", null, true), row("upper", 2, true), row("damping", 0.1)];

test("a field takes numbers, and no bound where there may be none", () => {
    assert.equal(numberOf(" 0.25 ", row("damping", 0)), 0.25);
    assert.equal(numberOf("-1e-3", row("lower", 0, true)), -0.001);
    assert.equal(numberOf("0", row("damping", 1)), 0);
    assert.equal(numberOf("∞", row("max_effort", 1, true)), null);
    assert.equal(numberOf("inf", row("upper", 1, true)), null);
    assert.equal(numberOf("-Infinity", row("lower", 1, true)), null);
    for (const text of ["", " ", "0.4 N", "0,4", "nan", "--1", "∞"])
        assert.equal(numberOf(text, row("damping", 1)), undefined, text);
    assert.equal(numberOf("-∞", row("upper", 1, true)), undefined, "an upper limit is endless upwards");
    assert.equal(numberOf("∞", row("lower", 1, true)), undefined);
});

test("what a field shows is what it takes", () => {
    for (const one of [row("damping", 0.1 + 0.2), row("mass", 12), row("lower", null, true), row("upper", null, true)])
        assert.equal(numberText({ name: one.name, value: numberOf(numberText(one), one) ?? null }), numberText(one));
    assert.equal(numberText(row("damping", 0.1 + 0.2)), "0.3", "not its last bits");
    assert.equal(numberText(row("armature", 1.5e-9)), "1.5e-9");
});

test("limits come together, and so do the numbers of an inertia; others come alone", () => {
    assert.deepEqual(withPartners({ upper: 1 }, LIMITS), { upper: 1, lower: null });
    assert.deepEqual(withPartners({ damping: 1 }, LIMITS), { damping: 1 });
    const inertia = ["xx", "yy", "zz", "xy", "xz", "yz"].map((axes, k) => row(`inertia_${axes}`, k + 1));
    assert.deepEqual(withPartners({ inertia_xx: 7, mass: 2 }, [row("mass", 1), ...inertia]), {
        inertia_xx: 7,
        mass: 2,
        inertia_yy: 2,
        inertia_zz: 3,
        inertia_xy: 4,
        inertia_xz: 5,
        inertia_yz: 6,
    });
    assert.deepEqual(withPartners({}, LIMITS), {}, "of nothing, nothing");
});

test("orders name the axis or the link", () => {
    assert.deepEqual(numbersAction({ joint: 2, axis: 1 }, { damping: 1 }, false), {
        action: "joint_parameters",
        joint: 2,
        axis: 1,
        values: { damping: 1 },
        reset: false,
    });
    assert.deepEqual(numbersAction({ link: 3 }, {}, true), {
        action: "link_parameters",
        link: 3,
        values: {},
        reset: true,
    });
});

test("what a robot has of its own is found by its place", () => {
    const own: OwnNumbers = {
        joints: [
            { joint: 0, axis: 0, values: { damping: 0.4 } },
            { joint: 0, axis: 1, values: { lower: null, upper: 2 } },
        ],
        links: [{ link: 0, values: { mass: 3 } }],
    };
    assert.deepEqual(ownAt(own, { joint: 0, axis: 1 }), { lower: null, upper: 2 });
    assert.deepEqual(ownAt(own, { link: 0 }), { mass: 3 });
    assert.deepEqual(ownAt(own, { joint: 1, axis: 0 }), {});
    assert.deepEqual(ownAt(undefined, { link: 0 }), {});
    assert.equal(ownCount(own), 4);
    assert.equal(ownCount(undefined), 0);
    assert.equal(samePlace({ link: 0 }, { joint: 0, axis: 0 }), false);
});

test("gravity and wind are those of the file where the robot has none of its own", () => {
    const file = { gravity: [0, 0, -9.8] as [number, number, number] },
        row = (name: string, value: number) => ({ name, unit: name.startsWith("wind") ? "m/s" : "m/s^2", value });
    assert.deepEqual(surroundingsRows(undefined, file), [
        row("gravity_x", 0),
        row("gravity_y", 0),
        row("gravity_z", -9.8),
        row("wind_x", 0),
        row("wind_y", 0),
        row("wind_z", 0),
    ]);
    assert.deepEqual(surroundingsRows({ gravity: [0.5, 0, -1.62] }, { ...file, wind: [3, 0, -1] }), [
        { ...row("gravity_x", 0.5), file: 0 },
        row("gravity_y", 0),
        { ...row("gravity_z", -1.62), file: -9.8 },
        row("wind_x", 3),
        row("wind_y", 0),
        row("wind_z", -1),
    ]);
    const calm = surroundingsRows({ wind: [0, 0, 0] }, { ...file, wind: [3, 0, 0] });
    assert.deepEqual(calm[3], { ...row("wind_x", 0), file: 3 }, "still air is an own wind, too");
});

test("components of gravity are ordered together, and those of the wind", () => {
    const rows = surroundingsRows({ gravity: [0.5, 0, -1.62] }, { gravity: [0, 0, -9.8], wind: [3, 0, -1] }),
        order = (values: Record<string, number>, reset = false) =>
            numbersAction("surroundings", withPartners(values, rows), reset);
    assert.deepEqual(order({ gravity_y: 2 }), { action: "surroundings", reset: false, gravity: [0.5, 2, -1.62] });
    assert.deepEqual(order({ wind_z: 0 }), { action: "surroundings", reset: false, wind: [3, 0, 0] });
    assert.deepEqual(order({ gravity_x: 1, wind_x: 2 }), {
        action: "surroundings",
        reset: false,
        gravity: [1, 0, -1.62],
        wind: [2, 0, -1],
    });
    assert.deepEqual(order({}, true), { action: "surroundings", reset: true }, "all are those of the file again");
});

test("own gravity and own wind count as one number each, and are given back as they were", () => {
    const own: OwnNumbers = { gravity: [0, 0, -1.62], links: [{ link: 0, values: { mass: 3 } }] };
    assert.equal(ownCount(own), 2);
    assert.equal(ownCount({ ...own, wind: [0, 0, 0] }), 3);
    assert.deepEqual(ownAt(own, "surroundings"), { gravity_x: 0, gravity_y: 0, gravity_z: -1.62 });
    assert.deepEqual(ownAt({ links: own.links }, "surroundings"), {});
    assert.deepEqual(numbersAction("surroundings", ownAt(own, "surroundings"), true), {
        action: "surroundings",
        reset: true,
        gravity: [0, 0, -1.62],
    });
    assert.equal(samePlace("surroundings", "surroundings"), true);
    assert.equal(samePlace("surroundings", { link: 0 }), false);
});

test("each axis of a joint is a place, and each link, beside gravity and wind", () => {
    const joint = (name: string, axes: number) => ({ name, axes }) as unknown as JointInfo,
        link = (name: string) => ({ name, body: 0, frame: IDENTITY, visuals: [], collisions: [] }),
        joints = [joint("hinge", 1), joint("weld", 0), joint("cardan", 2)];
    assert.deepEqual(placesOf(typeOf([], [], { joints, links: [link("base"), link("arm")] })), [
        { name: "gravity and wind", kind: "robot", place: "surroundings" },
        { name: "hinge", kind: "joint", place: { joint: 0, axis: 0 } },
        { name: "cardan 1", kind: "joint", place: { joint: 2, axis: 0 } },
        { name: "cardan 2", kind: "joint", place: { joint: 2, axis: 1 } },
        { name: "base", kind: "link", place: { link: 0 } },
        { name: "arm", kind: "link", place: { link: 1 } },
    ]);
});
