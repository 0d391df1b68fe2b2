import assert from "node:assert/strict";
import { test } from "node:test";
import { SensorWays } from "../src/overlays/sensor_ways";
import type { PoseArray, RobotReport, SensorInfo, SensorReport, TypeInfo } from "../src/wire/messages";
import { close, IDENTITY, typeOf } from "./support";

function sensor(name: string, kind: string, frame: PoseArray = IDENTITY): SensorInfo {
    return { name, kind, link: 0, frame };
}

function report(time: number, sensors: SensorReport[], pose: PoseArray = IDENTITY, robot = 4): RobotReport {
    const none = { joints: [], contacts: [], linear: [0, 0, 0] as never, angular: [0, 0, 0] as never };
    return { type: "robot", scene: 1, robot, tick: 0, time, pose, sensors, ...none };
}

/** w x y z of a turn about z. */
function turned(yaw: number): number[] {
    return [Math.cos(yaw / 2), 0, 0, Math.sin(yaw / 2)];
}

function typeWith(...sensors: SensorInfo[]): TypeInfo {
    return typeOf([], [], { sensors });
}

test("a GPS way is what the receiver says, each sample once", () => {
    const ways = new SensorWays(),
        type = typeWith(sensor("place", "gps"));
    assert.ok(ways.take(type, report(0, [{ world: [1, 2, 3], taken: 0 }]), 0));
    assert.ok(!ways.take(type, report(0.1, [{ world: [1, 2, 3], taken: 0 }]), 0), "a held reading is no new point");
    assert.ok(ways.take(type, report(0.2, [{ world: [4, 5, 6], taken: 0.2 }]), 0));
    assert.deepEqual(ways.ways[0].points, [1, 2, 3, 4, 5, 6]);
});

test("an odometer's way follows the compass, also one that is mounted askew, not the true pose", () => {
    const ways = new SensorWays(),
        askew = [0, 0, 0, ...turned(Math.PI / 2)] as PoseArray,
        type = typeWith(sensor("way", "odometer"), sensor("north", "compass", askew));
    const at = (time: number, distance: number, yaw: number, pose?: PoseArray) =>
        ways.take(
            type,
            report(
                time,
                [
                    { distance, taken: time },
                    { orientation: turned(yaw + Math.PI / 2), taken: time },
                ],
                pose,
            ),
            0.01,
        );
    at(0, 5, 0, [10, 20, 1, 1, 0, 0, 0]);
    at(1, 7, 0, [50, 50, 1, 1, 0, 0, 0]);
    at(2, 10, Math.PI / 2);
    const diagonal = 3 / Math.SQRT2;
    assert.equal(
        close(ways.ways[0].points, [10, 20, 0.01, 12, 20, 0.01, 12 + diagonal, 20 + diagonal, 0.01], 1e-9),
        "",
    );
});

test("another robot, and an earlier time, begin anew; a robot without such sensors has no ways", () => {
    const ways = new SensorWays(),
        type = typeWith(sensor("place", "gps"));
    ways.take(type, report(5, [{ world: [1, 2, 3], taken: 5 }]), 0);
    ways.take(type, report(2, [{ world: [4, 5, 6], taken: 2 }]), 0);
    assert.deepEqual(ways.ways[0].points, [4, 5, 6]);
    ways.take(type, report(3, [{ world: [7, 8, 9], taken: 3 }], IDENTITY, 6), 0);
    assert.deepEqual(ways.ways[0].points, [7, 8, 9]);
    ways.take(typeWith(sensor("scan", "laser")), report(4, [{ ranges: [] }], IDENTITY, 7), 0);
    assert.equal(ways.ways.length, 0);
});
