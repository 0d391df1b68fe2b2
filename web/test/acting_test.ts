// Which command drives a robot, and what panels say of commands and bonds.
import assert from "node:assert/strict";
import { test } from "node:test";
import { driveOf, driveValues } from "../src/model/drive";
import { loadPart, loadText } from "../src/panels/bond_controls";
import { lastText, numbersOf, rowsText } from "../src/panels/channel_controls";
import type { BondReport, ChannelInfo } from "../src/wire/onboard";
import { body, typeOf } from "./support";

function channel(name: string, values: string[], list = false): ChannelInfo {
    return { name, list, values: values.map((value) => ({ name: value, unit: "" })) };
}

const TWIST = ["linear_x", "linear_y", "linear_z", "angular_x", "angular_y", "angular_z"];
const robot = (...channels: ChannelInfo[]) => typeOf([body("free", -1, 0)], [], { channels });

test("a robot is driven by its cmd_vel, whatever else it takes", () => {
    const drive = driveOf(
        robot(channel("arm/cmd_pos", ["position"]), channel("other_vel", TWIST), channel("cmd_vel", TWIST)),
    );
    assert.ok(drive !== null);
    assert.equal(drive.channel.name, "cmd_vel");
    assert.deepEqual(driveValues(drive, 1.5, -0.5), [1.5, 0, 0, 0, 0, -0.5]);
});

test("a drive is known by its values where its name says nothing", () => {
    const drive = driveOf(robot(channel("steer", ["angular", "linear"])));
    assert.ok(drive !== null);
    assert.deepEqual(driveValues(drive, 1, 2), [2, 1]);
});

test("what has no forwards or no turn drives nothing, and neither does a list", () => {
    assert.equal(driveOf(robot(channel("cmd_vel", ["linear_x"]))), null);
    assert.equal(driveOf(robot(channel("path", ["linear", "angular"], true))), null);
    assert.equal(driveOf(typeOf([body("free", -1, 0)], [])), null, "most robots take no commands at all");
});

test("the time of the last command is told in seconds", () => {
    assert.equal(lastText({ tick: 1600, values: [] }, 0.002), "last at 3.20 s");
    assert.equal(lastText({ tick: 0, values: [] }, 0.002), "last at 0.00 s");
    assert.equal(lastText({ tick: -1, values: [] }, 0.002), "no command yet");
    assert.equal(lastText(undefined, 0.002), "no command yet");
});

test("rows of a list are lines, and come back from them", () => {
    assert.equal(rowsText([1, 2, 3.5, 4], 2), "1 2\n3.5 4");
    assert.deepEqual(numbersOf("1 2\n 3.5, 4 \n"), [1, 2, 3.5, 4]);
    assert.deepEqual(numbersOf(""), [], "no rows");
    assert.equal(numbersOf("1 two"), null);
});

test("a bond says what it carries, and how near it is to letting go", () => {
    const bond: BondReport = {
        link: 0,
        other: 1,
        other_link: 0,
        force: 12,
        torque: 3,
        max_force: 50,
        max_torque: null,
    };
    assert.equal(loadText(bond), "12.0 N of 50 N");
    assert.ok(Math.abs(loadPart(bond) - 0.24) < 1e-12);
    assert.ok(Math.abs(loadPart({ ...bond, max_torque: 4 }) - 0.75) < 1e-12, "the torque is nearer");
    assert.equal(loadText({ ...bond, max_force: null }), "12.0 N", "it never lets go");
    assert.equal(loadPart({ ...bond, max_force: null }), 0);
});
