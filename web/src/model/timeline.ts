// What the timeline spans: from the journal's first moment to its last, and where the run stands on it.
import type { Status } from "../wire/messages";

export interface TimelineSpan {
    rewinds: boolean;
    first: number;
    last: number;
    /** Place of the present, 0..1. */
    now: number;
}

export function timelineOf(status: Status | null): TimelineSpan {
    const journal = status?.journal;
    if (status === null || journal === null || journal === undefined)
        return { rewinds: false, first: 0, last: 0, now: 1 };
    const first = journal.first_s,
        last = Math.max(first, journal.last_s, status.time_s);
    return {
        rewinds: last > first,
        first,
        last,
        now: last > first ? Math.min(1, Math.max(0, (status.time_s - first) / (last - first))) : 1,
    };
}

/** Time at a place of the slider, 0..1. */
export function sliderTime(span: TimelineSpan, place: number): number {
    return span.first + Math.max(0, Math.min(1, place)) * (span.last - span.first);
}
