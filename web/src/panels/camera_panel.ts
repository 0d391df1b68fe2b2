// The cameras of the selected robot: one large, all as thumbnails, and one over the picture of the world if it is wanted.
// Pictures are asked for only while somebody can see them.
import { type Cameras, showsOf } from "../model/cameras";
import type { ColourMap } from "../model/colour_maps";
import { keep, kept } from "../model/kept";
import type { ViewerState } from "../model/viewer_state";
import { choice, h, iconButton, setText } from "../ui/dom";
import { throttled } from "../ui/throttle";
import type { SensorInfo } from "../wire/messages";
import type { Shows } from "../wire/picture";
import { CameraView } from "./camera_view";

const THUMBNAIL = 128,
    LARGE = 640,
    HUGE = 1280;
const MAP_KEPT = "roboss.depth_map";

interface Lens {
    sensor: number;
    info: SensorInfo;
    shows: Shows;
}
const nameOf = ({ info, shows }: Lens): string => (info.kind === "rgbd camera" ? `${info.name}, ${shows}` : info.name);

export class CameraPanel {
    readonly element = h("div", { class: "cameras" });
    /** A picture over that of the world. */
    readonly over = h("section", { class: "camera-over", "aria-label": "Camera", hidden: true });
    private robot: number | null = null;
    private lenses: readonly Lens[] = [];
    private chosen = 0;
    private large: CameraView | null = null;
    private huge: CameraView | null = null;
    private thumbnails: CameraView[] = [];
    private map: ColourMap = kept(MAP_KEPT) === "grey" ? "grey" : "depth";
    private seen = false;
    private readonly time = h("span", { class: "camera-time" });
    private readonly trouble = h("p", { class: "empty camera-trouble", role: "status", hidden: true });

    constructor(
        private readonly state: ViewerState,
        private readonly cameras: Cameras,
        /** Makes room for a picture over that of the world. */
        private readonly makeRoom: () => void,
    ) {
        state.selected.follow(() => this.begin());
        state.world.follow(() => this.begin());
        cameras.taken.follow(throttled(30, () => this.refresh()));
        cameras.trouble.follow((why) => {
            this.trouble.hidden = why === null;
            setText(this.trouble, why ?? "");
        });
        new IntersectionObserver((entries) => {
            this.seen = entries[entries.length - 1].isIntersecting;
            this.ask();
        }).observe(this.element);
        document.addEventListener("visibilitychange", () => this.ask());
    }

    private begin(): void {
        const fleet = this.state.world.value?.fleet,
            robot = this.state.selected.value;
        this.robot = fleet === undefined ? null : robot;
        const sensors = fleet !== undefined && robot !== null ? fleet.type(robot).sensors : [],
            before = this.lenses[this.chosen];
        this.lenses = sensors.flatMap((info, sensor) => showsOf(info).map((shows) => ({ sensor, info, shows })));
        this.chosen = Math.max(
            0,
            this.lenses.findIndex((lens) => before !== undefined && nameOf(lens) === nameOf(before)),
        );
        if (this.lenses.length === 0) this.closeOver();
        this.build(fleet !== undefined && robot !== null ? fleet.name(robot) : null);
        this.ask();
    }

    private build(name: string | null): void {
        this.large = null;
        this.thumbnails = [];
        if (this.lenses.length === 0) {
            const words = name === null ? "Select a robot: its cameras are shown here." : `${name} has no cameras.`;
            return this.element.replaceChildren(h("p", { class: "empty" }, words));
        }
        this.large = new CameraView(`What ${nameOf(this.lenses[this.chosen])} sees`, () => this.map);
        const buttons = this.lenses.map((lens, k) => {
            const view = new CameraView("", () => this.map, false);
            this.thumbnails.push(view);
            return h(
                "button",
                {
                    type: "button",
                    class: "camera-thumbnail",
                    "aria-pressed": String(k === this.chosen),
                    "aria-label": `Show ${nameOf(lens)}`,
                    onclick: () => this.choose(k),
                },
                view.element,
                h("span", { class: "camera-name" }, nameOf(lens)),
            );
        });
        this.element.replaceChildren(
            this.head(name ?? ""),
            this.trouble,
            this.large.element,
            h("div", { class: "camera-thumbnails", role: "group", "aria-label": "Cameras" }, ...buttons),
        );
        this.refresh();
    }

    private head(robot: string): HTMLElement {
        const lens = this.lenses[this.chosen],
            { width, height } = lens.info,
            colours = choice<ColourMap>(
                "Depth in",
                [
                    { value: "depth", text: "Colours" },
                    { value: "grey", text: "Grey" },
                ],
                (map) => {
                    this.map = map;
                    keep(MAP_KEPT, map);
                    colours.show(map);
                    this.refresh();
                },
            );
        colours.show(this.map);
        colours.element.hidden = lens.shows !== "depth";
        return h(
            "div",
            { class: "camera-head" },
            h(
                "div",
                { class: "camera-title" },
                h("h3", {}, nameOf(lens)),
                h("span", { class: "facts" }, `${robot}  ·  ${lens.info.kind}  ·  ${width} x ${height}`),
                this.time,
            ),
            colours.element,
            iconButton("expand", "Show it over the picture", () => this.open()),
        );
    }

    private choose(k: number): void {
        this.chosen = k;
        this.build(this.robot === null ? null : (this.state.world.value?.fleet.name(this.robot) ?? null));
        if (!this.over.hidden) this.open();
        this.ask();
        this.element.querySelectorAll<HTMLElement>(".camera-thumbnail")[k]?.focus();
    }

    private open(): void {
        const lens = this.lenses[this.chosen];
        this.huge = new CameraView(`What ${nameOf(lens)} sees, large`, () => this.map);
        this.over.replaceChildren(
            h(
                "div",
                { class: "camera-over-head" },
                h("h3", {}, nameOf(lens)),
                iconButton("close", "Close the large picture", () => this.closeOver()),
            ),
            this.huge.element,
        );
        if (this.over.hidden) this.makeRoom();
        this.over.hidden = false;
        this.refresh();
        this.ask();
    }

    private closeOver(): void {
        if (this.over.hidden) return;
        this.over.hidden = true;
        this.huge = null;
        this.ask();
    }

    private ask(): void {
        const robot = this.robot,
            here = document.visibilityState === "visible" && robot !== null && this.lenses.length > 0;
        const wish = ({ sensor, shows }: Lens, columns: number) => ({ robot: robot ?? 0, sensor, shows, columns });
        const thumbnails = here && this.seen ? this.lenses.map((lens) => wish(lens, THUMBNAIL)) : [],
            large = here && this.seen ? [wish(this.lenses[this.chosen], LARGE)] : [],
            huge = here && this.huge !== null ? [wish(this.lenses[this.chosen], HUGE)] : [];
        this.cameras.want("panel", [...thumbnails, ...large, ...huge]);
    }

    private refresh(): void {
        if (this.robot === null || this.large === null) return;
        const pictures = this.lenses.map(({ sensor, shows }) => this.cameras.picture(this.robot ?? 0, sensor, shows)),
            chosen = pictures[this.chosen];
        this.thumbnails.forEach((view, k) => view.show(pictures[k]));
        this.large.show(chosen);
        this.huge?.show(chosen);
        setText(
            this.time,
            chosen === null ? "waiting for its picture…" : `${chosen.time.toFixed(3)} s, tick ${chosen.tick}`,
        );
    }
}
