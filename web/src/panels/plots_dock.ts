// The dock below the picture: any number of plots, each of any variables of any robots. Time is shared: cursor, zoom, pause.
import { csvOf } from "../model/plot_data";
import type { Curve, Plotted } from "../model/plotted";
import type { ViewerState } from "../model/viewer_state";
import { h, iconButton, setText } from "../ui/dom";
import { download } from "../ui/download";
import { moreMenu } from "../ui/overflow";
import { throttled } from "../ui/throttle";
import { plotPicture } from "./plot_picture";
import { plotPicker } from "./plot_picker";
import { PlotChart, type TimeWindow } from "./plot_chart";

const WINDOWS: [string, string][] = [
    ["", "all of it"],
    ["120", "last 2 min"],
    ["30", "last 30 s"],
    ["10", "last 10 s"],
];

export class PlotsDock {
    readonly element: HTMLElement;
    private readonly charts = h("div", { class: "charts" });
    private readonly heading = h("h2", {}, "Plots");
    private readonly hint = h(
        "p",
        { class: "empty" },
        "Nothing is plotted. Choose the graph beside a number of a robot, or a robot and a variable above.",
    );
    private readonly waits = h(
        "p",
        { class: "empty plots-wait", role: "status", hidden: true },
        "The run is paused: curves grow when it plays.",
    );
    private readonly pause: HTMLButtonElement;
    private readonly back: HTMLButtonElement;
    private readonly unwrap = h("input", { type: "checkbox", checked: true, onchange: () => this.refresh() });
    private shown: PlotChart[] = [];
    private paused = false;
    private readonly time: TimeWindow = { last: null, fixed: null };

    constructor(
        private readonly state: ViewerState,
        private readonly plotted: Plotted,
    ) {
        const windows = h(
            "select",
            { "aria-label": "Time shown", title: "Time shown", onchange: () => this.setWindow(windows.value) },
            ...WINDOWS.map(([value, words]) => h("option", { value }, words)),
        );
        this.pause = iconButton("pause", "Hold the plots", () => this.hold(), "", "Hold");
        this.pause.setAttribute("aria-pressed", "false");
        this.back = h("button", { type: "button", class: "small", onclick: () => this.zoom(null) }, "Whole time");
        this.back.hidden = true;
        const head = h(
            "div",
            { class: "panel-head dock-head" },
            this.heading,
            plotPicker(state, plotted),
            h("div", { class: "grow" }),
            this.back,
            windows,
            this.pause,
            h("label", { class: "plot-switch", "data-yields": 3 }, this.unwrap, "Angles unwrapped"),
            h(
                "div",
                { class: "cluster-of-buttons", role: "group", "aria-label": "Export", "data-yields": 2 },
                h("button", { type: "button", class: "small", onclick: () => this.saveTable() }, "CSV"),
                h("button", { type: "button", class: "small", onclick: () => this.savePicture() }, "PNG"),
            ),
            iconButton("remove", "Remove all plots", () => plotted.clear()),
        );
        windows.dataset.yields = "1";
        const more = moreMenu(head, "More of plots", true);
        head.append(more.button);
        this.element = h(
            "section",
            { class: "dock empty", "aria-label": "Plots" },
            head,
            more.menu,
            this.hint,
            this.waits,
            this.charts,
        );
        plotted.curves.follow(() => this.rebuild());
        state.theme.follow(() => setTimeout(() => this.rebuild()));
        state.status.follow(() => this.wait());
        const grown = throttled(100, () => !this.paused && this.refresh());
        plotted.grown.follow(grown);
        const sized = throttled(100, () => {
            more.fit();
            this.refresh();
        });
        new ResizeObserver(() => sized()).observe(this.charts);
    }

    /** Opens the dock although nothing is plotted yet. */
    open(): void {
        this.element.classList.remove("empty");
    }

    private rebuild(): void {
        this.shown.forEach((chart) => chart.dispose());
        const curves = this.plotted.curves.value,
            plots = [...new Set(curves.map((curve) => curve.plot))],
            robots = new Set(curves.map((curve) => curve.robotName));
        this.element.classList.toggle("empty", curves.length === 0);
        this.hint.hidden = curves.length > 0;
        setText(this.heading, robots.size === 1 ? `Plots of ${curves[0].robotName}` : "Plots");
        const colour = (curve: Curve) => curves.indexOf(curve);
        this.shown = plots.map(
            (plot) =>
                new PlotChart(
                    curves.filter((curve) => curve.plot === plot),
                    colour,
                    robots.size === 1,
                    {
                        unwrap: () => this.unwrap.checked,
                        window: () => this.time,
                        zoom: (range) => this.zoom(range),
                        remove: (curve) => this.plotted.remove(curve),
                    },
                ),
        );
        this.charts.replaceChildren(...this.shown.map((chart) => chart.element));
        this.refresh();
    }

    private refresh(): void {
        this.shown.forEach((chart) => chart.refresh());
        this.wait();
    }

    /** A plot of a paused run looks broken unless it says why it is empty. */
    private wait(): void {
        const curves = this.plotted.curves.value,
            begun = curves.some(({ times }) => times.length > 1);
        this.waits.hidden = curves.length === 0 || begun || this.state.status.value?.paused !== true;
    }

    private zoom(range: [number, number] | null): void {
        this.time.fixed = range;
        this.back.hidden = range === null;
        this.refresh();
    }

    private setWindow(value: string): void {
        this.time.last = value === "" ? null : Number(value);
        this.zoom(null);
    }

    private hold(): void {
        this.paused = !this.paused;
        this.pause.setAttribute("aria-pressed", String(this.paused));
        if (!this.paused) this.refresh();
    }

    private fileName(): string {
        return `${this.state.world.value?.fleet.scene.world ?? "roboss"}_plots`.replace(/\s+/g, "_");
    }

    private saveTable(): void {
        download(new Blob([csvOf(this.plotted.curves.value)], { type: "text/csv" }), `${this.fileName()}.csv`);
    }

    private savePicture(): void {
        plotPicture(this.shown).toBlob((blob) => blob !== null && download(blob, `${this.fileName()}.png`));
    }
}
