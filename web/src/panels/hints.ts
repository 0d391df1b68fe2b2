// What a newcomer needs to know, once: a card that never comes back after it was dismissed. It stands below the panel at the
// right, which has room before a robot is selected; where panels are sheets, over the picture, which leaves it free.
import type { Address } from "../model/address";
import { dismissHints, hintsWanted } from "../model/first_visit";
import { h } from "../ui/dom";
import { COARSE } from "../ui/touch";
import { NARROW } from "./sheets";

const MOUSE = [
    "Drag turns the picture, right drag moves it, the wheel zooms.",
    "Click a robot to inspect it; double click follows it.",
    "Ctrl K finds every command and every robot. ? shows all keys.",
];
const TOUCH = [
    "One finger turns the picture, two fingers move and zoom it.",
    "Tap a robot to select it; a long press opens its sheet.",
    "The tabs below open the panels. ⋯ holds what has no room.",
];

export function firstHints(address: Address, view: HTMLElement, panel: HTMLElement): void {
    if (!hintsWanted(address)) return;
    const element = h(
        "aside",
        { class: "hints", "aria-label": "First steps", "data-covers": "" },
        h("strong", {}, "First steps"),
        h("ul", {}, ...(COARSE ? TOUCH : MOUSE).map((line) => h("li", {}, line))),
        h("div", { class: "buttons" }, h("button", { type: "button", class: "small", onclick: dismiss }, "Got it")),
    );
    const narrow = matchMedia(NARROW),
        place = () => (narrow.matches ? view : panel).append(element);
    narrow.addEventListener("change", place);
    place();
    function dismiss(): void {
        dismissHints();
        narrow.removeEventListener("change", place);
        element.remove();
    }
}
