// Short notices (refusals among them) that pass by themselves.
import type { RunLink } from "../model/run_link";
import { h, iconButton } from "../ui/dom";

const SHOWN_MS = 6000;
const SHOWN_MAX = 4;

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
