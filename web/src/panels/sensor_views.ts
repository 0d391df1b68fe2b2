// Sensors as people read them: a laser as a small map of its beams, a compass as a dial, what cameras
// and microphones perceive as a list, the rest as numbers.
import { perceived, type Reading } from "../model/readings";
import { h } from "../ui/dom";
import { fixed } from "../ui/numbers";
import type { RobotReport, SensorInfo, TypeInfo } from "../wire/messages";
import { beamAngle } from "../overlays/beams";
import type { ReadingRows } from "./reading_rows";

const MAP_PX = 132;

interface View {
    element: HTMLElement;
    show: (report: RobotReport) => void;
}

function prepared(canvas: HTMLCanvasElement, width: number, height: number): CanvasRenderingContext2D | null {
    const scale = window.devicePixelRatio || 1;
    if (canvas.width !== Math.round(width * scale)) {
        canvas.width = Math.round(width * scale);
        canvas.height = Math.round(height * scale);
        canvas.style.width = `${width}px`;
        canvas.style.height = `${height}px`;
    }
    const draw = canvas.getContext("2d");
    draw?.setTransform(scale, 0, 0, scale, 0, 0);
    draw?.clearRect(0, 0, width, height);
    return draw;
}

function colours(): { line: string; dim: string; accent: string } {
    const style = getComputedStyle(document.body),
        get = (name: string) => style.getPropertyValue(name).trim();
    return { line: get("--line"), dim: get("--dim"), accent: get("--accent") };
}

/** Beams from above; forwards is up. */
function laserView(sensor: SensorInfo, index: number): View {
    const canvas = h("canvas", { class: "laser-map", role: "img", "aria-label": `Ranges of ${sensor.name}` });
    const show = (report: RobotReport) => {
        const ranges = report.sensors[index]?.ranges,
            draw = prepared(canvas, 2 * MAP_PX, MAP_PX + 12);
        if (ranges === undefined || draw === null) return;
        const most = sensor.range_max ?? 10,
            scale = (MAP_PX - 6) / most,
            cx = MAP_PX,
            cy = MAP_PX + 2,
            { line, accent } = colours();
        draw.strokeStyle = line;
        for (let ring = 1; ring <= 3; ++ring) {
            draw.beginPath();
            draw.arc(cx, cy, (ring / 3) * most * scale, Math.PI, 2 * Math.PI);
            draw.stroke();
        }
        const columns = sensor.samples ?? ranges.length;
        draw.beginPath();
        draw.moveTo(cx, cy);
        for (let k = 0; k < columns; ++k) {
            const range = Math.min(most, ranges[k] ?? most),
                angle = beamAngle(sensor, k);
            draw.lineTo(cx - Math.sin(angle) * range * scale, cy - Math.cos(angle) * range * scale);
        }
        draw.closePath();
        draw.globalAlpha = 0.22;
        draw.fillStyle = accent;
        draw.fill();
        draw.globalAlpha = 1;
        draw.strokeStyle = accent;
        draw.stroke();
    };
    return { element: canvas, show };
}

function compassView(sensor: SensorInfo, index: number): View {
    const canvas = h("canvas", { class: "dial", role: "img", "aria-label": `Heading of ${sensor.name}` });
    const show = (report: RobotReport) => {
        const yaw = report.sensors[index]?.yaw,
            draw = prepared(canvas, 64, 64);
        if (typeof yaw !== "number" || draw === null) return;
        const { dim, accent } = colours();
        draw.strokeStyle = draw.fillStyle = dim;
        draw.beginPath();
        draw.arc(32, 32, 29, 0, 2 * Math.PI);
        draw.stroke();
        draw.font = "9px system-ui, sans-serif";
        draw.textAlign = "center";
        draw.textBaseline = "middle";
        for (const [text, x, y] of [
            ["N", 32, 9],
            ["E", 55, 32],
            ["S", 32, 55],
            ["W", 9, 32],
        ] as const)
            draw.fillText(text, x, y);
        const dx = Math.cos(yaw),
            dy = -Math.sin(yaw);
        draw.strokeStyle = draw.fillStyle = accent;
        draw.lineWidth = 2;
        draw.beginPath();
        draw.moveTo(32 - dx * 14, 32 - dy * 14);
        draw.lineTo(32 + dx * 18, 32 + dy * 18);
        draw.stroke();
        draw.beginPath();
        draw.arc(32 + dx * 18, 32 + dy * 18, 3, 0, 2 * Math.PI);
        draw.fill();
        draw.lineWidth = 1;
    };
    return { element: canvas, show };
}

/** The models that a logical camera sees, or the sources that a microphone hears. */
function perceptionView(sensor: SensorInfo, index: number): View {
    const list = h("ul", { class: "perceived", "aria-label": `What ${sensor.name} perceives` });
    let shown: string | null = null;
    const show = (report: RobotReport) => {
        const lines = (perceived(report.sensors[index] ?? {}) ?? []).map(({ name, value, unit }) =>
                `${name} ${fixed(value, 2)} ${unit}`.trim(),
            ),
            text = lines.join("\n");
        if (text === shown) return;
        shown = text;
        list.replaceChildren(...(lines.length > 0 ? lines : ["nothing"]).map((line) => h("li", {}, line)));
    };
    return { element: list, show };
}

export class SensorViews {
    readonly element = h("div", { class: "sensors" });
    private readonly views: View[] = [];

    constructor(type: TypeInfo, rows: ReadingRows, all: readonly (readonly Reading[])[]) {
        type.sensors.forEach((sensor, index) => {
            const view =
                sensor.kind === "laser"
                    ? laserView(sensor, index)
                    : sensor.kind === "compass"
                      ? compassView(sensor, index)
                      : sensor.kind === "logical camera" || sensor.kind === "microphone"
                        ? perceptionView(sensor, index)
                        : null;
            if (view !== null) this.views.push(view);
            const prefix = `${sensor.name} `;
            this.element.append(
                h(
                    "div",
                    { class: "sensor" },
                    h(
                        "div",
                        { class: "joint-head" },
                        h("span", { class: "joint-name" }, sensor.name),
                        h("span", { class: "kind" }, sensor.kind),
                    ),
                    view?.element ?? null,
                    ...all[index].map((reading) =>
                        rows.row(
                            reading,
                            reading.label.startsWith(prefix) ? reading.label.slice(prefix.length) : reading.label,
                        ),
                    ),
                ),
            );
        });
    }

    show(report: RobotReport): void {
        for (const view of this.views) view.show(report);
    }
}
