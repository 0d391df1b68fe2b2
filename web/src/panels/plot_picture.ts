// All plots in one picture, with their legends, as they are shown.
import { cssColour, type PlotChart } from "./plot_chart";
import { groupCss } from "../view/palette";

const LEGEND_PX = 24;

export function plotPicture(charts: readonly PlotChart[]): HTMLCanvasElement {
    const canvas = document.createElement("canvas"),
        scale = window.devicePixelRatio,
        each = charts.map((chart) => chart.plot.ctx.canvas);
    canvas.width = Math.max(1, ...each.map((one) => one.width));
    canvas.height = each.reduce((sum, one) => sum + one.height + LEGEND_PX * scale, 0) || 1;
    const draw = canvas.getContext("2d");
    if (draw === null) return canvas;
    draw.fillStyle = cssColour("--panel");
    draw.fillRect(0, 0, canvas.width, canvas.height);
    draw.font = `${12 * scale}px system-ui, sans-serif`;
    draw.textBaseline = "middle";
    let top = 0,
        colour = 0;
    for (const [k, chart] of charts.entries()) {
        let left = 8 * scale;
        for (const curve of chart.curves) {
            const words = `${curve.robotName} ${curve.label}${curve.unit === "" ? "" : ` [${curve.unit}]`}`;
            draw.fillStyle = groupCss(colour++);
            draw.fillRect(left, top + 8 * scale, 9 * scale, 9 * scale);
            draw.fillStyle = cssColour("--text");
            draw.fillText(words, left + 14 * scale, top + 13 * scale);
            left += draw.measureText(words).width + 30 * scale;
        }
        draw.drawImage(each[k], 0, top + LEGEND_PX * scale);
        top += each[k].height + LEGEND_PX * scale;
    }
    return canvas;
}
