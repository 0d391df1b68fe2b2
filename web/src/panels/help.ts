// The card of keys and gestures. It is made from the list of actions, so it is always true.
import { type Actions, keyText } from "../model/actions";
import { h } from "../ui/dom";

const MOUSE: [string, string][] = [
    ["Drag", "turn the camera"],
    ["Right drag", "move the camera"],
    ["Wheel", "nearer, farther"],
    ["Click", "select a robot or scenery"],
    ["Ctrl click", "select one more robot, or one less"],
    ["Shift drag", "select the robots in a box; with Ctrl: besides those selected"],
    ["Double click", "follow a robot"],
    ["W A S D, Q E", "move the camera (click the picture first)"],
    ["Move tool", "pull a robot where you took it; Alt lifts it, Shift places and turns it"],
    ["Push tool", "pull an arrow: the longer, the stronger"],
];
const TOUCH: [string, string][] = [
    ["One finger", "turn the camera; with the tools Move and Push: pull or push a robot"],
    ["Two fingers", "move the camera; pinch: nearer, farther"],
    ["Tap", "select a robot"],
    ["Double tap", "follow a robot"],
    ["Long press", "open a robot's sheet"],
];

/** While the timeline has the focus. */
const TIMELINE: [string, string][] = [
    ["Left, Right", "a tick earlier, later"],
    ["Up, Down, Shift", "a second"],
    ["Home, End", "the beginning, now"],
    ["Escape", "back to now"],
];
/** While the scene tree has the focus. */
const TREE: [string, string][] = [
    ["Arrows, Home, End", "walk, unfold and fold"],
    ["Enter", "look at the robot"],
    ["Shift, Ctrl", "select several"],
    ["E, L", "hide or show, lock or unlock"],
];

export interface HelpCard {
    element: HTMLDialogElement;
    open(): void;
}

function list(rows: readonly [string, string][]): HTMLElement {
    return h("dl", {}, ...rows.flatMap(([key, words]) => [h("dt", {}, h("kbd", {}, key)), h("dd", {}, words)]));
}

function section(title: string, rows: readonly [string, string][]): HTMLElement {
    return h("section", {}, h("h3", {}, title), list(rows));
}

export function helpCard(actions: Actions): HelpCard {
    const columns = h("div", { class: "help-columns" });
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
            h("h2", { id: "help-title" }, "Keys and gestures"),
            h("button", { type: "button", class: "small", onclick: () => dialog.close() }, "Close"),
        ),
        columns,
    );
    const open = () => {
        const keyed = actions.all().filter((action) => (action.keys?.length ?? 0) > 0),
            groups = [...new Set(keyed.map((action) => action.group))];
        columns.replaceChildren(
            section("Mouse", MOUSE),
            section("Touch", TOUCH),
            section("In the timeline", TIMELINE),
            section("In the scene tree", TREE),
            ...groups.map((group) =>
                section(
                    group,
                    keyed
                        .filter((action) => action.group === group)
                        .map((action) => [(action.keys ?? []).map(keyText).join(", "), action.title]),
                ),
            ),
        );
        dialog.showModal();
    };
    return { element: dialog, open };
}
