// The dock below the picture: one uPlot for each unit, with the curves that were asked for in the inspector.
import uPlot from "uplot";
import type { Curve, Plotted } from "../model/plotted";
import type { ViewerState } from "../model/viewer_state";
import { h, iconButton, setText } from "../ui/dom";
import { fixed } from "../ui/numbers";
import { throttled } from "../ui/throttle";
import { groupCss } from "../view/palette";

const HEIGHT_PX = 168;

/** Curves of one unit on one time axis: uPlot wants them joined. */
function joined(curves: readonly Curve[]): uPlot.AlignedData {
    return uPlot.join(curves.map((curve) => [curve.times, curve.values] as uPlot.AlignedData));
}

function cssColour(name: string): string {
    return getComputedStyle(document.body).getPropertyValue(name).trim();
}

export function plotAxes(unit: string): uPlot.Axis[] {
    const axis = {
        stroke: () => cssColour("--dim"),
        font: "11px system-ui, sans-serif",
        ticks: { show: false },
        grid: { stroke: () => cssColour("--line"), width: 1 },
    };
    return [
        {
            ...axis,
            space: 60,
            size: 26,
            values: (_: uPlot, splits: number[]) => splits.map((value) => `${fixed(value, value % 1 === 0 ? 0 : 1)} s`),
        },
        {
            ...axis,
            size: 52,
            space: 26,
            label: unit === "" ? undefined : unit,
            labelSize: 14,
            labelFont: "11px system-ui, sans-serif",
            labelGap: 0,
        },
    ];
}

/** A constant is a line in the middle, not noise blown up. */
export function valueRange(_: uPlot, least: number | null, most: number | null): [number, number] {
    if (least === null || most === null) return [0, 1];
    const middle = (least + most) / 2,
        half = Math.max((most - least) * 0.55, Math.abs(middle) * 0.02, 0.005);
    return [middle - half, middle + half];
}

class Chart {
    readonly element: HTMLElement;
    private readonly plot: uPlot;

    constructor(
        unit: string,
        readonly curves: readonly Curve[],
        offset: number,
        plotted: Plotted,
    ) {
        const host = h("div", { class: "chart-canvas" }),
            legend = h("div", { class: "chart-legend" });
        const alone = plotted.curves.value.every((curve) => curve.robot === curves[0].robot);
        curves.forEach((curve, k) => {
            const words = `${curve.robotName} ${curve.label}`;
            legend.append(
                h(
                    "span",
                    { class: "chart-key", title: words },
                    h("span", { class: "swatch", style: `background:${groupCss(offset + k)}` }),
                    h("span", { class: "chart-words" }, alone ? curve.label : words),
                    iconButton("close", `Remove ${words}`, () =>
                        plotted.toggle(curve.robot, curve.key, curve.label, curve.unit),
                    ),
                ),
            );
        });
        this.element = h("div", { class: "chart" }, legend, host);
        this.plot = new uPlot(
            {
                width: 300,
                height: HEIGHT_PX - 34,
                legend: { show: false },
                cursor: { y: false, points: { size: 6 } },
                scales: { x: { time: false }, y: { range: valueRange } },
                axes: plotAxes(unit),
                series: [
                    {},
                    ...curves.map((curve, k) => ({
                        label: curve.label,
                        stroke: groupCss(offset + k),
                        width: 1.5,
                        spanGaps: true,
                        points: { show: false },
                    })),
                ],
            },
            joined(curves),
            host,
        );
    }

    refresh(): void {
        const width = this.element.clientWidth;
        if (width > 0 && width !== this.plot.width) this.plot.setSize({ width, height: HEIGHT_PX - 34 });
        this.plot.setData(joined(this.curves));
    }

    dispose(): void {
        this.plot.destroy();
    }
}

export function plotsDock(state: ViewerState, plotted: Plotted): HTMLElement {
    const charts = h("div", { class: "charts" }),
        heading = h("h2", {}, "Plots"),
        hint = h("p", { class: "empty" }, "Nothing is plotted. Select a robot, and choose the graph beside a number.");
    const element = h(
        "section",
        { class: "dock empty", "aria-label": "Plots" },
        h(
            "div",
            { class: "panel-head" },
            heading,
            h("div", { class: "grow" }),
            iconButton("close", "Remove all plots", () => plotted.clear()),
        ),
        hint,
        charts,
    );
    let shown: Chart[] = [];
    const rebuild = () => {
        shown.forEach((chart) => chart.dispose());
        const curves = plotted.curves.value,
            units = [...new Set(curves.map((curve) => curve.unit))];
        let offset = 0;
        element.classList.toggle("empty", curves.length === 0);
        hint.hidden = curves.length > 0;
        const robots = new Set(curves.map((curve) => curve.robotName));
        setText(heading, robots.size === 1 ? `Plots of ${curves[0].robotName}` : "Plots");
        shown = units.map((unit) => {
            const mine = curves.filter((curve) => curve.unit === unit),
                chart = new Chart(unit, mine, offset, plotted);
            offset += mine.length;
            return chart;
        });
        charts.replaceChildren(...shown.map((chart) => chart.element));
        shown.forEach((chart) => chart.refresh());
    };
    plotted.curves.follow(rebuild);
    state.theme.follow(() => setTimeout(rebuild));
    const refresh = throttled(100, () => shown.forEach((chart) => chart.refresh()));
    plotted.grown.follow(refresh);
    new ResizeObserver(() => refresh()).observe(charts);
    return element;
}
