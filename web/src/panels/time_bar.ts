// Time: play, pause, step, speed, the clock, how fast it really goes, and the timeline that goes back where a journal is
// kept.
import type { RunLink } from "../model/run_link";
import { throttled } from "../ui/throttle";
import type { Status } from "../wire/messages";
import type { ViewerState } from "../model/viewer_state";
import { h, icon, iconButton, setText } from "../ui/dom";
import { clockText, factorText } from "../ui/numbers";
import { moreMenu } from "../ui/overflow";
import { sliderTime, timelineOf } from "../model/timeline";

const SPEEDS = ["0.1", "0.25", "0.5", "1", "2", "5", "10", "max"];

export interface TimeBar {
    element: HTMLElement;
    playOrPause(): void;
    step(ticks: number): void;
    faster(by: number): void;
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
    const reset = () => {
        const kept = state.status.value?.journal ?? null;
        if (kept !== null || window.confirm("Start the run over? Without a journal there is no way back."))
            void run.control("reset");
    };
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
        title: "Real-time factor: simulated seconds per second",
    });
    const tick = h("output", { class: "tick", "aria-label": "Tick", title: "Tick" });
    state.status.follow((status) => {
        play.replaceChildren(icon(status?.paused === true ? "play" : "pause"));
        play.setAttribute("aria-label", status?.paused === true ? "Play" : "Pause");
        play.title = status?.paused === true ? "Play  (Space)" : "Pause  (Space)";
        setText(rtf, status?.paused === true ? "paused" : factorText(status?.rtf));
        setText(tick, status === null ? "" : `tick ${Math.round(status.tick)}`);
    });
    const showClock = throttled(33, (time: number) => setText(clock, clockText(time)));
    state.drawnTime.follow(showClock);
    tick.dataset.yields = "4";
    const row = h(
        "div",
        { class: "time-row" },
        h(
            "div",
            { class: "transport", role: "group", "aria-label": "Play and step" },
            h("div", { "data-yields": 2 }, iconButton("reset", "Back to the beginning", reset, "", "Beginning")),
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
    const more = moreMenu(row, "More of time", true);
    row.append(more.button);
    const element = h(
        "footer",
        { class: "time", role: "contentinfo", "aria-label": "Time" },
        row,
        more.menu,
        timeline(state, run),
    );
    const faster = (by: number) => {
        const now = SPEEDS.indexOf(state.status.value?.speed ?? "1");
        void run.control("speed", SPEEDS[Math.max(0, Math.min(SPEEDS.length - 1, (now < 0 ? 3 : now) + by))]);
    };
    return { element, playOrPause, step, faster };
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

function timeline(state: ViewerState, run: RunLink): HTMLElement {
    const first = h("span", { class: "end" }),
        last = h("span", { class: "end" });
    const bubble = h("output", { class: "bubble", "aria-hidden": "true" });
    const slider = h("input", {
        type: "range",
        min: 0,
        max: 1000,
        step: "any",
        "aria-label": "Timeline: go back to an earlier time",
    });
    const element = h("div", { class: "timeline" }, first, h("div", { class: "track" }, slider, bubble), last);
    let held = false,
        span = timelineOf(null);
    const showBubble = () => {
        const time = sliderTime(span, slider.valueAsNumber / 1000);
        bubble.textContent = clockText(time);
        bubble.style.left = `${slider.valueAsNumber / 10}%`;
        slider.setAttribute("aria-valuetext", `${time.toFixed(1)} s`);
    };
    slider.addEventListener("input", () => {
        held = true;
        element.classList.add("held");
        showBubble();
    });
    slider.addEventListener("change", () => {
        void run.control("rewind", sliderTime(span, slider.valueAsNumber / 1000).toFixed(6)).finally(() => {
            held = false;
            element.classList.remove("held");
        });
    });
    const show = (status: Status | null) => {
        if (held) return;
        span = timelineOf(status);
        slider.disabled = !span.rewinds;
        element.title = span.rewinds ? "" : "Start the run with --journal FILE to go back in time";
        setText(first, span.rewinds ? clockText(span.first) : "no journal");
        setText(last, span.rewinds ? clockText(span.last) : "");
        slider.value = String(span.rewinds ? 1000 * span.now : 1000);
        slider.style.setProperty("--done", `${slider.valueAsNumber / 10}%`);
        slider.setAttribute("aria-valuetext", `${(status?.time_s ?? 0).toFixed(1)} s`);
    };
    state.status.follow(show);
    return element;
}
