// The banner over the picture while something about the run must be known: what is so, and what helps.
import { VERSION } from "../protocol";
import type { RunLink } from "../model/run_link";
import { wordsOf } from "../model/run_state";
import type { ViewerState } from "../model/viewer_state";
import { h, setText } from "../ui/dom";

const LOOK_EVERY_MS = 500;

export function runBanner(state: ViewerState, run: RunLink): HTMLElement {
    const text = h("strong", {}),
        remedy = h("span", {}),
        spinner = h("span", { class: "spinner", "aria-hidden": "true" });
    const button = h("button", {
        type: "button",
        onclick: () => (button.textContent === "Reload" ? location.reload() : run.retryNow()),
    });
    const element = h(
        "div",
        { class: "banner", role: "status", hidden: true },
        spinner,
        h("div", { class: "banner-words" }, text, remedy),
        button,
    );
    let seen = false,
        quiet_ms = 0,
        looked = performance.now();
    const show = () => {
        const link = state.link.value;
        if (link.state === "open") seen = true;
        const words = wordsOf({
            link: link.state,
            probe: link.probe,
            seen,
            over: state.over.value,
            world: state.world.value !== null,
            versions: state.version.value === null ? null : { page: VERSION, run: state.version.value },
            simulators: state.status.value?.simulators ?? null,
            quiet_s: quiet_ms / 1000,
            host: location.host,
        });
        element.hidden = words === null;
        element.dataset.kind = words?.kind ?? "";
        document.body.classList.toggle("gone", seen && (link.state !== "open" || words?.kind === "quiet"));
        if (words === null) return;
        setText(text, words.text);
        setText(remedy, words.remedy);
        spinner.hidden = !words.retries;
        button.hidden = words.button === null;
        setText(button, words.button ?? "");
    };
    state.status.follow(() => {
        quiet_ms = 0;
        show();
    });
    state.link.follow(() => {
        quiet_ms = 0;
        show();
    });
    for (const signal of [state.over, state.version, state.world]) signal.follow(show);
    // A page that is too busy to hear does not blame the run: a long pause of its own counts as one look.
    setInterval(() => {
        const now = performance.now();
        quiet_ms += Math.min(now - looked, 2 * LOOK_EVERY_MS);
        looked = now;
        show();
    }, LOOK_EVERY_MS);
    return element;
}
