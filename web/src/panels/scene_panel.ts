// The scene tree: robots with their links, joints and sensors, scenery, lights; found by name, each with an eye and a
// lock. Only the rows in sight exist, so that two thousand robots cost no more than twenty.
import type { Selection } from "../model/selection";
import { allIn, treeRows, type TreeRow } from "../model/scene_tree";
import type { ViewerState, World } from "../model/viewer_state";
import { h, icon } from "../ui/dom";
import { throttled } from "../ui/throttle";
import { COARSE } from "../ui/touch";
import { rowElement } from "./scene_row";

/** A finger needs more room than a mouse. */
const ROW_PX = COARSE ? 44 : 26;
const SPARE_ROWS = 6;
const DOTS_EVERY_MS = 500;

export class ScenePanel {
    readonly element: HTMLElement;
    readonly search: HTMLInputElement;
    private readonly scroller: HTMLElement;
    private readonly rowsHost: HTMLElement;
    private readonly count: HTMLElement;
    private rows: TreeRow[] = [];
    private readonly folded = new Set<string>();
    private readonly unfolded = new Set<string>();
    private active = 0;
    /** From where Shift selects. */
    private anchor = 0;

    constructor(
        private readonly state: ViewerState,
        private readonly selection: Selection,
        private readonly onFocus: (robot: number) => void,
        /** Another hand wants the robot: true where it has it, and the selection stays. */
        private readonly taken: (robot: number) => boolean,
        bar: HTMLElement,
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
                "aria-label": "Scene",
                "aria-multiselectable": "true",
                tabindex: 0,
                style: `--row:${ROW_PX}px`,
                onscroll: () => this.draw(),
                onkeydown: (event: KeyboardEvent) => this.key(event),
            },
            this.rowsHost,
        );
        this.element = h(
            "aside",
            { class: "panel left", "aria-label": "Scene" },
            h("div", { class: "panel-head" }, h("h2", {}, "Scene"), this.count),
            bar,
            h("div", { class: "search" }, icon("search"), this.search),
            this.scroller,
        );
        this.follow();
        new ResizeObserver(() => this.draw()).observe(this.scroller);
        state.dots.follow(throttled(DOTS_EVERY_MS, () => this.draw()));
    }

    private follow(): void {
        const { state } = this;
        state.world.follow(() => this.rebuild());
        state.selected.follow((robot) => this.reveal(robot));
        state.others.follow(() => this.draw());
        state.scenery.follow(() => this.draw());
        state.sight.hidden.follow(() => this.draw());
        state.sight.locked.follow(() => this.draw());
    }

    private rebuild(): void {
        const world = this.state.world.value,
            words = this.search.value.trim().toLowerCase(),
            key = this.rows[this.active]?.key;
        this.rows = world === null ? [] : treeRows(world.fleet.scene, words, this.folded, this.unfolded);
        this.active = Math.max(
            0,
            this.rows.findIndex((row) => row.key === key),
        );
        const shown = this.rows.find((row) => row.key === "robots")?.count ?? 0;
        this.count.textContent =
            world === null ? "" : words === "" ? String(world.fleet.count) : `${shown} of ${world.fleet.count}`;
        this.rowsHost.style.height = `${this.rows.length * ROW_PX}px`;
        this.draw();
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
        for (let k = first; k < last; ++k) this.rowsHost.append(this.row(world, k));
        // Only what is in the document can be named.
        if (this.active >= first && this.active < last)
            this.scroller.setAttribute("aria-activedescendant", `row-${this.active}`);
        else this.scroller.removeAttribute("aria-activedescendant");
    }

    private row(world: World, k: number): HTMLElement {
        const row = this.rows[k],
            { sight } = this.state;
        return rowElement(world, row, {
            id: `row-${k}`,
            top: k * ROW_PX,
            active: k === this.active,
            selected: this.isSelected(row),
            hidden: allIn(row, sight.hidden.value),
            locked: allIn(row, sight.locked.value),
            dot: row.robot === undefined ? undefined : this.state.dots.value?.(row.robot),
            choose: (event) => this.choose(k, event),
            focus: () => row.robot !== undefined && this.onFocus(row.robot),
            fold: () => this.fold(row),
            hide: (on) => sight.hide(row.sight, on),
            lock: (on) => sight.lock(row.sight, on),
        });
    }

    private isSelected(row: TreeRow): boolean {
        if (row.kind === "robot") return this.selection.has(row.robot ?? -1);
        return row.kind === "scenery" && this.state.scenery.value === row.text;
    }

    private fold(row: TreeRow): void {
        if (row.open === null) return;
        const [set, add] = row.kind === "robot" ? [this.unfolded, !row.open] : [this.folded, row.open];
        if (add) set.add(row.key);
        else set.delete(row.key);
        this.rebuild();
    }

    private choose(k: number, event: { ctrlKey: boolean; metaKey: boolean; shiftKey: boolean }): void {
        const row = this.rows[k],
            robot = row?.robot,
            from = this.anchor;
        this.active = k;
        if (row === undefined) return;
        if (row.kind === "scenery") this.selection.scenery(row.text);
        else if (robot === undefined) return this.fold(row);
        else if (this.taken(robot)) this.draw();
        else if (event.shiftKey) this.chooseRange(from, k);
        else if (event.ctrlKey || event.metaKey) this.selection.toggle(robot);
        else this.selection.only(robot);
        if (!event.shiftKey) this.anchor = k;
        this.draw();
    }

    private chooseRange(from: number, to: number): void {
        const robots = this.rows
            .slice(Math.min(from, to), Math.max(from, to) + 1)
            .filter((row) => row.kind === "robot")
            .map((row) => row.robot ?? 0);
        this.selection.set(robots);
    }

    /** By the arrow keys: on the way to a robot that shall be held, the selection stays. */
    private walk(k: number, event: KeyboardEvent): void {
        const row = this.rows[k],
            stays = this.state.attaching.value !== null || event.ctrlKey || event.metaKey;
        if (row !== undefined && (row.kind === "robot" || row.kind === "scenery") && !stays) this.choose(k, event);
        this.active = k;
        this.draw();
    }

    private reveal(robot: number | null): void {
        const k = robot === null ? -1 : this.rows.findIndex((row) => row.kind === "robot" && row.robot === robot);
        if (k >= 0 && this.rows[this.active]?.robot !== robot) {
            this.active = this.anchor = k;
            const top = k * ROW_PX,
                view = this.scroller;
            if (top < view.scrollTop || top + ROW_PX > view.scrollTop + view.clientHeight)
                view.scrollTop = top - view.clientHeight / 2;
        }
        this.draw();
    }

    private key(event: KeyboardEvent): void {
        const move = { ArrowDown: 1, ArrowUp: -1, PageDown: 15, PageUp: -15, Home: -1e9, End: 1e9 }[event.key],
            row = this.rows[this.active];
        if (move !== undefined) {
            this.walk(Math.max(0, Math.min(this.rows.length - 1, this.active + move)), event);
            this.bringIntoView();
        } else if (event.key === "Enter") this.enter(row);
        else if (event.key === "ArrowRight" && row?.open === false) this.fold(row);
        else if (event.key === "ArrowLeft") this.leave(row);
        else if (event.key === " " && (event.ctrlKey || event.metaKey) && row?.robot !== undefined)
            this.selection.toggle(row.robot);
        else if (event.key === "e" && row !== undefined)
            this.state.sight.hide(row.sight, !allIn(row, this.state.sight.hidden.value));
        else if (event.key === "l" && row !== undefined && row.kind !== "link")
            this.state.sight.lock(row.sight, !allIn(row, this.state.sight.locked.value));
        else return;
        event.preventDefault();
        event.stopPropagation();
    }

    private bringIntoView(): void {
        this.scroller.scrollTop = Math.min(
            this.active * ROW_PX,
            Math.max(this.scroller.scrollTop, (this.active + 1) * ROW_PX - this.scroller.clientHeight),
        );
    }

    private enter(row: TreeRow | undefined): void {
        if (row === undefined) return;
        const plain = { ctrlKey: false, metaKey: false, shiftKey: false };
        if (row.kind === "scenery" || (row.robot !== undefined && this.state.attaching.value !== null))
            this.choose(this.active, plain);
        else if (row.robot !== undefined) this.onFocus(row.robot);
        else this.fold(row);
    }

    /** Folds the row, or goes to the one that it is below. */
    private leave(row: TreeRow | undefined): void {
        if (row?.open === true) return this.fold(row);
        let k = this.active;
        while (k > 0 && this.rows[k].level >= (row?.level ?? 0)) --k;
        this.active = k;
        this.bringIntoView();
        this.draw();
    }
}
