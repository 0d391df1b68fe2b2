// Under the picture's top edge: how the gizmo moves, while its tool is chosen; and the hint while something waits for its
// place.
import type { Gizmo } from "../hands/gizmo";
import type { Placing } from "../model/placing";
import type { Selection } from "../model/selection";
import type { ViewerState } from "../model/viewer_state";
import { choice, h, setText } from "../ui/dom";

export function gizmoBar(state: ViewerState, selection: Selection, placing: Placing, gizmo: Gizmo): HTMLElement {
    const { options } = gizmo,
        change = (part: Partial<typeof options.value>) => options.set({ ...options.value, ...part });
    const space = choice(
        "Axes",
        [
            { value: "world", text: "World", key: "J" },
            { value: "local", text: "Robot", key: "J" },
        ] as const,
        (value) => change({ space: value }),
    );
    const snap = h("input", { type: "checkbox", onchange: () => change({ snap: snap.checked }) }),
        metres = step("Step of moves, m", options.value.step_m, (step_m) => change({ step_m })),
        degrees = step("Step of turns, degrees", options.value.step_deg, (step_deg) => change({ step_deg }));
    options.follow((now) => {
        space.show(now.space);
        snap.checked = now.snap;
    });
    const why = h("p", { class: "why", role: "status" });
    const element = h(
        "div",
        { class: "gizmo-bar", role: "group", "aria-label": "Arrows and rings" },
        space.element,
        h("label", { title: "Hold Ctrl for the other one" }, snap, " Steps (Ctrl)"),
        h("label", {}, metres, " m"),
        h("label", {}, degrees, "°"),
        why,
    );
    const show = () => {
        const tool = state.tool.value,
            robots = selection.robots,
            refusal = robots.map((robot) => placing.refusal(robot)).find((text) => text !== "") ?? "";
        element.hidden = tool !== "place" && tool !== "turn";
        const none =
            state.scenery.value === null
                ? "Select a robot: click it, or Shift and drag a box."
                : "Scenery cannot be moved during a run.";
        setText(why, robots.length > 0 ? refusal : none);
    };
    for (const signal of [state.tool, state.selected, state.others, state.scenery, state.sight.locked])
        (signal as { follow(call: () => void): unknown }).follow(show);
    return element;
}

function step(label: string, value: number, set: (value: number) => void): HTMLInputElement {
    const input = h("input", {
        type: "number",
        min: 0.001,
        step: "any",
        value,
        "aria-label": label,
        title: label,
        onchange: () => {
            if (input.valueAsNumber > 0) set(input.valueAsNumber);
            else input.value = String(value);
        },
    });
    return input;
}

export function addingHint(state: ViewerState): HTMLElement {
    const words = h("span", {}),
        hint = h(
            "div",
            { class: "adding-hint", role: "status", hidden: true },
            words,
            h("button", { type: "button", class: "small", onclick: () => state.adding.set(null) }, "Cancel"),
        );
    state.adding.follow((adding) => {
        hint.hidden = adding === null;
        setText(words, adding === null ? "" : `Click where ${adding.words} shall stand.`);
        document.body.classList.toggle("adding", adding !== null);
    });
    return hint;
}
