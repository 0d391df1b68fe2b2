// The panel above the time bar: all branches of the journal as a tree, each with a track of its own, and the bookmarks.
import type { RunLink } from "../model/run_link";
import { branchRows, type BranchRow } from "../model/timeline";
import type { ViewerState } from "../model/viewer_state";
import { h, iconButton, setText } from "../ui/dom";
import { clockText } from "../ui/numbers";
import type { BookmarkInfo, Timeline } from "../wire/timeline";
import { THUMB_PX, TimeTrack } from "./time_track";

interface Row {
    element: HTMLElement;
    track: TimeTrack;
    facts: HTMLElement;
}

export class BranchPanel {
    readonly element: HTMLElement;
    private readonly tree = h("div", { class: "branches", role: "group", "aria-label": "Branches" });
    private readonly marks = h("ul", { class: "bookmarks", "aria-label": "Bookmarks" });
    private readonly none = h("p", { class: "hint" }, "No bookmarks yet. Press B to name the moment that you see.");
    private readonly size = h("span", { class: "hint" });
    private readonly rows = new Map<number, Row>();

    constructor(
        private readonly state: ViewerState,
        private readonly run: RunLink,
        close: () => void,
    ) {
        this.element = h(
            "section",
            { class: "time-panel", "aria-label": "Branches and bookmarks", hidden: true },
            h(
                "div",
                { class: "time-panel-head" },
                h("h2", {}, "Branches"),
                this.size,
                h("span", { class: "grow" }),
                iconButton("close", "Close branches and bookmarks", close),
            ),
            this.tree,
            h("h2", {}, "Bookmarks"),
            this.none,
            this.marks,
        );
        state.timeline.follow((timeline) => this.list(timeline));
    }

    private row(row: BranchRow): Row {
        const track = new TimeTrack(this.state, this.run, row.branch.id, `Timeline of branch ${row.branch.id}`),
            facts = h("span", { class: "hint branch-facts" });
        const element = h(
            "div",
            { class: "branch" },
            h("div", { class: "branch-name" }, h("b", {}, `branch ${row.branch.id}`), facts),
            h("div", { class: "branch-scale" }, track.element),
        );
        element.style.setProperty("--depth", String(Math.min(row.depth, 6)));
        element.title = row.branch.reason;
        return { element, track, facts };
    }

    private list(timeline: Timeline | null): void {
        this.rows.clear();
        const rows = timeline === null ? [] : branchRows(timeline, this.state.status.value?.time_s ?? 0);
        for (const row of rows) this.rows.set(row.branch.id, this.row(row));
        this.tree.replaceChildren(...[...this.rows.values()].map((row) => row.element));
        const marks = timeline?.bookmarks ?? [];
        this.marks.replaceChildren(...marks.map((mark) => this.bookmark(mark)));
        this.none.hidden = marks.length > 0;
        this.update();
    }

    private bookmark(mark: BookmarkInfo): HTMLElement {
        const removable = this.state.status.value?.replay !== true;
        return h(
            "li",
            {},
            h(
                "button",
                {
                    type: "button",
                    class: "small",
                    title: "Look at this moment",
                    onclick: () => this.run.preview.show({ branch: mark.branch, time: mark.time_s }, true),
                },
                mark.name,
            ),
            h("span", { class: "hint" }, `${clockText(mark.time_s)}, branch ${mark.branch}`),
            removable
                ? iconButton(
                      "close",
                      `Remove bookmark ${mark.name}`,
                      () => void this.run.control("bookmark", "remove", String(mark.id)),
                  )
                : null,
        );
    }

    /** Ends that move with the run. */
    update(): void {
        const { timeline, status } = { timeline: this.state.timeline.value, status: this.state.status.value };
        if (timeline === null || status === null || this.element.hidden) return;
        const rows = branchRows(timeline, status.time_s),
            first = Math.min(...rows.map((row) => row.first)),
            last = Math.max(first + 1e-9, ...rows.map((row) => row.last));
        const bytes = status.journal?.bytes ?? 0;
        setText(
            this.size,
            bytes > 0
                ? `${(bytes / 1e6).toFixed(1)} MB on disk, grows by ${(status.journal?.mb_per_min ?? 0).toFixed(1)} MB/min`
                : "",
        );
        for (const row of rows) {
            const shown = this.rows.get(row.branch.id);
            if (shown === undefined) continue;
            shown.element.classList.toggle("present", row.present);
            shown.element.classList.toggle("on-path", row.onPath);
            setText(shown.facts, `${clockText(row.first)} to ${clockText(row.last)}`);
            // Half a thumb at each end of a track is no time: so equal times are as long in all rows, and lie one below
            // the other.
            const share = (time: number) => `${(time / (last - first)).toFixed(6)} * (100% - ${THUMB_PX}px)`;
            shown.track.element.style.left = `calc(${share(row.first - first)})`;
            shown.track.element.style.width = `calc(${share(row.last - row.first)} + ${THUMB_PX}px)`;
            const length = Math.max(1e-9, row.last - row.first),
                now = row.present ? Math.min(1, (status.time_s - row.first) / length) : null;
            const marks = timeline.bookmarks.filter((mark) => mark.branch === row.branch.id);
            shown.track.show({ first: row.first, last: row.last, now, enabled: row.last > row.first }, marks);
        }
    }
}
