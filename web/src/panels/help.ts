// The card of keys, and the keys themselves: one table for both, so that the card is always true.
import { h } from "../ui/dom";

export interface Shortcut {
    keys: string[];
    words: string;
    group: string;
    act: () => void;
}

const MOUSE: [string, string][] = [
    ["Drag", "turn the camera"],
    ["Right drag, Shift drag", "move the camera"],
    ["Wheel, pinch", "nearer, farther"],
    ["Click", "select a robot"],
    ["Double click", "look at a robot"],
    ["W A S D, Q E", "move the camera (click the picture first)"],
    ["Move tool", "pull a robot where you took it; Alt lifts it, Shift places and turns it"],
    ["Push tool", "pull an arrow: the longer, the stronger"],
];

export function helpCard(shortcuts: readonly Shortcut[]): HTMLDialogElement {
    const list = (rows: [string, string][]) =>
        h("dl", {}, ...rows.flatMap(([key, words]) => [h("dt", {}, h("kbd", {}, key)), h("dd", {}, words)]));
    const groups = [...new Set(shortcuts.map((one) => one.group))];
    const dialog = h(
        "dialog",
        {
            class: "help",
            "aria-labelledby": "help-title",
            onclick: (event: MouseEvent) => event.target === dialog && dialog.close(),
        },
        h(
            "div",
            { class: "help-head" },
            h("h2", { id: "help-title" }, "Keys and mouse"),
            h("button", { type: "button", class: "small", onclick: () => dialog.close() }, "Close"),
        ),
        h(
            "div",
            { class: "help-columns" },
            h("section", {}, h("h3", {}, "Mouse and touch"), list(MOUSE)),
            ...groups.map((group) =>
                h(
                    "section",
                    {},
                    h("h3", {}, group),
                    list(
                        shortcuts
                            .filter((one) => one.group === group)
                            .map((one) => [one.keys.map((key) => (key === " " ? "Space" : key)).join(" "), one.words]),
                    ),
                ),
            ),
        ),
    );
    return dialog;
}

/** Keys count wherever no text is typed and no control of the page wants them. */
export function listen(shortcuts: readonly Shortcut[]): void {
    const byKey = new Map(shortcuts.flatMap((one) => one.keys.map((key) => [key.toLowerCase(), one] as const)));
    window.addEventListener("keydown", (event) => {
        const target = event.target as HTMLElement;
        if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]") !== null) return;
        if (target.matches("input:not([type=checkbox]):not([type=radio]), select, textarea")) return;
        if (event.key === " " && target.matches("button, summary, input, [role=tab]")) return;
        const found = byKey.get(event.key.toLowerCase());
        // A key that is held steps on and on, but toggles nothing twice.
        if (found === undefined || (event.repeat && event.key !== ".")) return;
        event.preventDefault();
        found.act();
    });
}
