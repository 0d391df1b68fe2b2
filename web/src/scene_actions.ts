// What one does with the scene in one word: the gizmo's tools, select, copy, remove, undo.
import type { Gizmo } from "./hands/gizmo";
import type { Action } from "./model/actions";
import type { Editing } from "./model/editing";
import { type Selection, SELECTED_MAX } from "./model/selection";
import type { Tool, ViewerState } from "./model/viewer_state";
import type { IconName } from "./ui/icons";
import type { Triple } from "./wire/messages";

export interface SceneParts {
    state: ViewerState;
    selection: Selection;
    editing: Editing;
    gizmo: Gizmo;
    add(): void;
    /** Where the pointer was last in the picture; null: nowhere. */
    pointed(): Triple | null;
}

function toolActions({ state, gizmo }: SceneParts): Action[] {
    const group = "Tools",
        tool = (value: Tool, title: string, key: string, icon: IconName): Action => ({
            id: `tool.${value}`,
            title,
            group,
            keys: [key],
            icon,
            run: () => state.tool.set(value),
            on: () => state.tool.value === value,
        }),
        options = () => gizmo.options.value;
    return [
        tool("place", "Move by arrows", "G", "place"),
        tool("turn", "Turn by rings", "O", "turn"),
        {
            id: "gizmo.space",
            title: "Arrows along the world's or the robot's axes",
            group,
            keys: ["J"],
            run: () => gizmo.options.set({ ...options(), space: options().space === "world" ? "local" : "world" }),
        },
        {
            id: "gizmo.snap",
            title: "Move and turn in steps",
            group,
            keys: ["N"],
            run: () => gizmo.options.set({ ...options(), snap: !options().snap }),
            on: () => options().snap,
        },
    ];
}

/** A text that is marked in the page goes to the clipboard, as everywhere. */
function copyTextOr(copy: () => void): void {
    const text = window.getSelection()?.toString() ?? "";
    if (text === "") copy();
    else void navigator.clipboard?.writeText(text);
}

function editActions({ state, selection, editing, add, pointed }: SceneParts): Action[] {
    const group = "Edit",
        some = () => selection.robots.length > 0;
    return [
        { id: "edit.undo", title: "Undo", group, keys: ["Mod+Z"], icon: "undo", run: () => void editing.undo.undo() },
        {
            id: "edit.redo",
            title: "Redo",
            group,
            keys: ["Mod+Shift+Z", "Mod+Y"],
            icon: "redo",
            run: () => void editing.undo.redo(),
        },
        {
            id: "edit.copy",
            title: "Copy",
            group,
            keys: ["Mod+C"],
            icon: "copy",
            run: () => copyTextOr(() => editing.copy()),
        },
        {
            id: "edit.paste",
            title: "Paste at the pointer",
            group,
            keys: ["Mod+V"],
            run: () => void editing.paste(pointed()),
        },
        {
            id: "edit.duplicate",
            title: "Copy beside",
            group,
            keys: ["Mod+D"],
            icon: "copy",
            run: () => void editing.duplicate(),
            enabled: some,
        },
        {
            id: "edit.remove",
            title: "Remove what is selected",
            group,
            keys: ["Delete", "Backspace"],
            icon: "remove",
            words: "delete",
            destructive: true,
            run: () => void editing.remove(),
        },
        {
            id: "edit.add",
            title: "Add a shape or a file",
            group,
            icon: "add",
            words: "box sphere cylinder urdf sdf mjcf",
            run: add,
        },
        {
            id: "edit.all",
            title: "Select all robots",
            group,
            keys: ["Mod+A"],
            run: () =>
                selection.set(
                    Array.from({ length: Math.min(SELECTED_MAX, state.world.value?.fleet.count ?? 0) }, (_, k) => k),
                ),
        },
    ];
}

export function sceneActions(parts: SceneParts): Action[] {
    return [...toolActions(parts), ...editActions(parts)];
}
