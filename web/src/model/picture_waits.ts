// What a picture of the page would still miss of what the page was asked to show. `roboss snapshot` takes none before this is
// empty: on a busy machine reports come late, and a page without news draws its last moment under a veil.
import { OVERLAY_PARTS } from "../wire/overlay";
import type { Overlay, ViewerState } from "./viewer_state";

/** They draw what the report of the selected robot says. */
const OF_REPORT: readonly Overlay[] = ["rays", "points", "contacts"];

export interface PictureFacts {
    /** The first State is drawn. */
    drawn: boolean;
    /** The last moment known is shown, under a veil. */
    veiled: boolean;
    /** All cameras are where they shall be. */
    arrived: boolean;
    /** The panel that is open; null: none. */
    panel: string | null;
}

/** In words, for an error; empty: nothing. */
export function waitsOf(state: ViewerState, facts: PictureFacts): string {
    const world = state.world.value,
        robot = state.selected.value;
    if (world === null) return "the world";
    if (!facts.drawn) return "the first State of the world";
    if (state.link.value.state !== "open") return "the connection to the run";
    if (facts.veiled) return "news of the run: a veil lies over its last moment";
    if (state.status.value === null) return "the status of the run";
    const on = state.overlays.value,
        reported = OF_REPORT.some((overlay) => on.has(overlay)) || facts.panel === "inspector";
    if (robot !== null && reported && state.report.value?.robot !== robot)
        return `the report of ${world.fleet.name(robot)}`;
    const missing = OVERLAY_PARTS.find((part) => on.has(part) && !state.overlayParts.has(part));
    if (missing !== undefined) return missing;
    const colour = state.colourBy.value;
    if ((on.has("islands") || colour === "island" || colour === "simulator") && state.groups.value === null)
        return "islands and Simulators";
    const { cameras } = state,
        dark = cameras.wishes.value.find((wish) => cameras.picture(wish.robot, wish.sensor, wish.shows) === null);
    if (dark !== undefined && cameras.trouble.value === null)
        return `a picture of a camera of ${world.fleet.name(dark.robot)}`;
    return facts.arrived ? "" : "the camera, which is on its way";
}
