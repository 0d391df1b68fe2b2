// The buttons over the picture's upper right corner: the whole world, views with names, with or without perspective, and
// one, two or four views. On small screens they lie behind one button.
import { NAMED_VIEWS, type NamedView } from "../camera/named_views";
import type { Director } from "../camera/director";
import type { Views } from "../camera/views";
import type { Action } from "../model/actions";
import type { ViewerState } from "../model/viewer_state";
import { choice, h } from "../ui/dom";
import { VIEW_COUNTS, type ViewCount } from "../view/viewports";

/** With the key of each. */
export const VIEW_NAMES: Record<NamedView, [string, string]> = {
    top: ["Top", "5"],
    front: ["Front", "6"],
    side: ["Side", "7"],
    isometric: ["Iso", "8"],
};

export function viewActions(director: Director): Action[] {
    const counts = VIEW_COUNTS.map((count) => ({
        id: `camera.views_${count}`,
        title: count === 1 ? "One view" : `${count} views`,
        group: "Camera",
        words: "split",
        run: () => director.split(count),
    }));
    return [
        ...NAMED_VIEWS.map((name) => ({
            id: `camera.${name}`,
            title: name === "isometric" ? "View from a corner (isometric)" : `View from the ${name}`,
            group: "Camera",
            keys: [VIEW_NAMES[name][1]],
            run: () => director.view(name),
        })),
        { id: "camera.file", title: "The file's camera", group: "Camera", keys: ["9"], run: () => director.fileView() },
        {
            id: "camera.flat",
            title: "With or without perspective",
            group: "Camera",
            words: "orthographic",
            keys: ["0"],
            run: () => director.flatten(),
        },
        ...counts,
    ];
}

function button(text: string, tip: string, onclick: () => void): HTMLButtonElement {
    return h("button", { type: "button", class: "small", title: tip, onclick }, text);
}

export function viewBar(state: ViewerState, views: Views, director: Director): HTMLElement {
    const file = button("File", "The file's camera  (9)", () => director.fileView()),
        split = choice(
            "Views",
            [
                { value: "1", text: "1" },
                { value: "2", text: "2" },
                { value: "4", text: "4" },
            ] as const,
            (count) => director.split(Number(count) as ViewCount),
        );
    state.world.follow((world) => (file.hidden = world?.loaded.scene.look?.camera === undefined));
    views.count.follow((count) => split.show(String(count) as "1" | "2" | "4"));
    const named = NAMED_VIEWS.map((name) =>
        button(VIEW_NAMES[name][0], `View: ${name}  (${VIEW_NAMES[name][1]})`, () => director.view(name)),
    );
    const buttons = h(
        "div",
        { class: "view-buttons", role: "group", "aria-label": "Views with names" },
        button("Fit", "The whole world  (H)", () => director.home()),
        ...named,
        file,
        button("Flat", "With or without perspective  (0)", () => director.flatten()),
        split.element,
    );
    const toggle = h(
        "button",
        {
            type: "button",
            class: "small view-toggle",
            "aria-expanded": "false",
            onclick: () => toggle.setAttribute("aria-expanded", String(buttons.classList.toggle("open"))),
        },
        "Views",
    );
    return h("div", { class: "view-bar", "data-covers": "" }, toggle, buttons);
}
