import assert from "node:assert/strict";
import { test } from "node:test";
import { betweenAngles, History } from "../src/model/history";
import { readState } from "../src/wire/state";
import { body, fleetOf, stateBytes, typeOf } from "./support";

const CAR = typeOf([body("free", -1, 0), body("revolute", 0, 0)], [Math.PI]);

function hear(
    history: History,
    fleet: ReturnType<typeof fleetOf>,
    time: number,
    robots: { robot: number; x: number; angle?: number }[],
): void {
    const entries = robots.map(({ robot, x, angle }) => ({
        robot,
        place: [x, 0, 0] as [number, number, number],
        turn: [1, 0, 0, 0] as [number, number, number, number],
        coordinates: [Math.round(((angle ?? 0) / Math.PI) * 32767)],
    }));
    readState(stateBytes(time, entries), fleet, history.next());
    history.take();
}

test("between two States a robot is where a steady motion would have it", () => {
    const fleet = fleetOf([CAR], [0, 0]),
        history = new History(fleet);
    hear(history, fleet, 1.0, [
        { robot: 0, x: 0 },
        { robot: 1, x: 9 },
    ]);
    hear(history, fleet, 1.1, [{ robot: 0, x: 1 }]);
    history.sample(1.025);
    assert.ok(Math.abs(history.drawn.base[0] - 0.25) < 1e-6);
    assert.ok(Math.abs(history.drawn.time - 1.025) < 1e-12);
});

test("a robot that no State tells of stays where it was", () => {
    const fleet = fleetOf([CAR], [0, 0]),
        history = new History(fleet);
    hear(history, fleet, 1.0, [
        { robot: 0, x: 0 },
        { robot: 1, x: 9 },
    ]);
    for (let k = 1; k < 12; ++k) hear(history, fleet, 1 + k * 0.1, [{ robot: 0, x: k }]);
    history.sample(2.1);
    assert.equal(history.drawn.base[7], 9);
    history.sample(2.1);
    assert.deepEqual([...history.changed], [0, 0]);
});

test("a wheel that passes the half turn goes on forwards", () => {
    assert.ok(Math.abs(betweenAngles(3.1, -3.1, 0.5) - (3.1 + (2 * Math.PI - 6.2) / 2)) < 1e-12);
    assert.ok(Math.abs(betweenAngles(-3.1, 3.1, 1) - (-3.1 - (2 * Math.PI - 6.2))) < 1e-12);
});

test("a rewind forgets what lay behind it, and draws the new State at once", () => {
    const fleet = fleetOf([CAR], [0]),
        history = new History(fleet);
    hear(history, fleet, 5.0, [{ robot: 0, x: 50 }]);
    hear(history, fleet, 5.1, [{ robot: 0, x: 51 }]);
    hear(history, fleet, 2.0, [{ robot: 0, x: 20 }]);
    history.sample(5.05);
    assert.equal(history.drawn.base[0], 20);
    assert.equal(history.drawn.time, 2);
});

test("an order while the run is paused shows although the time stands", () => {
    const fleet = fleetOf([CAR], [0]),
        history = new History(fleet);
    hear(history, fleet, 1, [{ robot: 0, x: 0 }]);
    history.sample(1);
    hear(history, fleet, 1, [{ robot: 0, x: 4 }]);
    history.sample(1);
    assert.equal(history.drawn.base[0], 4);
});
