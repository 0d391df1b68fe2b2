import assert from "node:assert/strict";
import { test } from "node:test";
import {
    bookmarksOnPath,
    branchAt,
    branchRows,
    markText,
    marksOf,
    sliderTime,
    timelineOf,
} from "../src/model/timeline";
import { clockText } from "../src/ui/numbers";
import type { Status } from "../src/wire/messages";
import type { Timeline } from "../src/wire/timeline";

function status(time_s: number, journal: Status["journal"]): Status {
    return { type: "status", world: "w", time_s, tick: 0, paused: false, speed: "1", simulators: 1, journal };
}

test("the timeline spans the journal, and the present stands on it", () => {
    const span = timelineOf(status(15, { first_s: 5, last_s: 25 }));
    assert.deepEqual(span, { rewinds: true, kept: true, first: 5, last: 25, now: 0.5 });
    assert.equal(sliderTime(span, 0.25), 10);
    assert.equal(sliderTime(span, 2), 25);
});

test("the present may have run past what the journal last said", () => {
    assert.equal(timelineOf(status(26, { first_s: 5, last_s: 25 })).last, 26);
});

test("without a journal, or before anything is in it, one cannot go back", () => {
    assert.equal(timelineOf(status(3, null)).rewinds, false);
    assert.equal(timelineOf(null).rewinds, false);
    const begun = timelineOf(status(0, { first_s: 0, last_s: 0 }));
    assert.deepEqual([begun.rewinds, begun.kept, begun.now], [false, true, 0], "after a reset");
});

test("times read as clocks", () => {
    assert.equal(clockText(0.0004), "0:00.000");
    assert.equal(clockText(75.25), "1:15.250");
    assert.equal(clockText(59.9996), "1:00.000");
    assert.equal(clockText(3671.5), "1:01:11.500");
    assert.equal(clockText(3671.2, 0), "1:01:11");
    assert.equal(clockText(59.97, 1), "1:00.0");
});

const branches: Timeline = {
    type: "timeline",
    serial: 1,
    branch: 3,
    branches: [
        { id: 1, parent: 0, begin_s: 0, first_s: 0, end_s: 20, reason: "run" },
        { id: 2, parent: 1, begin_s: 8, first_s: 8, end_s: 12, reason: "rewound" },
        { id: 3, parent: 1, begin_s: 5, first_s: 5, end_s: 9, reason: "rewound" },
    ],
    bookmarks: [
        { id: 1, branch: 1, time_s: 3, name: "before both" },
        { id: 2, branch: 1, time_s: 10, name: "left behind" },
        { id: 3, branch: 3, time_s: 7, name: "now" },
    ],
};

test("branches make a tree, and the present one grows with the run", () => {
    const rows = branchRows(branches, 11);
    assert.deepEqual(
        rows.map((row) => [row.branch.id, row.depth, row.onPath, row.last]),
        [
            [1, 0, true, 20],
            [2, 1, false, 12],
            [3, 1, true, 11],
        ],
    );
});

test("a time lies on the branch that has it, and bookmarks of other branches are not on the path", () => {
    assert.equal(branchAt(branches, 4), 1);
    assert.equal(branchAt(branches, 6), 3);
    assert.deepEqual(
        bookmarksOnPath(branches).map((mark) => mark.name),
        ["before both", "now"],
    );
});

test("marks are round times, no more than asked for", () => {
    assert.deepEqual(marksOf({ first: 3, last: 23 }, 5), [5, 10, 15, 20]);
    assert.deepEqual(marksOf({ first: 0, last: 0 }, 5), []);
    assert.ok(marksOf({ first: 0, last: 1e6 }, 6).length <= 7);
    assert.deepEqual([0.5, 40, 90, 3600].map(markText), ["0:00.5", "0:40", "1:30", "1:00:00"]);
});

test("a replay has times behind the present", () => {
    const replayed: Status = { ...status(7, { first_s: 0, last_s: 7 }), replay: true };
    assert.equal(timelineOf(replayed, branches).last, 9);
});
