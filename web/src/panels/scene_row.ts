// One row of the scene tree: fold, sign of its kind, name, and at its end lock and eye.
import type { RowKind, TreeRow } from "../model/scene_tree";
import type { World } from "../model/viewer_state";
import { cutInside, h, icon } from "../ui/dom";
import type { IconName } from "../ui/icons";
import { ownCss } from "../view/own_colour";

export interface RowLook {
    id: string;
    /** px */
    top: number;
    active: boolean;
    selected: boolean;
    hidden: boolean;
    locked: boolean;
    /** A robot's colour by the colour mode; undefined: its own. */
    dot: string | undefined;
    choose(event: MouseEvent): void;
    focus(): void;
    fold(): void;
    hide(on: boolean): void;
    lock(on: boolean): void;
}

const SIGNS: Partial<Record<RowKind, IconName>> = {
    link: "body",
    joint: "joint",
    sensor: "sensor",
    scenery: "scenery",
    light: "light",
};

export function rowElement(world: World, row: TreeRow, look: RowLook): HTMLElement {
    const chosen = row.kind === "robot" || row.kind === "scenery";
    return h(
        "div",
        {
            id: look.id,
            role: "treeitem",
            class: `row ${row.kind}${look.hidden ? " is-hidden" : ""}${look.active ? " active" : ""}`,
            style: `top:${look.top}px; --level:${row.level - 1}`,
            "aria-level": row.level,
            "aria-expanded": row.open === null ? null : String(row.open),
            "aria-selected": chosen ? String(look.selected) : null,
            onclick: (event: MouseEvent) => look.choose(event),
            ondblclick: look.focus,
        },
        row.open === null ? h("span", { class: "twist" }) : twist(row.open, look),
        sign(world, row, look),
        h("span", { class: "row-name", title: row.text }, ...cutInside(row.text)),
        row.count === undefined ? null : h("span", { class: "count" }, String(row.count)),
        ...(row.sight.length > 0 ? switches(row, look) : []),
    );
}

function quiet(act: () => void): (event: Event) => void {
    return (event) => {
        event.stopPropagation();
        act();
    };
}

function twist(open: boolean, look: RowLook): HTMLElement {
    return h("span", { class: `twist ${open ? "open" : "folded"}`, "aria-hidden": "true", onclick: quiet(look.fold) });
}

function sign(world: World, row: TreeRow, look: RowLook): Element | null {
    if (row.kind === "robot")
        return h("span", {
            class: "swatch",
            "aria-hidden": "true",
            style: `background:${look.dot ?? ownCss(world, row.robot ?? 0)}`,
        });
    const name = SIGNS[row.kind];
    return name === undefined ? null : icon(name);
}

/** A lock shows where it is closed or the pointer is; lights cannot be picked anyway. */
function switches(row: TreeRow, look: RowLook): HTMLElement[] {
    const lock = look.locked ? `Unlock ${row.text}` : `Lock ${row.text}: it cannot be picked or moved`,
        eye = look.hidden ? `Show ${row.text}` : `Hide ${row.text}`;
    const one = (label: string, on: boolean, name: IconName, act: () => void) =>
        h(
            "button",
            {
                type: "button",
                class: `row-switch${on ? " on" : ""}`,
                tabindex: -1,
                "aria-label": label,
                "aria-pressed": String(on),
                title: label,
                onclick: quiet(act),
                ondblclick: quiet(() => undefined),
            },
            icon(name),
        );
    const buttons = [one(eye, look.hidden, look.hidden ? "hidden" : "eye", () => look.hide(!look.hidden))];
    if (row.kind !== "link" && row.kind !== "light")
        buttons.unshift(one(lock, look.locked, look.locked ? "locked" : "unlocked", () => look.lock(!look.locked)));
    return buttons;
}
