// A stretch of time that can be pointed at and scrubbed: a slider with a bubble that names the time under the pointer,
// marks, and bookmarks. Pointing with a mouse shows a moment after a short rest, dragging shows each one.
import type { RunLink } from "../model/run_link";
import { marksOf, markText, placeOf, sliderTime } from "../model/timeline";
import type { ViewerState } from "../model/viewer_state";
import { h, setText } from "../ui/dom";
import { clockText } from "../ui/numbers";
import { COARSE } from "../ui/touch";
import type { BookmarkInfo } from "../wire/timeline";

const REST_MS = 140;
const STILL_PX = 2;
const STEPS = 100_000;
const PIXELS_A_MARK = 56;
/** Width of the slider's thumb, as --thumb of the style: half of it at each end is no time. */
export const THUMB_PX = COARSE ? 24 : 13;

export interface TrackSpan {
    first: number;
    last: number;
    /** Place of the present, 0..1; null: it is not on this track. */
    now: number | null;
    enabled: boolean;
}

/** Keys that move to another time; by seconds or by ticks. */
function keyMove(event: KeyboardEvent, dt: number): number | null {
    const second =
        event.shiftKey || event.key.startsWith("Page") || event.key.endsWith("Up") || event.key.endsWith("Down");
    const step = second ? 1 : dt;
    if (["ArrowRight", "ArrowUp", "PageUp"].includes(event.key)) return step;
    if (["ArrowLeft", "ArrowDown", "PageDown"].includes(event.key)) return -step;
    return null;
}

export class TimeTrack {
    readonly element: HTMLElement;
    private readonly slider: HTMLInputElement;
    private readonly bubble = h("output", { class: "bubble", "aria-hidden": "true" });
    private readonly marks = h("div", { class: "marks", "aria-hidden": "true" });
    private readonly flags = h("div", { class: "flags" });
    private span: TrackSpan = { first: 0, last: 0, now: 1, enabled: false };
    private held = false;
    private timer = 0;
    private marked = "";
    private pointed = { x: -1, y: -1 };

    constructor(
        private readonly state: ViewerState,
        private readonly run: RunLink,
        /** 0: the path of the present branch. */
        private readonly branch: number,
        label: string,
    ) {
        this.slider = h("input", { type: "range", min: 0, max: STEPS, step: "any", "aria-label": label });
        this.element = h(
            "div",
            { class: "track" },
            this.marks,
            this.slider,
            this.flags,
            h("div", { class: "bubble-place" }, this.bubble),
        );
        this.listen();
    }

    /** Its keys act from now on. */
    focus(): void {
        this.slider.focus();
    }

    private get preview() {
        return this.run.preview;
    }

    private listen(): void {
        const { slider } = this;
        slider.addEventListener("pointerdown", (event) => {
            this.held = true;
            this.pointed = { x: event.clientX, y: event.clientY };
        });
        for (const end of ["pointerup", "pointercancel", "change"])
            slider.addEventListener(end, () => (this.held = false));
        slider.addEventListener("input", () => this.choose(sliderTime(this.span, slider.valueAsNumber / STEPS)));
        slider.addEventListener("keydown", (event) => this.key(event));
        slider.addEventListener("pointermove", (event) => this.point(event));
        slider.addEventListener("pointerleave", () => {
            clearTimeout(this.timer);
            this.element.classList.remove("pointed");
            this.preview.unpoint();
        });
    }

    private at(time: number): { branch: number; time: number } {
        return { branch: this.branch, time: Math.max(this.span.first, Math.min(this.span.last, time)) };
    }

    private choose(time: number): void {
        clearTimeout(this.timer);
        this.showBubble(time);
        this.preview.show(this.at(time), true);
    }

    private key(event: KeyboardEvent): void {
        const wanted = this.preview.wanted.value,
            dt = this.state.world.value?.fleet.scene.dt ?? 0.001,
            here = wanted?.time ?? this.state.status.value?.time_s ?? this.span.last;
        const move = keyMove(event, dt);
        if (event.key === "Home") this.choose(this.span.first);
        else if (event.key === "End" && this.span.now !== null) this.preview.leave();
        else if (event.key === "End") this.choose(this.span.last);
        else if (move !== null) this.choose(here + move);
        else return;
        event.preventDefault();
    }

    private point(event: PointerEvent): void {
        if (event.pointerType !== "mouse" || this.held || !this.span.enabled) return;
        // The browser repeats the last place when the layout moves under a pointer that rests.
        const { x, y } = this.pointed;
        if (Math.hypot(event.clientX - x, event.clientY - y) < STILL_PX) return;
        this.pointed = { x: event.clientX, y: event.clientY };
        const box = this.slider.getBoundingClientRect(),
            time = sliderTime(this.span, (event.clientX - box.left - THUMB_PX / 2) / Math.max(1, box.width - THUMB_PX));
        this.element.classList.add("pointed");
        this.showBubble(time);
        clearTimeout(this.timer);
        if (this.preview.pinned.value) return;
        this.timer = window.setTimeout(() => this.preview.show(this.at(time), false), REST_MS);
    }

    private showBubble(time: number): void {
        setText(this.bubble, clockText(time));
        this.bubble.style.left = `${100 * placeOf(this.span, time)}%`;
    }

    show(span: TrackSpan, bookmarks: readonly BookmarkInfo[]): void {
        const { slider } = this,
            wanted = this.preview.wanted.value,
            mine = wanted !== null && wanted.branch === this.branch && this.preview.pinned.value;
        if (!this.held) this.span = span;
        slider.disabled = !span.enabled;
        const now = this.span.now ?? 0;
        const place = mine ? placeOf(this.span, wanted.time) : now;
        if (!this.held) slider.value = String(STEPS * place);
        this.element.style.setProperty("--done", `${100 * place}%`);
        this.element.style.setProperty("--now", `${100 * now}%`);
        this.element.classList.toggle("elsewhere", this.span.now === null && !mine);
        this.element.classList.toggle("away", mine);
        slider.setAttribute("aria-valuetext", clockText(mine ? wanted.time : sliderTime(this.span, now)));
        this.showMarks(bookmarks);
    }

    private showMarks(bookmarks: readonly BookmarkInfo[]): void {
        const most = Math.max(1, Math.floor(this.element.clientWidth / PIXELS_A_MARK)),
            times = this.span.enabled ? marksOf(this.span, most) : [];
        const place = (time: number) => `left: ${(100 * placeOf(this.span, time)).toFixed(2)}%`;
        const text = JSON.stringify([times.map(place), bookmarks.map((mark) => [mark, place(mark.time_s)])]);
        if (text === this.marked) return;
        this.marked = text;
        this.marks.replaceChildren(
            ...times.map((time) => h("span", { class: "mark", style: place(time) }, h("i", {}), markText(time))),
        );
        this.flags.replaceChildren(
            ...bookmarks.map((mark) =>
                h("button", {
                    type: "button",
                    class: "flag",
                    style: place(mark.time_s),
                    title: `${mark.name} (${clockText(mark.time_s)})`,
                    "aria-label": `Bookmark ${mark.name}, ${clockText(mark.time_s)}`,
                    onclick: () => this.preview.show({ branch: mark.branch, time: mark.time_s }, true),
                }),
            ),
        );
    }
}
