// The inspector of a model of the scenery: its links and shapes with their sizes and poses.
import { toRollPitchYaw } from "../kinematics/pose";
import { sceneryModels } from "../model/scene_tree";
import type { ViewerState } from "../model/viewer_state";
import { h } from "../ui/dom";
import { fixed } from "../ui/numbers";
import type { Visual } from "../wire/messages";

const SHAPES_MAX = 100;

/** "box 2 x 0.5 x 1 m". */
export function shapeText({ shape, size, radius, length, radii }: Visual): string {
    const metres = (values: readonly (number | undefined)[]) =>
        `${values.map((value) => Number((value ?? 0).toFixed(3))).join(" × ")} m`;
    if (shape === "box" || shape === "plane") return `${shape} ${metres(size ?? [])}`;
    if (shape === "ellipsoid") return `ellipsoid, radii ${metres(radii ?? [])}`;
    if (shape === "mesh") return "mesh";
    return shape === "sphere"
        ? `sphere, radius ${metres([radius])}`
        : `${shape}, radius and length ${metres([radius, length])}`;
}

function row(label: string, value: string): HTMLElement {
    return h(
        "div",
        { class: "reading" },
        h("span", { class: "label" }, label),
        h("span", { class: "value wide" }, value),
    );
}

function shapeBlock(visual: Visual): HTMLElement {
    const parts = visual.name.split("::").slice(-2),
        angles = toRollPitchYaw(visual.frame).map((angle) => fixed((angle * 180) / Math.PI, 1));
    return h(
        "details",
        { class: "section", open: true },
        h("summary", {}, parts.join(" · ")),
        row("Shape", shapeText(visual)),
        row(
            "Position",
            `${visual.frame
                .slice(0, 3)
                .map((value) => fixed(value, 3))
                .join("  ")} m`,
        ),
        row("Roll, pitch, yaw", `${angles.join("  ")}°`),
    );
}

export function sceneryInfo(state: ViewerState): HTMLElement {
    const element = h("div", { class: "inspector scenery-info", hidden: true });
    const show = () => {
        const scene = state.world.value?.fleet.scene,
            model = state.scenery.value,
            shapes = scene === undefined || model === null ? [] : (sceneryModels(scene).get(model) ?? []);
        element.hidden = scene === undefined || model === null;
        if (scene === undefined || model === null) return;
        const more = shapes.length - SHAPES_MAX;
        element.replaceChildren(
            h(
                "div",
                { class: "robot-head" },
                h("h3", {}, model),
                h(
                    "span",
                    { class: "facts" },
                    `scenery  ·  ${shapes.length} ${shapes.length === 1 ? "shape" : "shapes"}`,
                ),
            ),
            ...shapes.slice(0, SHAPES_MAX).map((k) => shapeBlock(scene.statics[k])),
            ...(more > 0 ? [h("p", { class: "empty" }, `and ${more} more`)] : []),
            h("p", { class: "empty" }, "Scenery is static: it cannot be moved or removed during a run."),
        );
    };
    state.scenery.follow(show);
    state.world.follow(() => {
        const { scene } = state.world.value?.fleet ?? {};
        if (scene === undefined || !sceneryModels(scene).has(state.scenery.value ?? "")) state.scenery.set(null);
        show();
    });
    return element;
}
