import assert from "node:assert/strict";
import { test } from "node:test";
import { csvOf, formatPlots, parsePlots, tableOf, turnOf, unwrapped } from "../src/model/plot_data";

const curve = (robotName: string, times: number[], values: (number | null)[], key = "speed", unit = "m/s") => ({
    robotName,
    key,
    label: key,
    unit,
    times,
    values,
});

test("angles that wrap are unwrapped, others are left alone", () => {
    assert.deepEqual(unwrapped([170, 179, -179, -170, null, 175], 360), [170, 179, 181, 190, null, 175]);
    assert.deepEqual(unwrapped([-179, 179, -179], 360), [-179, -181, -179]);
    assert.deepEqual(unwrapped([1, 100], 0), [1, 100]);
    assert.equal(turnOf({ key: "angle.yaw", unit: "°" }), 360);
    assert.equal(turnOf({ key: "sensor.imu.yaw", unit: "rad" }), 2 * Math.PI);
    assert.equal(turnOf({ key: "sensor.gps.latitude", unit: "°" }), 0);
    assert.equal(turnOf({ key: "joint.wheel.0.position", unit: "rad" }), 0);
});

test("curves of different times share a table, and become CSV with a head and quotes", () => {
    const curves = [curve("a", [1, 2], [10, 20]), curve('b, "c"', [2, 3], [5, null])];
    assert.deepEqual(tableOf(curves), [
        [1, 2, 3],
        [10, 20, null],
        [null, 5, null],
    ]);
    assert.equal(csvOf(curves), 'time [s],a speed [m/s],"b, ""c"" speed [m/s]"\n1,10,\n2,20,5\n3,,\n');
});

test("plots are written into a link and read from it; what makes no sense is left out", () => {
    const plots = [[curve("car_1", [], []), curve("car_2", [], [])], [curve("car_1", [], [], "angle.yaw", "°")]];
    const text = formatPlots(plots),
        names = ({ robotName, key, label, unit }: (typeof plots)[0][0]) => ({ robotName, key, label, unit });
    assert.deepEqual(
        parsePlots(text),
        plots.map((one) => one.map(names)),
    );
    assert.deepEqual(parsePlots("nonsense;~~~;a~b"), []);
});
