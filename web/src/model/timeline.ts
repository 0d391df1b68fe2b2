// What the timeline spans, and what of the run's past lies where on it.
import { clockText } from "../ui/numbers";
import type { Status } from "../wire/messages";
import type { BookmarkInfo, BranchInfo, Timeline } from "../wire/timeline";

export interface TimelineSpan {
    /** There are earlier moments. */
    rewinds: boolean;
    /** There is a journal, though perhaps nothing in it yet. */
    kept: boolean;
    first: number;
    last: number;
    /** Place of the present, 0..1. */
    now: number;
}

/** A moment of the past. Branch 0: on the path of the present branch. */
export interface Moment {
    branch: number;
    time: number;
}

const NONE: TimelineSpan = { rewinds: false, kept: false, first: 0, last: 0, now: 0 };

/** The path of the present branch. A replay also has times behind the present. */
export function timelineOf(status: Status | null, timeline: Timeline | null = null): TimelineSpan {
    const journal = status?.journal;
    if (status === null || journal === null || journal === undefined) return NONE;
    const present = timeline?.branches.find((branch) => branch.id === timeline.branch),
        recorded = status.replay === true ? (present?.end_s ?? 0) : 0;
    const first = journal.first_s,
        last = Math.max(first, recorded, journal.last_s, status.time_s);
    return {
        rewinds: last > first,
        kept: true,
        first,
        last,
        now: last > first ? Math.min(1, Math.max(0, (status.time_s - first) / (last - first))) : 0,
    };
}

/** Time at a place of the slider, 0..1. */
export function sliderTime(span: { first: number; last: number }, place: number): number {
    return span.first + Math.max(0, Math.min(1, place)) * (span.last - span.first);
}

/** Place of a time, 0..1. */
export function placeOf(span: { first: number; last: number }, time: number): number {
    return span.last > span.first ? Math.max(0, Math.min(1, (time - span.first) / (span.last - span.first))) : 1;
}

const STEPS = [0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14400, 43200];

/** Times to mark on a scale, at most so many. */
export function marksOf(span: { first: number; last: number }, most: number): number[] {
    const length = span.last - span.first;
    if (!(length > 0) || most < 1) return [];
    const step = STEPS.find((one) => length / one <= most) ?? 86400 * Math.ceil(length / most / 86400);
    const marks: number[] = [];
    for (let k = Math.ceil(span.first / step - 1e-9); k * step <= span.last + 1e-9; ++k) marks.push(k * step);
    return marks;
}

/** A time of a mark: "0:40", "0:00.5", "1:00:00". */
export function markText(time: number): string {
    const parts = Math.abs(time - Math.round(time)) > 0.01;
    return clockText(time, parts ? 1 : 0);
}

export interface BranchRow {
    branch: BranchInfo;
    depth: number;
    present: boolean;
    /** It has the present branch's past before it left. */
    onPath: boolean;
    first: number;
    last: number;
}

/** The branches as a tree, each behind its parent. `now`: the run's time, where the present branch ends. */
export function branchRows(timeline: Timeline, now: number): BranchRow[] {
    const rows: BranchRow[] = [],
        byId = new Map(timeline.branches.map((branch) => [branch.id, branch])),
        path = new Set<number>();
    for (let at = byId.get(timeline.branch); at !== undefined; at = byId.get(at.parent)) path.add(at.id);
    const add = (parent: number, depth: number) => {
        for (const branch of timeline.branches.filter((one) => (byId.has(one.parent) ? one.parent : 0) === parent)) {
            const present = branch.id === timeline.branch;
            rows.push({
                branch,
                depth,
                present,
                onPath: path.has(branch.id),
                first: branch.first_s,
                last: Math.max(branch.first_s, present ? Math.max(now, branch.end_s) : branch.end_s),
            });
            add(branch.id, depth + 1);
        }
    };
    add(0, 0);
    return rows;
}

/** The branch that has this time on the path of the present one. */
export function branchAt(timeline: Timeline | null, time: number): number {
    if (timeline === null) return 0;
    const byId = new Map(timeline.branches.map((branch) => [branch.id, branch]));
    let at = byId.get(timeline.branch);
    while (at !== undefined && time < at.begin_s - 1e-9 && byId.has(at.parent)) at = byId.get(at.parent);
    return at?.id ?? timeline.branch;
}

/** Those that lie on the path of the present branch. */
export function bookmarksOnPath(timeline: Timeline): BookmarkInfo[] {
    return timeline.bookmarks.filter((mark) => branchAt(timeline, mark.time_s) === mark.branch);
}
