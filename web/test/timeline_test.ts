import assert from "node:assert/strict";
import { test } from "node:test";
import { sliderTime, timelineOf } from "../src/model/timeline";
import { clockText } from "../src/ui/numbers";
import type { Status } from "../src/wire/messages";

function status(time_s: number, journal: Status["journal"]): Status {
    return { type: "status", world: "w", time_s, tick: 0, paused: false, speed: "1", simulators: 1, journal };
}

test("the timeline spans the journal, and the present stands on it", () => {
    const span = timelineOf(status(15, { first_s: 5, last_s: 25 }));
    assert.deepEqual(span, { rewinds: true, first: 5, last: 25, now: 0.5 });
    assert.equal(sliderTime(span, 0.25), 10);
    assert.equal(sliderTime(span, 2), 25);
});

test("the present may have run past what the journal last said", () => {
    assert.equal(timelineOf(status(26, { first_s: 5, last_s: 25 })).last, 26);
});

test("without a journal, or before anything is in it, one cannot go back", () => {
    assert.equal(timelineOf(status(3, null)).rewinds, false);
    assert.equal(timelineOf(null).rewinds, false);
    assert.equal(timelineOf(status(0, { first_s: 0, last_s: 0 })).rewinds, false);
});

test("times read as clocks", () => {
    assert.equal(clockText(0.0004), "0:00.000");
    assert.equal(clockText(75.25), "1:15.250");
    assert.equal(clockText(59.9996), "1:00.000");
    assert.equal(clockText(3671.5), "1:01:11.500");
});
