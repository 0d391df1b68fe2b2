import assert from "node:assert/strict";
import { test } from "node:test";
import { LINK_SHOWN_S, PULSE_S, quality, RadioTraffic } from "../src/model/radio_traffic";
import type { RadioReport } from "../src/wire/radio";

const link = (from: number, to: number) => ({
    from,
    antenna: 0,
    to,
    sensor: 0,
    messages: 1,
    strength: -70,
    margin: 20,
    time: 1,
});
const report = (pairs: [number, number][], senders: number[] = []): RadioReport => ({
    links: pairs.map(([from, to]) => link(from, to)),
    senders: senders.map((robot) => ({ robot, sensor: 0, messages: 1 })),
    all: true,
});

test("links age while the drawn time moves, and stay while it stands", () => {
    const traffic = new RadioTraffic();
    traffic.advance(10, 1);
    traffic.take(report([[0, 1]], [0]));
    traffic.advance(10.1, 1);
    assert.deepEqual(
        [...traffic.links].map(({ age }) => age),
        [0],
        "paused",
    );
    traffic.advance(10.2, 1.1);
    assert.ok(Math.abs([...traffic.links][0].age - 0.1) < 1e-9);
    let now = 10.2;
    for (; now < 10.2 + PULSE_S; now += 0.1) traffic.advance(now, now);
    assert.equal([...traffic.senders].length, 0, "rings are short");
    assert.equal([...traffic.links].length, 1);
    for (; now < 10.4 + LINK_SHOWN_S; now += 0.1) traffic.advance(now, now);
    assert.ok(traffic.quiet);
});

test("a link that is heard again is new again; the two directions are two links", () => {
    const traffic = new RadioTraffic();
    traffic.advance(0, 0);
    traffic.take(report([[0, 1]]));
    traffic.advance(0.2, 0.2);
    traffic.take(
        report([
            [0, 1],
            [1, 0],
        ]),
    );
    assert.deepEqual(
        [...traffic.links].map(({ what, age }) => [what.from, what.to, age]),
        [
            [0, 1, 0],
            [1, 0, 0],
        ],
    );
    traffic.forget();
    assert.ok(traffic.quiet);
});

test("there is a limit to what is drawn, and the oldest go first", () => {
    const traffic = new RadioTraffic(),
        pairs = Array.from({ length: 3000 }, (_, k): [number, number] => [k, k + 1]);
    traffic.take(report(pairs));
    const kept = [...traffic.links];
    assert.equal(kept.length, 2000);
    assert.equal(kept[kept.length - 1].what.from, 2999);
});

test("quality goes from the noise floor to 30 dB above it", () => {
    assert.deepEqual([-5, 0, 15, 30, 90, null].map(quality), [0, 0, 0.5, 1, 1, 0]);
});
