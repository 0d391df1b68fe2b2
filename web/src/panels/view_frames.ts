// Names of the views of a split picture, and a frame about the active one.
import type { Views } from "../camera/views";
import type { ViewerState } from "../model/viewer_state";
import { h, setText } from "../ui/dom";
import { viewports } from "../view/viewports";

const MODES = { orbit: "Orbit", fly: "Fly", follow: "Follow", chase: "Chase" };

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
            setText(frame.firstElementChild as Element, `${k + 1}  ${MODES[mode]} ${name}`.trim());
        });
    };
    for (const signal of [views.count, views.active]) (signal as typeof views.active).follow(show);
    state.cameraMode.follow(show);
    state.selected.follow(show);
    state.world.follow(show);
    new ResizeObserver(show).observe(document.body);
    return element;
}
