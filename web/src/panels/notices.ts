// What must be seen: a banner while the run is gone, and short notices (refusals among them) that pass by themselves.
import type { RunLink } from "../model/run_link";
import type { ViewerState } from "../model/viewer_state";
import { h, iconButton } from "../ui/dom";

const SHOWN_MS = 6000;
const SHOWN_MAX = 4;

export function banner(state: ViewerState, run: RunLink): HTMLElement {
    const text = h("span", {}),
        retry = h("button", { type: "button", onclick: () => run.retryNow() }, "Try now");
    const element = h(
        "div",
        { class: "banner", role: "status", hidden: true },
        h("span", { class: "spinner", "aria-hidden": "true" }),
        text,
        retry,
    );
    let seen = false;
    state.link.follow(({ state: link, why }) => {
        if (link === "open") seen = true;
        const said = why === "" ? "" : ` (${why})`;
        text.textContent = !seen
            ? link === "gone"
                ? `No run answers here${said}. Trying again.`
                : "Connecting to the run…"
            : `The run is gone${said}: what you see is its last moment. Connecting again…`;
        // An ordinary start connects at once: no banner for that.
        element.hidden = link === "open" || (!seen && link === "connecting" && why === "");
        if (link === "gone") element.hidden = false;
        document.body.classList.toggle("gone", seen && link !== "open");
    });
    return element;
}

export function notices(run: RunLink): { element: HTMLElement; say: (text: string, bad?: boolean) => void } {
    const element = h("div", { class: "notices", role: "log", "aria-live": "polite", "aria-label": "Notices" });
    const say = (text: string, bad = false) => {
        const last = element.lastElementChild;
        if (last instanceof HTMLElement && last.dataset.text === text) last.remove();
        const notice = h(
            "div",
            { class: bad ? "notice bad" : "notice" },
            h("span", {}, text),
            iconButton("close", "Dismiss", () => notice.remove()),
        );
        notice.dataset.text = text;
        element.append(notice);
        while (element.childElementCount > SHOWN_MAX) element.firstElementChild?.remove();
        setTimeout(() => notice.remove(), SHOWN_MS);
    };
    run.notice.follow((notice) => notice !== null && say(notice.text, notice.bad));
    return { element, say };
}
