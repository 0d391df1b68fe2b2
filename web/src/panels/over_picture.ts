// What lies over the picture's top edge, in one flow, so that nothing covers anything else: what must be known of the run,
// then the bar of views at the right and the rest at the left, below the bar where there is no room beside it.
import { h } from "../ui/dom";

export interface OverPicture {
    /** What must be known or answered now. */
    messages: HTMLElement[];
    bar: HTMLElement;
    left: HTMLElement[];
}

export function overPicture({ messages, bar, left }: OverPicture): HTMLElement {
    return h(
        "div",
        { class: "over-picture" },
        ...messages,
        h("div", { class: "over-row" }, h("div", { class: "over-left" }, ...left), bar),
    );
}
