// Names of the views of a split picture, and a frame about the active one.
import type { Views } from "../camera/views";
import type { ViewerState } from "../model/viewer_state";
import { h, setText } from "../ui/dom";
import { VIEW_NAMES } from "./view_bar";
import { viewports } from "../view/viewports";
import { angleBetween, DIRECTIONS, NAMED_VIEWS } from "../camera/named_views";
import type { ViewCamera } from "../camera/view_camera";

/** rad: a view that was hardly turned keeps its name. */
const NAMED_WITHIN = 0.02;
const NAMED_EVERY_MS = 400;
const MODES = { orbit: "Orbit", fly: "Fly", follow: "Follow", chase: "Chase" };

function wordsOf({ rig, mode }: ViewCamera, followed: string): string {
    const named = NAMED_VIEWS.find((name) => angleBetween(DIRECTIONS[name], rig.goal) < NAMED_WITHIN);
    if (mode === "orbit" && named !== undefined) return VIEW_NAMES[named][0];
    return `${MODES[mode]} ${followed}`.trim();
}

export function viewFrames(state: ViewerState, views: Views): HTMLElement {
    const element = h("div", { class: "view-frames", "aria-hidden": "true" });
    const show = () => {
        const count = views.count.value;
        element.hidden = count === 1;
        if (count === 1) return element.replaceChildren();
        const { clientWidth, clientHeight } = element.parentElement ?? document.body,
            places = viewports(count, clientWidth, clientHeight);
        while (element.children.length > count) element.lastElementChild?.remove();
        while (element.children.length < count) element.append(h("div", { class: "view-frame" }, h("span", {})));
        places.forEach((place, k) => {
            const frame = element.children[k] as HTMLElement,
                { mode, robot } = views.cameras[k],
                followed = (mode === "follow" || mode === "chase") && robot !== null,
                name = followed ? (state.world.value?.fleet.name(robot) ?? "") : "";
            frame.classList.toggle("active", k === views.active.value);
            frame.style.cssText = `left:${place.left}px;top:${place.top}px;width:${place.width}px;height:${place.height}px`;
            setText(frame.firstElementChild as Element, `${k + 1}  ${wordsOf(views.cameras[k], name)}`);
        });
    };
    for (const signal of [views.count, views.active]) (signal as typeof views.active).follow(show);
    state.cameraMode.follow(show);
    state.selected.follow(show);
    state.world.follow(show);
    new ResizeObserver(show).observe(document.body);
    setInterval(() => views.count.value > 1 && show(), NAMED_EVERY_MS); // a camera that is turned loses its name
    return element;
}
