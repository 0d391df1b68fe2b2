// What the colours of robots mean, over the picture, while they are not their own.
import type { ColourBy, ViewerState } from "../model/viewer_state";
import { cutInside, h } from "../ui/dom";
import { groupCss } from "../view/palette";
import { SPEED_FULL } from "../view/colouring";

const MEMBERS_MAX = 10;

function simulators(state: ViewerState): HTMLElement[] {
    const members = (state.status.value?.members ?? []).filter((one) => one.state === "active");
    const rows = members
        .slice(0, MEMBERS_MAX)
        .map(({ id, name, robots }) =>
            h(
                "div",
                { class: "legend-row", title: name },
                h("span", { class: "swatch", style: `background:${groupCss(id)}` }),
                h("span", { class: "legend-name" }, ...cutInside(name === "" ? `Simulator ${id}` : name)),
                h("span", { class: "count" }, `${robots}`),
            ),
        );
    if (members.length > MEMBERS_MAX)
        rows.push(h("div", { class: "hint" }, `and ${members.length - MEMBERS_MAX} more`));
    return rows;
}

function speed(): HTMLElement[] {
    return [
        h("div", { class: "legend-ramp", "aria-hidden": "true" }),
        h(
            "div",
            { class: "legend-ends" },
            h("span", {}, "0"),
            h("span", {}, `${SPEED_FULL / 2}`),
            h("span", {}, `${SPEED_FULL} m/s and more`),
        ),
    ];
}

const TITLES: Record<ColourBy, string> = {
    model: "",
    simulator: "Simulator, robots",
    island: "Islands",
    speed: "Speed",
};

export function legend(state: ViewerState): HTMLElement {
    const element = h("div", { class: "legend", role: "note", "aria-label": "Legend", hidden: true });
    let shown = "";
    const show = () => {
        const by = state.colourBy.value,
            members = state.status.value?.members?.map((one) => `${one.id} ${one.state} ${one.robots}`) ?? [],
            islands = state.status.value?.islands,
            key = `${by} ${by === "simulator" ? members.join() : by === "island" ? islands : ""}`;
        if (key === shown) return;
        shown = key;
        element.hidden = by === "model";
        element.replaceChildren(
            h("strong", {}, TITLES[by]),
            ...(by === "simulator"
                ? simulators(state)
                : by === "speed"
                  ? speed()
                  : [
                        h(
                            "div",
                            { class: "hint" },
                            `One colour for each group of robots that may touch: ${islands ?? "–"}`,
                        ),
                    ]),
        );
    };
    state.colourBy.follow(show);
    state.status.follow(show);
    return element;
}
