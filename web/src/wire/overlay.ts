// Reports that overlays draw: contacts, radio links, bounds of robots.
import type { Triple } from "./messages";
import type { RadioReport } from "./radio";

export interface ContactReport {
    a: number;
    b: number;
    point: Triple;
    normal: Triple;
    force: Triple;
}

export interface OverlayReport {
    type: "overlay";
    scene: number;
    tick: number;
    contacts?: ContactReport[];
    radio?: RadioReport;
    bounds?: { robot: number; box: [Triple, Triple] | number[] }[];
}

/** The parts of an OverlayReport; a message has some of them. */
export const OVERLAY_PARTS = ["contacts", "radio", "bounds"] as const;
export type OverlayPart = (typeof OVERLAY_PARTS)[number];
