import assert from "node:assert/strict";
import { test } from "node:test";
import { append } from "../src/model/plotted";
import { perceived, readings } from "../src/model/readings";
import { sliderRange } from "../src/panels/joint_controls";
import { StepTimes } from "../src/panels/cluster_panel";
import type { JointInfo, RobotReport } from "../src/wire/messages";
import { IDENTITY, typeOf } from "./support";

const JOINT: JointInfo = {
    name: "elbow",
    kind: "revolute",
    body: 0,
    axes: 1,
    units: ["rad"],
    q: 0,
    lower: [-1],
    upper: [2],
    max_effort: [5],
    max_velocity: [null],
};
const REPORT: RobotReport = {
    type: "robot",
    scene: 1,
    robot: 0,
    tick: 1,
    time: 0.002,
    pose: [1, 2, 3, Math.SQRT1_2, 0, 0, Math.SQRT1_2],
    linear: [3, 4, 0],
    angular: [0, 0, 1],
    joints: [{ position: [0.5], velocity: [-1], motors: [{ mode: "velocity", target: 1, effort: 0.25 }] }],
    sensors: [{ ranges: [null, 2.5, 1.25] }, { position: [52, 21, 100], geodetic: true }, null],
    contacts: [],
};

test("every number of a report has a key, a unit and its value", () => {
    const sensors = ["scan", "gps", "odometer"].map((name) => ({ name, kind: name, link: 0, frame: IDENTITY }));
    const all = readings(typeOf([], [], { joints: [JOINT], sensors }), REPORT),
        flat = [...all.base, ...all.joints, ...all.sensors.flat()];
    const value = (key: string) => flat.find((one) => one.key === key)?.value;
    assert.equal(value("speed"), 5);
    assert.ok(Math.abs((value("angle.yaw") ?? 0) - 90) < 1e-9);
    assert.equal(value("joint.elbow.0.effort"), 0.25);
    assert.equal(value("sensor.scan.nearest"), 1.25);
    assert.equal(value("sensor.gps.altitude"), 100);
    assert.equal(all.sensors[2].length, 0);
    assert.equal(new Set(flat.map((one) => one.key)).size, flat.length);
});

test("a sensor of any kind shows its numbers and vectors with their units", () => {
    const sensor = { name: "imu", kind: "imu", link: 0, frame: IDENTITY, units: { specific_force: "m/s²" } };
    const report = { ...REPORT, sensors: [{ specific_force: [0, 1, 9.8], temperature: 20, taken: 1 }] };
    const shown = readings(typeOf([], [], { joints: [JOINT], sensors: [sensor] }), report).sensors[0];
    assert.deepEqual(
        shown.map((one) => [one.label, one.unit, one.value]),
        [
            ["imu specific_force x", "m/s²", 0],
            ["imu specific_force y", "m/s²", 1],
            ["imu specific_force z", "m/s²", 9.8],
            ["imu temperature", "", 20],
        ],
    );
});

test("what a logical camera sees has its distance, what a microphone hears its volume", () => {
    assert.deepEqual(perceived({ names: ["wall", "car"], models: [-1, 2], positions: [3, 4, 0, 0, 0, null] }), [
        { name: "wall", value: 5, unit: "m" },
        { name: "car", value: null, unit: "m" },
    ]);
    assert.deepEqual(perceived({ sources: ["horn/source_1"], volumes: [0.5] }), [
        { name: "horn/source_1", value: 0.5, unit: "" },
    ]);
    assert.equal(perceived({ ranges: [1, 2, 3] }), null);
});

test("a curve forgets what a rewind undid", () => {
    const curve = { times: [] as number[], values: [] as (number | null)[] };
    for (const time of [1, 2, 3, 2.5]) append(curve, time, time * 10);
    assert.deepEqual(curve, { times: [1, 2, 2.5], values: [10, 20, 25] });
});

test("a joint's slider spans its limits, or what is usual where it has none", () => {
    assert.deepEqual(sliderRange(JOINT, 0, "position"), [-1, 2]);
    assert.deepEqual(sliderRange(JOINT, 0, "effort"), [-5, 5]);
    assert.deepEqual(sliderRange(JOINT, 0, "velocity"), [-20, 20]);
});

test("the step times of a Simulator that comes later start where it came, those of a lost one end", () => {
    const times = new StepTimes(),
        member = (id: number, step_us: number, state = "active") => ({
            id,
            name: "",
            threads: 1,
            robots: 1,
            islands: 1,
            load: 1,
            step_us,
            state,
        });
    times.take(0, [member(1, 10)]);
    times.take(1, [member(1, 11, "lost"), member(2, 20)]);
    assert.deepEqual(times.times, [0, 1]);
    assert.deepEqual(
        [...times.columns],
        [
            [1, [10, null]],
            [2, [null, 20]],
        ],
    );
});

test("a contact sensor shows the sum of its forces, whatever the number of points", () => {
    const sensor = { name: "bumper", kind: "contact", link: 0, frame: IDENTITY, units: {} },
        shown = (forces: number[]) =>
            readings(typeOf([], [], { joints: [JOINT], sensors: [sensor] }), {
                ...REPORT,
                sensors: [{ positions: forces, normals: forces, forces, others: [] }],
            }).sensors[0].map((one) => [one.label, one.unit, one.value]);
    assert.deepEqual(shown([0, 0, 2, 3, 0, 2]), [
        ["bumper force", "N", 5],
        ["bumper force x", "N", 3],
        ["bumper force y", "N", 0],
        ["bumper force z", "N", 4],
        ["bumper points", "", 2],
    ]);
    assert.deepEqual(shown([0, 0, 7])[0], ["bumper force", "N", 7]);
    assert.deepEqual(shown([])[0], ["bumper force", "N", 0]);
});
