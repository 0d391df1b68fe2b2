import assert from "node:assert/strict";
import { test } from "node:test";
import { PlayClock } from "../src/model/play_clock";

/** Draws 60 frames a second over States that come `late(k)` s after the beat of `rate` a second, at `pace`. */
function played(
    pace: number,
    rate: number,
    late: (k: number) => number,
    seconds = 4,
): { steps: number[]; last: number; newest: number } {
    const clock = new PlayClock(),
        arrivals: { at: number; time: number }[] = [];
    for (let k = 0; k < seconds * rate; ++k) arrivals.push({ at: 10 + k / rate + late(k), time: (k / rate) * pace });
    const steps: number[] = [];
    let before: number | null = null,
        newest = 0;
    for (let now = 10; now < 10 + seconds - 0.1; now += 1 / 60) {
        while (arrivals.length > 0 && arrivals[0].at <= now) {
            const { at, time } = arrivals.shift() as { at: number; time: number };
            clock.heard(time, at);
            newest = time;
        }
        const shown = clock.read(now);
        assert.ok(shown <= newest + 1e-9, "never ahead of the newest State");
        if (before !== null && now > 12) steps.push(shown - before);
        before = shown;
    }
    return { steps, last: before ?? 0, newest };
}

test("time runs evenly although States come unevenly", () => {
    const { steps } = played(1, 30, (k) => (k % 3) * 0.008);
    const mean = steps.reduce((sum, step) => sum + step, 0) / steps.length;
    assert.ok(Math.abs(mean - 1 / 60) < 1e-3);
    for (const step of steps) assert.ok(Math.abs(step - 1 / 60) < 0.006, `a frame of ${step} s`);
});

test("the picture stays less than a quarter of a second behind, at a tenth of the pace and at ten times", () => {
    for (const pace of [0.1, 1, 10]) {
        const { last, newest } = played(pace, 30, () => 0);
        assert.ok((newest - last) / pace < 0.25 && newest - last > 0, `${(newest - last) / pace} s behind`);
    }
});

test("when States stop, the clock runs up to the last one and stays there", () => {
    const clock = new PlayClock();
    for (let k = 0; k <= 30; ++k) {
        clock.heard(k / 30, 5 + k / 30);
        clock.read(5 + k / 30);
    }
    let shown = 0;
    for (let now = 6; now < 7; now += 1 / 60) shown = clock.read(now);
    assert.ok(Math.abs(shown - 1) < 1e-4);
});

test("a rewind is shown at once", () => {
    const clock = new PlayClock();
    for (let k = 0; k <= 30; ++k) clock.heard(20 + k / 30, 5 + k / 30);
    clock.read(6);
    clock.heard(3, 6.02);
    assert.equal(clock.read(6.03), 3);
});
