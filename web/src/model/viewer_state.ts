// What the page knows and what its person chose, as signals. Every panel and every layer of the picture follows these;
// none knows another.
import type { Groups, RobotReport, Status } from "../wire/messages";
import type { OverlayPart, OverlayReport } from "../wire/overlay";
import type { NumbersReport, NumbersWish } from "../wire/numbers";
import type { StepProfile } from "../wire/profile";
import type { LinkState } from "../wire/connection";
import type { Probe } from "../wire/probe";
import type { LoadedScene } from "../wire/scene_source";
import { Cameras } from "./cameras";
import { Fleet } from "./fleet";
import { History } from "./history";
import type { Extras } from "../wire/onboard";
import type { Attaching } from "./bonding";
import type { Shown } from "./preview";
import { PAGE_OVERLAYS } from "../protocol";
import { Signal } from "./signal";
import { Sight, type Store } from "./sight";
import type { Roles } from "../wire/roles";
import type { Timeline } from "../wire/timeline";

/** Something new that waits for its place. */
export interface Adding {
    /** "box": for the hint. */
    words: string;
    put(point: readonly [number, number, number]): void;
}

/** The end of a run. */
export interface Over {
    /** In the run's words; a remedy on a line of its own. */
    reason: string;
    /** It could not go on. */
    failed: boolean;
}

/** A browser may refuse it. */
function storage(): Store | null {
    try {
        return window.localStorage;
    } catch {
        return null;
    }
}

export type ColourBy = "model" | "simulator" | "island" | "speed";
/** place and turn: by the arrows and rings of the gizmo. */
export type Tool = "select" | "move" | "push" | "place" | "turn";
export type CameraMode = "orbit" | "fly" | "follow" | "chase";
export type Theme = "light" | "dark";
export const OVERLAYS = PAGE_OVERLAYS;
export type Overlay = (typeof OVERLAYS)[number];

/** A scene with the States that came for it. */
export class World {
    readonly fleet: Fleet;
    readonly history: History;

    constructor(readonly loaded: LoadedScene) {
        this.fleet = new Fleet(loaded.scene);
        this.history = new History(this.fleet);
    }
}

export class ViewerState {
    readonly link = new Signal<{ state: LinkState; probe: Probe | null }>({ state: "connecting", probe: null });
    /** Of the protocol, as the run says it; null: not known. */
    readonly version = new Signal<number | null>(null);
    /** Why the run is over, in its own words; null: it is not, as far as known. */
    readonly over = new Signal<Over | null>(null);
    readonly program = new Signal("");
    /** Who may do what, and who has control; null: not known. */
    readonly roles = new Signal<Roles | null>(null);
    readonly world = new Signal<World | null>(null);
    readonly status = new Signal<Status | null>(null);
    /** Where the time of the steps goes; null: not known. */
    readonly profile = new Signal<StepProfile | null>(null);
    /** It is looked at. */
    readonly wantsProfile = new Signal(false);
    /** Branches and bookmarks of the journal; null: there is none. */
    readonly timeline = new Signal<Timeline | null>(null);
    /** An earlier moment that is drawn instead of the present. */
    readonly shown = new Signal<Shown | null>(null);
    readonly groups = new Signal<Groups | null>(null);
    /** The last message; each has some parts only. */
    readonly overlayReport = new Signal<OverlayReport | null>(null);
    /** The parts that have come so far. */
    readonly overlayParts = new Set<OverlayPart>();
    /** Surfaces in motion and bonds; null: there have been none. */
    readonly extras = new Signal<Extras | null>(null);
    /** The bond that the next robot chosen becomes part of. */
    readonly attaching = new Signal<Attaching | null>(null);
    readonly report = new Signal<RobotReport | null>(null);
    /** The joint axis or link whose numbers are looked at; null: none. */
    readonly wantsNumbers = new Signal<NumbersWish | null>(null);
    readonly numbers = new Signal<NumbersReport | null>(null);
    readonly selected = new Signal<number | null>(null);
    /** Robots that are selected besides it (model/selection.ts). */
    readonly others = new Signal<readonly number[]>([]);
    /** The model of the scenery that is selected; null: none. */
    readonly scenery = new Signal<string | null>(null);
    /** What the next click into the picture adds there; null: nothing. */
    readonly adding = new Signal<Adding | null>(null);
    /** What is hidden and what is locked. */
    readonly sight = new Sight(storage());
    /** Pictures of robots' cameras. */
    readonly cameras = new Cameras();
    readonly colourBy = new Signal<ColourBy>("model");
    /** The colour of each robot where the colour mode gives it one; null: its own. */
    readonly dots = new Signal<((robot: number) => string) | null>(null);
    readonly tool = new Signal<Tool>("select");
    readonly cameraMode = new Signal<CameraMode>("orbit");
    readonly theme = new Signal<Theme>("dark");
    readonly overlays = new Signal<ReadonlySet<Overlay>>(new Set<Overlay>());
    /** Robots whose reports are wanted though they are not selected (plotted ones). */
    readonly pinned = new Signal<readonly number[]>([]);
    /** Simulated time that is drawn. */
    readonly drawnTime = new Signal(0);

    /** What the picture shows of it beside the robots: a change is drawn. */
    get shows(): readonly { follow(act: () => void): unknown }[] {
        const { selected, overlays, colourBy, theme, report, overlayReport, groups, world, tool, extras, shown } = this;
        const pictures = this.cameras.taken;
        return [
            selected,
            overlays,
            colourBy,
            theme,
            report,
            overlayReport,
            groups,
            world,
            tool,
            extras,
            shown,
            pictures,
        ];
    }

    toggle(overlay: Overlay, on = !this.overlays.value.has(overlay)): void {
        const next = new Set(this.overlays.value);
        if (on) next.add(overlay);
        else next.delete(overlay);
        this.overlays.set(next);
    }
}
