// Time: play, pause, step, speed, the clock, how fast it really goes, and the timeline. Where a journal is kept, earlier
// moments can be looked at, named, and continued from.
import type { RunLink } from "../model/run_link";
import { throttled } from "../ui/throttle";
import type { ViewerState } from "../model/viewer_state";
import { h, icon, iconButton, setText } from "../ui/dom";
import { clockText, factorText, type Pace, paceOf } from "../ui/numbers";
import type { Signal } from "../model/signal";
import { bookmarksOnPath, timelineOf } from "../model/timeline";
import { asked, chosen } from "../ui/confirm";
import { moreMenu } from "../ui/overflow";
import { BranchPanel } from "./time_branches";
import { NARROW } from "./sheets";
import { momentStrip, momentWord } from "./time_moment";
import { TimeTrack } from "./time_track";

const NO_JOURNAL = "Start the run with --journal FILE to look at earlier times";
/** s of the first look back. */
const REWIND_S = 5;
const PACE_TIPS: Record<Pace | "paused", string> = {
    paused: "The run is paused",
    steady: "Real-time factor: simulated seconds per second",
    late: "Real-time factor: the run is slower than real time and than the speed asked for",
};
const SPEEDS = ["0.1", "0.25", "0.5", "1", "2", "5", "10", "max"];

export interface TimeBar {
    element: HTMLElement;
    playOrPause(): void;
    step(ticks: number): void;
    faster(by: number): void;
    /** Names the moment that is seen. */
    bookmark(): void;
    toggleBranches(): void;
    /** False: the present is seen already. */
    backToNow(): boolean;
    /** Asks to where. */
    reset(): void;
    /** Shows what was a little earlier, and gives the timeline the keys. */
    rewind(): void;
}

export function timeBar(state: ViewerState, run: RunLink): TimeBar {
    const paused = () => state.status.value?.paused === true;
    const playOrPause = () =>
        void run.control(paused() ? "resume" : "pause").then((answer) => {
            // The button says what was just asked; the next status confirms it.
            if (answer.done && state.status.value !== null)
                state.status.set({ ...state.status.value, paused: !paused() });
        });
    const step = (ticks: number) => void run.control("step", String(ticks));
    const reset = () => void resetRun(state, run);
    const play = h("button", { type: "button", class: "play", onclick: playOrPause });
    const ticks = h(
        "select",
        { "aria-label": "Ticks of a step", title: "Ticks of a step" },
        ...["1", "10", "100", "1000"].map((n) => h("option", { value: n }, n === "1" ? "1 tick" : `${n} ticks`)),
    );
    const speed = speedChoice(state, run);
    const clock = h("output", { class: "clock", "aria-label": "Simulated time", title: "Simulated time" });
    const rtf = h("output", {
        class: "rtf",
        "aria-label": "Real-time factor",
    });
    const tick = h("output", { class: "tick", "aria-label": "Tick", title: "Tick" });
    state.status.follow((status) => {
        play.replaceChildren(icon(status?.paused === true ? "play" : "pause"));
        play.setAttribute("aria-label", status?.paused === true ? "Play" : "Pause");
        play.title = status?.paused === true ? "Play  (Space)" : "Pause  (Space)";
        const pace = status?.paused === true ? "paused" : paceOf(status?.rtf, status?.speed);
        setText(rtf, pace === "paused" ? pace : factorText(status?.rtf));
        rtf.dataset.pace = pace;
        rtf.title = PACE_TIPS[pace];
    });
    const showTick = () => {
        const at = (state.shown.value ?? state.status.value)?.tick; // of the moment that is seen
        setText(tick, at === undefined ? "" : `tick ${Math.round(at)}`);
    };
    state.status.follow(showTick);
    state.shown.follow(showTick);
    const narrow = matchMedia(NARROW);
    const showClock = throttled(33, (time: number) =>
        setText(clock, clockText(time, narrow.matches && time >= 3600 ? 0 : 3)),
    );
    state.drawnTime.follow(showClock);
    const { panel, toggleBranches, branches } = branchPanel(state, run);
    const bookmark = () => void nameMoment(state, run);
    const flag = iconButton("flag", "Bookmark this moment", bookmark, "B");
    state.status.follow((status) => {
        flag.disabled = (status?.journal ?? null) === null || status?.replay === true;
        branches.disabled = (status?.journal ?? null) === null;
    });
    tick.dataset.yields = "4";
    const row = h(
        "div",
        { class: "time-row" },
        h(
            "div",
            { class: "transport", role: "group", "aria-label": "Play and step" },
            h(
                "div",
                { "data-yields": 2 },
                iconButton("reset", "Reset: to the beginning or the last save", reset, "", "Reset"),
            ),
            play,
            h(
                "div",
                { class: "transport", "data-yields": 3 },
                iconButton("step", "Step", () => step(Number(ticks.value)), ".", "Step"),
                ticks,
            ),
        ),
        speed,
        h("div", { class: "clocks" }, clock, rtf, tick),
    );
    const more = moreMenu(row, "More of time", true),
        main = mainTrack(state, run, flag, branches);
    row.append(more.button);
    const element = h(
        "footer",
        { class: "time", role: "contentinfo", "aria-label": "Time" },
        panel.element,
        momentStrip(state, run),
        h("div", { class: "time-main" }, row, more.menu, main.element),
    );
    const faster = (by: number) => {
        const now = SPEEDS.indexOf(state.status.value?.speed ?? "1");
        void run.control("speed", SPEEDS[Math.max(0, Math.min(SPEEDS.length - 1, (now < 0 ? 3 : now) + by))]);
    };
    const backToNow = () => {
        const away = run.preview.wanted.value !== null;
        run.preview.leave();
        return away;
    };
    const rewind = () => rewound(state, run, main.track);
    return { element, playOrPause, step, faster, reset, bookmark, toggleBranches, backToNow, rewind };
}

function branchPanel(state: ViewerState, run: RunLink) {
    const toggleBranches = () => {
        panel.element.hidden = !panel.element.hidden;
        branches.setAttribute("aria-expanded", String(!panel.element.hidden));
        panel.update();
    };
    const panel = new BranchPanel(state, run, toggleBranches),
        branches = iconButton("branches", "Branches and bookmarks", toggleBranches, "K");
    branches.setAttribute("aria-expanded", "false");
    for (const signal of [state.status, run.preview.wanted, run.preview.pinned])
        (signal as Signal<unknown>).follow(() => panel.update());
    return { panel, toggleBranches, branches };
}

function rewound(state: ViewerState, run: RunLink, track: TimeTrack): void {
    const { rewinds, first, last } = timelineOf(state.status.value, state.timeline.value),
        from = run.preview.wanted.value?.time ?? state.status.value?.time_s ?? last;
    if (!rewinds) return run.notice.set({ text: NO_JOURNAL, bad: false });
    track.focus();
    run.preview.show({ branch: 0, time: Math.max(first, from - REWIND_S) }, true);
}

/** Without a journal there is no way back, so it asks. */
async function resetRun(state: ViewerState, run: RunLink): Promise<void> {
    const kept = (state.status.value?.journal ?? null) !== null;
    const to = await chosen(
        `Reset the run? ${kept ? "The journal keeps what was." : "Without a journal there is no way back."}`,
        { start: "To the beginning", save: run.saved === true ? "To the last save" : "To the last save, if any" },
        run.saved === false ? ["save"] : [],
    );
    if (to !== null) await run.control("reset", to);
}

async function nameMoment(state: ViewerState, run: RunLink): Promise<void> {
    const shown = state.shown.value,
        time = state.status.value?.time_s ?? 0,
        moment = shown === null ? { branch: 0, time } : { branch: shown.branch, time: shown.time_s };
    const name = await asked(
        `Name the moment ${clockText(moment.time)}`,
        `Moment ${clockText(moment.time, 2)}`,
        "Add bookmark",
    );
    if (name === null) return;
    const answer = await run.control("bookmark", name, momentWord(moment));
    if (answer.done) run.notice.set({ text: answer.text, bad: false });
}

function speedChoice(state: ViewerState, run: RunLink): HTMLElement {
    const option = (value: string) => h("option", { value }, value === "max" ? "as fast as it can" : `${value}×`);
    const select = h(
        "select",
        { id: "speed", title: "Speed asked for  (+ and -)", onchange: () => void run.control("speed", select.value) },
        ...SPEEDS.map(option),
    );
    state.status.follow((status) => {
        if (status === null || document.activeElement === select) return;
        if (![...select.options].some((one) => one.value === status.speed)) select.append(option(status.speed));
        select.value = status.speed;
    });
    return h("div", { class: "speed" }, h("label", { for: "speed" }, "Speed"), select);
}

/** The path of the present branch. */
function mainTrack(state: ViewerState, run: RunLink, ...buttons: HTMLElement[]) {
    const first = h("span", { class: "end" }),
        last = h("span", { class: "end" }),
        track = new TimeTrack(state, run, 0, "Timeline: look at an earlier time"),
        element = h("div", { class: "timeline" }, first, track.element, last, ...buttons);
    const show = () => {
        const status = state.status.value,
            timeline = state.timeline.value,
            span = timelineOf(status, timeline);
        element.title = span.rewinds ? "" : span.kept ? "The journal has nothing earlier yet" : NO_JOURNAL;
        element.classList.toggle("none", !span.rewinds);
        setText(first, span.kept ? clockText(span.first, 0) : "no journal");
        setText(last, span.kept ? clockText(span.last, 0) : "");
        track.show({ ...span, enabled: span.rewinds }, timeline === null ? [] : bookmarksOnPath(timeline));
    };
    for (const signal of [state.status, state.timeline, run.preview.wanted, run.preview.pinned])
        (signal as Signal<unknown>).follow(show);
    return { element, track };
}
