// The buttons over the scene tree: add, copy, remove, undo, redo.
import type { Selection } from "../model/selection";
import type { Editing } from "../model/editing";
import type { ViewerState } from "../model/viewer_state";
import { h, iconButton } from "../ui/dom";

export function editBar(state: ViewerState, selection: Selection, editing: Editing, onAdd: () => void): HTMLElement {
    const copy = iconButton("copy", "Copy what is selected", () => void editing.duplicate(), "Ctrl D"),
        remove = iconButton("remove", "Remove what is selected", () => void editing.remove(), "Del"),
        undo = iconButton("undo", "Undo", () => void editing.undo.undo(), "Ctrl Z"),
        redo = iconButton("redo", "Redo", () => void editing.undo.redo(), "Ctrl Shift Z");
    const show = () => {
        const none = selection.robots.length === 0;
        copy.disabled = none;
        remove.disabled = none;
    };
    state.selected.follow(show);
    state.others.follow(show);
    editing.undo.next.follow((next) => {
        for (const [button, name, word, key] of [
            [undo, next.undo, "Undo", "Ctrl Z"],
            [redo, next.redo, "Redo", "Ctrl Shift Z"],
        ] as const) {
            button.disabled = name === "";
            button.title = name === "" ? `${word}: nothing to ${word.toLowerCase()}` : `${word}: ${name}  (${key})`;
        }
    });
    return h(
        "div",
        { class: "edit-bar", role: "toolbar", "aria-label": "Edit the world" },
        iconButton("add", "Add a shape or a file", onAdd),
        copy,
        remove,
        h("span", { class: "grow" }),
        undo,
        redo,
    );
}
