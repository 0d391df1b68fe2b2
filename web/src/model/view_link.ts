// Choices from the page's address, and the address of the choices: what one copies to show another person the same view.
import type { Views } from "../camera/views";
import { type Address, formatCamera } from "./address";
import { keep, kept } from "./kept";
import { type CameraMode, type ColourBy, type Overlay, OVERLAYS, type Theme, type ViewerState } from "./viewer_state";

const THEME_KEPT = "roboss.theme";

export function startTheme(address: Address): Theme {
    const asked = address.get("theme") ?? kept(THEME_KEPT);
    if (asked === "light" || asked === "dark") return asked;
    return matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark";
}

export function keepTheme(theme: Theme): void {
    keep(THEME_KEPT, theme);
}

/** Choices that need no scene. */
export function applyAddress(address: Address, state: ViewerState): void {
    const colour = address.get("colour");
    if (colour !== null && ["model", "simulator", "island", "speed"].includes(colour))
        state.colourBy.set(colour as ColourBy);
    for (const name of address.list("show"))
        if ((OVERLAYS as readonly string[]).includes(name)) state.toggle(name as Overlay, true);
    const mode = address.get("mode");
    if (mode !== null && ["orbit", "fly", "follow", "chase"].includes(mode)) state.cameraMode.set(mode as CameraMode);
}

export function viewLink(state: ViewerState, views: Views, plots: string): string {
    const words = new URLSearchParams(),
        url = new URL(location.href),
        selected = state.selected.value;
    words.set("camera", formatCamera(views.cameras[0].rig.goal));
    if (selected !== null) words.set("select", state.world.value?.fleet.name(selected) ?? "");
    const { mode } = views.cameras[0];
    if (mode !== "orbit") words.set("mode", mode);
    for (const [name, value] of views.words(state.world.value)) words.set(name, value);
    if (state.colourBy.value !== "model") words.set("colour", state.colourBy.value);
    if (state.overlays.value.size > 0) words.set("show", [...state.overlays.value].join(","));
    if (plots !== "") words.set("plots", plots);
    url.hash = decodeURIComponent(words.toString());
    return url.toString();
}

/** Puts the link to this view into the address bar and, where the browser allows it, the clipboard; says which. */
export async function copyViewLink(state: ViewerState, views: Views, plots: string): Promise<string> {
    const link = viewLink(state, views, plots);
    history.replaceState(null, "", link);
    try {
        await navigator.clipboard.writeText(link);
        return "The link to this view is copied.";
    } catch {
        return "The link to this view stands in the address bar.";
    }
}
