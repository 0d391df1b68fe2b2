// What the picture shows beside robots and scenery, and by what robots are coloured.
import { type ColourBy, type Overlay, OVERLAYS, type ViewerState } from "../model/viewer_state";
import { HITS_MAX, RAYS_MAX } from "../overlays/beams";
import { LINKS_MAX } from "../overlays/link_marks";
import { h } from "../ui/dom";

export const COLOURS: [ColourBy, string, string][] = [
    ["model", "Model", "as the world file says"],
    ["simulator", "Simulator", "the one that steps the robot"],
    ["island", "Island", "robots that may touch have one colour"],
    ["speed", "Speed", "blue at rest, amber from 3 m/s on"],
];
export const WORDS: Record<Overlay, [string, string]> = {
    rays: ["Laser rays", `of the selected robot; at most ${RAYS_MAX} rays and ${HITS_MAX} points a sensor`],
    points: ["Point clouds", "what lidars, depth and RGB-D cameras of the selected robot measure"],
    tracks: ["Tracks", "where robots drove; also by GPS and odometer of the selected one"],
    compass: ["Compass", "north and heading of the selected robot"],
    contacts: ["Contact forces", "arrows, 1 m for 100 N"],
    radio: ["Radio links", "messages received: green 30 dB above the noise floor, red at it; rings: sent"],
    bounds: ["Swept boxes", "the space that a robot may need in the next window"],
    spheres: ["Bounding spheres", "the reach of each robot"],
    islands: ["Islands", "hulls round robots that may touch"],
    names: ["Names", "of the robots nearest to the camera"],
    collisions: ["Collision shapes", "those that touch, instead of the look"],
    frames: ["Link frames", "x red, y green, z blue"],
    masses: ["Centres of mass", "of links"],
    inertia: ["Inertia", "boxes of equal mass and inertia"],
    axes: ["Joint axes", "with limits"],
    labels: ["Link names", "at most 60"],
    wireframe: ["Wireframe", "triangles of robots"],
    transparent: ["Transparent", "see into robots"],
};

/** They concern the robots that are selected, or all if none is. */
const OF_ROBOTS: ReadonlySet<Overlay> = new Set<Overlay>([
    "frames",
    "masses",
    "inertia",
    "axes",
    "labels",
    "wireframe",
    "transparent",
]);

export function viewOptions(state: ViewerState): HTMLElement {
    const radios = COLOURS.map(([value, name, why]) => {
        const input = h("input", { type: "radio", name: "colour", value, onchange: () => state.colourBy.set(value) });
        state.colourBy.follow((now) => (input.checked = now === value));
        return h("label", { class: "option" }, input, h("span", {}, name), h("small", {}, why));
    });
    const box = (overlay: Overlay) => {
        const input = h("input", {
            type: "checkbox",
            name: overlay,
            onchange: () => state.toggle(overlay, input.checked),
        });
        state.overlays.follow((on) => (input.checked = on.has(overlay)));
        return h(
            "label",
            { class: "option" },
            input,
            h("span", {}, WORDS[overlay][0]),
            h("small", {}, WORDS[overlay][1]),
        );
    };
    const inside = OVERLAYS.filter((overlay) => OF_ROBOTS.has(overlay));
    return h(
        "div",
        { class: "view-options" },
        h("fieldset", {}, h("legend", {}, "Colour robots by"), ...radios),
        h("fieldset", {}, h("legend", {}, "Show"), ...OVERLAYS.filter((one) => !OF_ROBOTS.has(one)).map(box)),
        h(
            "fieldset",
            {},
            h("legend", {}, "Show of the selected robots, or of all"),
            ...inside.map(box),
            h("small", {}, `Marks at the links of the nearest robots, at most ${LINKS_MAX} links.`),
        ),
    );
}
