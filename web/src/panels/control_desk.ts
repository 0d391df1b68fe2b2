// Who has control of the run: the page that acts takes it, the others see who has it and may ask. And the question to the
// page that has it, when another asks.
import type { RunLink } from "../model/run_link";
import type { ViewerState } from "../model/viewer_state";
import { h, setText } from "../ui/dom";
import type { PageInfo } from "../wire/roles";

function called(page: PageInfo): string {
    return `page ${page.page} (${page.user === "" ? "" : `${page.user}, `}${page.address})`;
}

export function controlDesk(state: ViewerState, run: RunLink): { element: HTMLElement; question: HTMLElement } {
    const words = h("span", { class: "desk-words" }),
        ask = h("button", { type: "button", class: "small" }, "Ask for control"),
        release = h("button", { type: "button", class: "small" }, "Release");
    const element = h(
        "div",
        { class: "desk", role: "status", "aria-label": "Control of the run" },
        words,
        ask,
        release,
    );
    ask.addEventListener("click", () => {
        ask.disabled = true;
        void run.connection.askForControl().then((answer) => {
            ask.disabled = false;
            run.notice.set({ text: answer.text, bad: !answer.done });
        });
    });
    release.addEventListener("click", () => void run.connection.yieldControl());
    const text = h("span", {}),
        give = h("button", { type: "button", class: "small" }, "Hand over"),
        keep = h("button", { type: "button", class: "small" }, "Keep control");
    const question = h("div", { class: "question", role: "alert", hidden: true }, text, give, keep);
    let asker = -1;
    give.addEventListener("click", () => void run.connection.yieldControl(asker));
    keep.addEventListener("click", () => void run.connection.keepControl(asker));
    state.roles.follow((roles) => {
        const mine = roles !== null && roles.holder?.page === roles.page,
            others = roles?.holder != null && !mine,
            next = mine ? roles.asking.find((page) => page.page !== roles.page) : undefined;
        element.hidden = roles === null || (roles.role !== "watch" && roles.holder === null);
        setText(
            words,
            roles?.role === "watch" && !others
                ? "You watch"
                : mine
                  ? "You have control"
                  : roles?.holder != null
                    ? `${called(roles.holder)} has control`
                    : "",
        );
        ask.hidden = !others || roles.role === "watch";
        release.hidden = !mine;
        question.hidden = next === undefined;
        if (next === undefined) return;
        asker = next.page;
        setText(text, `${called(next)} asks for control. Without a reply it gets it after ten seconds.`);
    });
    return { element, question };
}
