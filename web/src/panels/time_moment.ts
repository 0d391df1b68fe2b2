// The strip that says which earlier moment is seen, and what can be done there: continue the run from it, or go back to
// the present.
import type { RunLink } from "../model/run_link";
import type { Moment } from "../model/timeline";
import { branchAt } from "../model/timeline";
import type { ViewerState } from "../model/viewer_state";
import { h, setText } from "../ui/dom";
import { clockText } from "../ui/numbers";

function plural(count: number, one: string, many: string): string {
    return count === 1 ? `1 ${one}` : `${count} ${many}`;
}

/** A moment as the program's requests name it. */
export function momentWord(moment: Moment): string {
    return moment.branch > 0 ? `#${moment.branch}@${moment.time.toFixed(9)}` : moment.time.toFixed(9);
}

export function momentStrip(state: ViewerState, run: RunLink): HTMLElement {
    const words = h("span", { class: "moment-words" }),
        notShown = h("span", { class: "hint" }),
        go = h("button", { type: "button", class: "small" }, "Continue from here"),
        back = h("button", { type: "button", class: "small", title: "Back to now  (Escape)" }, "Back to now");
    const element = h(
        "div",
        { class: "moment", role: "status", "aria-label": "Earlier moment", hidden: true },
        words,
        notShown,
        h("span", { class: "grow" }),
        go,
        back,
    );
    const shownMoment = (): Moment | null => {
        // The branch that was asked for, not the one before it that holds the moment: a replay goes on to its end.
        const wanted = run.preview.wanted.value,
            shown = state.shown.value;
        return wanted === null || shown === null ? wanted : { branch: wanted.branch, time: shown.time_s };
    };
    go.addEventListener("click", () => {
        const moment = shownMoment();
        if (moment === null) return;
        const replay = state.status.value?.replay === true;
        go.disabled = true;
        void run
            .control("rewind", momentWord(moment))
            .then(async (answer) => {
                if (!answer.done) return;
                run.preview.leave();
                if (replay) await run.control("resume");
                else run.notice.set({ text: "The run continues from there, in a new branch.", bad: false });
            })
            .finally(() => (go.disabled = false));
    });
    back.addEventListener("click", () => run.preview.leave());
    const show = () => {
        const wanted = run.preview.wanted.value,
            shown = state.shown.value,
            status = state.status.value,
            timeline = state.timeline.value;
        document.body.classList.toggle("earlier", shown !== null);
        element.hidden = wanted === null || !run.preview.pinned.value; // pointing changes no layout
        if (wanted === null || element.hidden) return;
        const branch = shown?.branch ?? (wanted.branch > 0 ? wanted.branch : branchAt(timeline, wanted.time)),
            time = shown?.time_s ?? wanted.time,
            replay = status?.replay === true;
        const coming = shown === null || !shown.exact || Math.abs(shown.time_s - wanted.time) > 1.5 ? " …" : "";
        setText(
            words,
            `You see ${clockText(time)} of branch ${branch}${coming}; the ${replay ? "replay" : "run"} is at ` +
                clockText(status?.time_s ?? 0, 1),
        );
        const missing: string[] = [];
        if ((shown?.gone ?? 0) > 0) missing.push(`${plural(shown?.gone ?? 0, "robot", "robots")} of then not shown`);
        if ((shown?.absent ?? 0) > 0)
            missing.push(`${plural(shown?.absent ?? 0, "robot", "robots")} of now not there yet`);
        setText(notShown, missing.join(", "));
        setText(go, replay ? "Play from here" : "Continue from here");
        go.title = replay
            ? "Play the recording from this moment on"
            : "Continue the run from this moment, in a new branch; the old one stays";
        go.hidden = state.roles.value?.role === "watch";
    };
    for (const follow of [
        run.preview.wanted,
        run.preview.pinned,
        state.shown,
        state.status,
        state.timeline,
        state.roles,
    ])
        follow.follow(show);
    return element;
}
