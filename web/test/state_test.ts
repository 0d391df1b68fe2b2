import assert from "node:assert/strict";
import { test } from "node:test";
import { Snapshot } from "../src/model/snapshot";
import { readHeader, readState } from "../src/wire/state";
import { body, close, fleetOf, stateBytes, typeOf } from "./support";

const CAR = typeOf([body("free", -1, 0), body("revolute", 0, 0), body("revolute", 0, 1)], [Math.PI, Math.PI]);
const LIFT = typeOf([body("prismatic", -1, 0)], [2.5], { free_base: false });

test("a State puts base poses and joint coordinates where the robot's numbers lie", () => {
    const fleet = fleetOf([CAR, LIFT], [0, 1, 0]),
        snapshot = new Snapshot(fleet);
    const half = Math.SQRT1_2;
    const header = readState(
        stateBytes(
            1.5,
            [
                { robot: 2, place: [1, -2, 0.25], turn: [half, 0, 0, half], coordinates: [16384, -32767] },
                { robot: 1, place: [5, 6, 7], turn: [1, 0, 0, 0], coordinates: [32767] },
            ],
            1,
        ),
        fleet,
        snapshot,
    );
    assert.deepEqual(
        [header.whole, header.resting, header.time, header.tick, header.robots],
        [true, false, 1.5, 750, 2],
    );
    assert.equal(close(snapshot.base.subarray(14, 21), [1, -2, 0.25, half, 0, 0, half], 5e-5), "");
    assert.equal(close(snapshot.joints, [0, 0, 2.5, Math.PI / 2, -Math.PI], 2e-4), "");
    assert.deepEqual([...snapshot.moved], [0, 1, 1]);
});

test("orientations come back as unit quaternions although 16 bits round them", () => {
    const fleet = fleetOf([CAR], [0]),
        snapshot = new Snapshot(fleet);
    readState(
        stateBytes(0, [{ robot: 0, place: [0, 0, 0], turn: [0.5, -0.5, 0.5, 0.5], coordinates: [0, 0] }]),
        fleet,
        snapshot,
    );
    assert.ok(Math.abs(Math.hypot(...snapshot.base.subarray(3, 7)) - 1) < 1e-6);
});

test("a State that is cut short, too long, of an unknown robot or kind is refused with its reason", () => {
    const fleet = fleetOf([CAR], [0]),
        entry = {
            robot: 0,
            place: [0, 0, 0] as [number, number, number],
            turn: [1, 0, 0, 0] as [number, number, number, number],
            coordinates: [0, 0],
        };
    const whole = stateBytes(0, [entry]),
        read = (data: DataView) => readState(data, fleet, new Snapshot(fleet));
    assert.throws(() => read(new DataView(whole.buffer, 0, 20)), /too short/);
    assert.throws(() => read(new DataView(whole.buffer, 0, 40)), RangeError);
    assert.throws(() => read(stateBytes(0, [{ ...entry, coordinates: [0, 0, 0] }])), /bytes/);
    assert.throws(() => read(stateBytes(0, [{ ...entry, robot: 9 }])), /robot 9/);
    whole.setUint8(0, 7);
    assert.throws(() => readHeader(whole), /kind 7/);
});
