// One plot: uPlot with an axis for each unit, a legend that shows the values under the cursor, and time that is zoomed and
// moved together with the other plots.
import uPlot from "uplot";
import { turnOf, tableOf, unwrapped } from "../model/plot_data";
import type { Curve } from "../model/plotted";
import { markText } from "../model/timeline";
import { h, iconButton, setText } from "../ui/dom";
import { fixed } from "../ui/numbers";
import { groupCss } from "../view/palette";

const HEIGHT_PX = 150;
const SYNC = "roboss-plots";
const WHEEL_ZOOM = 0.0015;
const SPAN_LEAST_S = 2;

/** The time that all plots show. */
export interface TimeWindow {
    /** s: the last seconds; null: all. */
    last: number | null;
    /** Zoomed by hand; null: not. */
    fixed: [number, number] | null;
}

export interface ChartNeeds {
    unwrap(): boolean;
    window(): TimeWindow;
    zoom(range: [number, number] | null): void;
    remove(curve: Curve): void;
}

export function cssColour(name: string): string {
    return getComputedStyle(document.body).getPropertyValue(name).trim();
}

function axisLook(): uPlot.Axis {
    return {
        stroke: () => cssColour("--dim"),
        font: "11px system-ui, sans-serif",
        ticks: { show: false },
        grid: { stroke: () => cssColour("--line"), width: 1 },
    };
}

export function plotAxes(unit: string): uPlot.Axis[] {
    return [timeAxis(), valueAxis(unit)];
}

function timeAxis(): uPlot.Axis {
    return {
        ...axisLook(),
        space: 60,
        size: 26,
        values: (_: uPlot, splits: number[]) => splits.map(markText),
    };
}

function valueAxis(unit: string, scale = "y", side: 3 | 1 = 3): uPlot.Axis {
    return {
        ...axisLook(),
        scale,
        side,
        size: 52,
        space: 26,
        label: unit === "" ? undefined : unit,
        labelSize: 14,
        labelFont: "11px system-ui, sans-serif",
        labelGap: 0,
    };
}

/** A constant is a line in the middle, not noise blown up. */
export function valueRange(_: uPlot, least: number | null, most: number | null): [number, number] {
    if (least === null || most === null) return [0, 1];
    const middle = (least + most) / 2,
        half = Math.max((most - least) * 0.55, Math.abs(middle) * 0.02, 0.005);
    return [middle - half, middle + half];
}

/** The time shown: what there is, or its last seconds; at least a few, where there is hardly anything yet. */
export function timeSpan(times: ArrayLike<number>, last: number | null): [number, number] {
    if (times.length === 0) return [0, SPAN_LEAST_S];
    const least = times[0],
        most = times[times.length - 1];
    if (last !== null) return [most - last, most];
    return most - least < SPAN_LEAST_S ? [least, least + SPAN_LEAST_S] : [least, most];
}

export class PlotChart {
    readonly element: HTMLElement;
    readonly plot: uPlot;
    private readonly values: HTMLElement[] = [];

    constructor(
        readonly curves: readonly Curve[],
        private readonly colour: (curve: Curve) => number,
        alone: boolean,
        private readonly needs: ChartNeeds,
    ) {
        const host = h("div", { class: "chart-canvas" }),
            legend = h("div", { class: "chart-legend" });
        for (const curve of curves) legend.append(this.key(curve, alone));
        this.element = h("div", { class: "chart" }, legend, host);
        const units = [...new Set(curves.map((curve) => curve.unit))],
            scale = (unit: string) => `y${units.indexOf(unit)}`;
        this.plot = new uPlot(
            {
                width: 300,
                height: HEIGHT_PX,
                legend: { show: false },
                cursor: { y: false, points: { size: 6 }, sync: { key: SYNC }, drag: { x: true, y: false } },
                scales: {
                    x: { time: false, range: (plot) => this.timeRange(plot.data[0]) },
                    ...Object.fromEntries(units.map((unit) => [scale(unit), { range: valueRange }])),
                },
                axes: [timeAxis(), ...units.map((unit, k) => valueAxis(unit, scale(unit), k === 0 ? 3 : 1))],
                series: [
                    {},
                    ...curves.map((curve) => ({
                        label: curve.label,
                        scale: scale(curve.unit),
                        stroke: groupCss(colour(curve)),
                        width: 1.5,
                        spanGaps: true,
                        // A line needs two.
                        points: { show: (plot: uPlot) => plot.data[0].length === 1, size: 7 },
                    })),
                ],
                hooks: { setCursor: [(plot) => this.showValues(plot)], setSelect: [(plot) => this.chosen(plot)] },
            },
            this.data(),
            host,
        );
        this.plot.over.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
        this.plot.over.addEventListener("dblclick", () => this.needs.zoom(null));
    }

    private key(curve: Curve, alone: boolean): HTMLElement {
        const words = `${curve.robotName} ${curve.label}`,
            value = h("span", { class: "chart-value" });
        this.values.push(value);
        return h(
            "span",
            { class: "chart-key", title: words },
            h("span", { class: "swatch", style: `background:${groupCss(this.colour(curve))}` }),
            h("span", { class: "chart-words" }, alone ? curve.label : words),
            value,
            iconButton("close", `Remove ${words}`, () => this.needs.remove(curve)),
        );
    }

    private data(): uPlot.AlignedData {
        const unwrap = this.needs.unwrap();
        return tableOf(
            this.curves.map((curve) =>
                unwrap && turnOf(curve) > 0 ? { ...curve, values: unwrapped(curve.values, turnOf(curve)) } : curve,
            ),
        ) as uPlot.AlignedData;
    }

    private timeRange(times: ArrayLike<number>): [number, number] {
        const { last, fixed: zoomed } = this.needs.window();
        if (zoomed !== null) return zoomed;
        return timeSpan(times, last);
    }

    /** Under the cursor; without one, the last values. */
    private showValues(plot: uPlot): void {
        const at = plot.cursor.idx ?? null;
        this.values.forEach((value, k) => {
            const column = plot.data[k + 1];
            let row = at ?? column.length - 1;
            while (row >= 0 && (column[row] === null || column[row] === undefined)) --row;
            setText(value, row < 0 ? "–" : fixed(column[row], 3));
        });
    }

    private chosen(plot: uPlot): void {
        const { left, width } = plot.select;
        if (width < 4) return;
        this.needs.zoom([plot.posToVal(left, "x"), plot.posToVal(left + width, "x")]);
        plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    }

    /** Zooms about the cursor; with Shift, or sideways, moves through time. */
    private wheel(event: WheelEvent): void {
        event.preventDefault();
        const { min, max } = this.plot.scales.x;
        if (min === undefined || max === undefined) return;
        const span = max - min,
            sideways = event.shiftKey ? event.deltaY + event.deltaX : event.deltaX;
        if (Math.abs(sideways) > Math.abs(event.shiftKey ? 0 : event.deltaY)) {
            const by = (sideways / this.plot.over.clientWidth) * span;
            return this.needs.zoom([min + by, max + by]);
        }
        const at = this.plot.posToVal(event.offsetX, "x"),
            factor = Math.exp(Math.max(-200, Math.min(200, event.deltaY)) * WHEEL_ZOOM);
        this.needs.zoom([at - (at - min) * factor, at + (max - at) * factor]);
    }

    refresh(): void {
        const width = this.element.clientWidth;
        if (width > 0 && width !== this.plot.width) this.plot.setSize({ width, height: HEIGHT_PX });
        this.plot.setData(this.data());
        this.showValues(this.plot);
    }

    dispose(): void {
        this.plot.destroy();
    }
}
