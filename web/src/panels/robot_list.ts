// The tree of robots: types, and the robots of each, found by name. Only the rows in sight exist, so that two thousand
// robots cost no more than twenty.
import type { ViewerState, World } from "../model/viewer_state";
import { h, icon } from "../ui/dom";
import { COARSE } from "../ui/touch";
import { meanColour } from "../view/finishes";

const ROW_PX = COARSE ? 44 : 26;
const SPARE_ROWS = 6;

type Row = { kind: "type"; type: number; count: number; open: boolean } | { kind: "robot"; robot: number };

export class RobotList {
    readonly element: HTMLElement;
    readonly search: HTMLInputElement;
    private readonly scroller: HTMLElement;
    private readonly rowsHost: HTMLElement;
    private readonly count: HTMLElement;
    private rows: Row[] = [];
    private readonly closed = new Set<number>();
    private active = 0;

    constructor(
        private readonly state: ViewerState,
        private readonly onFocus: (robot: number) => void,
        /** Another hand wants the robot: true where it has it, and the selection stays. */
        private readonly taken: (robot: number) => boolean,
    ) {
        this.search = h("input", {
            type: "search",
            placeholder: "Find a robot",
            "aria-label": "Find a robot",
            oninput: () => this.rebuild(),
        });
        this.count = h("span", { class: "count" });
        this.rowsHost = h("div", { class: "rows", role: "presentation" });
        this.scroller = h(
            "div",
            {
                class: "tree",
                role: "tree",
                "aria-label": "Robots",
                tabindex: 0,
                onscroll: () => this.draw(),
                onkeydown: (event: KeyboardEvent) => this.key(event),
            },
            this.rowsHost,
        );
        this.element = h(
            "aside",
            { class: "panel left", "aria-label": "Robots" },
            h("div", { class: "panel-head" }, h("h2", {}, "Robots"), this.count),
            h("div", { class: "search" }, icon("search"), this.search),
            this.scroller,
        );
        state.world.follow(() => this.rebuild());
        state.selected.follow((robot) => this.reveal(robot));
        new ResizeObserver(() => this.draw()).observe(this.scroller);
    }

    private rebuild(): void {
        const world = this.state.world.value,
            words = this.search.value.trim().toLowerCase();
        this.rows = world === null ? [] : this.rowsOf(world, words);
        const shown = this.rows.filter((row) => row.kind === "robot").length;
        this.count.textContent =
            world === null ? "" : words === "" ? String(world.fleet.count) : `${shown} of ${world.fleet.count}`;
        this.rowsHost.style.height = `${this.rows.length * ROW_PX}px`;
        this.draw();
    }

    private rowsOf(world: World, words: string): Row[] {
        const fleet = world.fleet,
            ofType: number[][] = fleet.scene.types.map(() => []);
        for (let r = 0; r < fleet.count; ++r)
            if (words === "" || fleet.name(r).toLowerCase().includes(words)) ofType[fleet.typeOf[r]].push(r);
        const used = ofType.filter((robots) => robots.length > 0).length,
            rows: Row[] = [];
        ofType.forEach((robots, type) => {
            if (robots.length === 0) return;
            const open = words !== "" || !this.closed.has(type);
            // A heading helps where types have several robots; one each would be headings only.
            const headed = robots.length > 1 && used > 1;
            if (headed) rows.push({ kind: "type", type, count: robots.length, open });
            if (open || !headed) for (const robot of robots) rows.push({ kind: "robot", robot });
        });
        return rows;
    }

    private draw(): void {
        const world = this.state.world.value;
        const first = Math.max(0, Math.floor(this.scroller.scrollTop / ROW_PX) - SPARE_ROWS);
        const last = Math.min(
            this.rows.length,
            Math.ceil((this.scroller.scrollTop + this.scroller.clientHeight) / ROW_PX) + SPARE_ROWS,
        );
        this.rowsHost.replaceChildren();
        if (world === null) return;
        for (let k = first; k < last; ++k) this.rowsHost.append(this.rowElement(world, k));
        this.scroller.setAttribute("aria-activedescendant", this.rows.length > 0 ? `row-${this.active}` : "");
    }

    private rowElement(world: World, k: number): HTMLElement {
        const row = this.rows[k],
            common = { id: `row-${k}`, role: "treeitem", style: `top:${k * ROW_PX}px` };
        if (row.kind === "type")
            return h(
                "div",
                {
                    ...common,
                    class: "row type",
                    "aria-expanded": String(row.open),
                    "aria-level": 1,
                    onclick: () => this.toggle(row.type),
                },
                h("span", { class: "twist", "aria-hidden": "true" }, row.open ? "▾" : "▸"),
                h("span", { class: "row-name" }, world.fleet.scene.types[row.type].name),
                h("span", { class: "count" }, String(row.count)),
            );
        const selected = this.state.selected.value === row.robot;
        return h(
            "div",
            {
                ...common,
                class: "row robot",
                "aria-selected": String(selected),
                "aria-level": 2,
                onclick: () => this.choose(k),
                ondblclick: () => this.onFocus(row.robot),
            },
            h("span", { class: "swatch", "aria-hidden": "true", style: `background:${swatch(world, row.robot)}` }),
            h("span", { class: "row-name" }, world.fleet.name(row.robot)),
        );
    }

    private toggle(type: number): void {
        if (!this.closed.delete(type)) this.closed.add(type);
        this.rebuild();
    }

    private choose(k: number): void {
        const row = this.rows[k];
        this.active = k;
        if (row?.kind === "robot" && !this.taken(row.robot)) this.state.selected.set(row.robot);
        this.draw();
    }

    /** By the arrow keys: on the way to a robot that shall be held, the selection stays. */
    private walk(k: number): void {
        if (this.state.attaching.value === null) return this.choose(k);
        this.active = k;
        this.draw();
    }

    private reveal(robot: number | null): void {
        const k = robot === null ? -1 : this.rows.findIndex((row) => row.kind === "robot" && row.robot === robot);
        if (k >= 0) {
            this.active = k;
            const top = k * ROW_PX,
                view = this.scroller;
            if (top < view.scrollTop || top + ROW_PX > view.scrollTop + view.clientHeight)
                view.scrollTop = top - view.clientHeight / 2;
        }
        this.draw();
    }

    private key(event: KeyboardEvent): void {
        const move = { ArrowDown: 1, ArrowUp: -1, PageDown: 15, PageUp: -15, Home: -1e9, End: 1e9 }[event.key];
        if (move !== undefined) {
            this.walk(Math.max(0, Math.min(this.rows.length - 1, this.active + move)));
            this.scroller.scrollTop = Math.min(
                this.active * ROW_PX,
                Math.max(this.scroller.scrollTop, (this.active + 1) * ROW_PX - this.scroller.clientHeight),
            );
        } else if (event.key === "Enter") {
            const row = this.rows[this.active];
            if (row?.kind === "robot" && this.state.attaching.value !== null) this.choose(this.active);
            else if (row?.kind === "robot") this.onFocus(row.robot);
            else if (row !== undefined) this.toggle(row.type);
        } else return;
        event.preventDefault();
        event.stopPropagation();
    }
}

function swatch(world: World, robot: number): string {
    const visual = world.fleet.type(robot).links.find((link) => link.visuals.length > 0)?.visuals[0],
        rgb = visual?.rgb ?? [0.6, 0.6, 0.6],
        picture = world.loaded.pictures.get(visual?.finish?.colour ?? ""),
        over = picture === undefined ? [1, 1, 1] : meanColour(picture);
    return `rgb(${rgb.map((part, k) => Math.round(part * over[k] * 255)).join(" ")})`;
}
