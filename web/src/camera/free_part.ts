// The part of the picture that nothing covers: panels and sheets that lie over it cut it at one side.
import type { Viewport } from "../view/viewports";
import type { FreePart } from "./fit";

/** Less than this share is left of a side: what covers it is a dialog, not a panel. */
const LEAST_FREE = 0.3;

interface Edges {
    left: number;
    right: number;
    top: number;
    bottom: number;
}

/** What `over` leaves of `area`: the largest of the four rests beside it. */
export function beside(area: Edges, over: Edges): Edges {
    const apart =
        over.left >= area.right || over.right <= area.left || over.top >= area.bottom || over.bottom <= area.top;
    if (apart) return area;
    const rests: Edges[] = [
        { ...area, left: over.right },
        { ...area, right: over.left },
        { ...area, top: over.bottom },
        { ...area, bottom: over.top },
    ];
    const size = (edges: Edges) => Math.max(0, edges.right - edges.left) * Math.max(0, edges.bottom - edges.top),
        best = rests.reduce((a, b) => (size(b) > size(a) ? b : a));
    return size(best) < LEAST_FREE * size(area) ? area : best;
}

/** Of one viewport of the canvas. */
export function freePart(canvas: HTMLElement, viewport: Viewport): FreePart {
    const box = canvas.getBoundingClientRect(),
        left = box.left + viewport.left,
        top = box.top + viewport.top,
        whole = { left, right: left + viewport.width, top, bottom: top + viewport.height };
    let free: Edges = whole;
    const view = canvas.parentElement;
    for (const element of [...document.body.children, ...document.querySelectorAll(".view [data-covers]")]) {
        if (element === view || element instanceof HTMLDialogElement) continue;
        const over = element.getBoundingClientRect();
        if (over.width > 0 && over.height > 0 && getComputedStyle(element).visibility !== "hidden")
            free = beside(free, over);
    }
    return {
        width: viewport.width,
        height: viewport.height,
        left: free.left - whole.left,
        right: whole.right - free.right,
        top: free.top - whole.top,
        bottom: whole.bottom - free.bottom,
    };
}
