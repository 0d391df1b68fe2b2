// One picture of a camera: colours as they are, numbers and labels in colours, boxes over it; a scale below, and what lies
// under the pointer.
import { type CameraPicture, pixelsOf } from "../model/cameras";
import { type ColourMap, cssOf, gradientOf, labelColour, paintNumbers } from "../model/colour_maps";
import { h, setText } from "../ui/dom";
import { fixed } from "../ui/numbers";

const SVG = "http://www.w3.org/2000/svg";
/** Of a box: corners that differ in one coordinate. */
const EDGES = Array.from({ length: 8 }, (_, a) =>
    [1, 2, 4].filter((bit) => (a & bit) === 0).map((bit) => [a, a | bit]),
).flat();

export class CameraView {
    readonly element: HTMLElement;
    private readonly canvas: HTMLCanvasElement;
    private readonly marks = h("div", { class: "camera-marks", "aria-hidden": "true" });
    private readonly scale = h("div", { class: "camera-scale", hidden: true });
    private readonly reading = h("span", { class: "camera-reading", "aria-live": "off" });
    private picture: CameraPicture | null = null;
    private pointer: { x: number; y: number } | null = null;

    constructor(
        words: string,
        private readonly map: () => ColourMap,
        private readonly full = true,
    ) {
        this.canvas = h("canvas", { class: "camera-canvas", role: "img", "aria-label": words, width: 4, height: 3 });
        this.element = h(
            "div",
            { class: full ? "camera-view" : "camera-view small-view" },
            h("div", { class: "camera-frame" }, this.canvas, this.marks),
            full ? this.scale : null,
            full ? this.reading : null,
        );
        if (!full) return;
        this.canvas.addEventListener("pointermove", (event) => {
            const box = this.canvas.getBoundingClientRect();
            this.pointer = { x: (event.clientX - box.left) / box.width, y: (event.clientY - box.top) / box.height };
            this.read();
        });
        this.canvas.addEventListener("pointerleave", () => {
            this.pointer = null;
            this.read();
        });
    }

    show(picture: CameraPicture | null): void {
        this.picture = picture;
        this.element.classList.toggle("waits", picture === null);
        if (picture === null) return;
        const { columns, rows } = picture.about;
        if (this.canvas.width !== columns || this.canvas.height !== rows) {
            this.canvas.width = columns;
            this.canvas.height = rows;
        }
        this.draw(picture);
        this.showMarks(picture);
        this.showScale(picture);
        this.read();
    }

    private draw(picture: CameraPicture): void {
        const draw = this.canvas.getContext("2d"),
            { columns, rows, low = 0, high = 0 } = picture.about;
        if (draw === null) return;
        if (picture.image !== null) return draw.drawImage(picture.image, 0, 0);
        let pixels: Uint8ClampedArray<ArrayBuffer>;
        if (picture.values !== null) pixels = paintNumbers(picture.values, low, high, this.mapOf(picture));
        else {
            const told = picture.pixels ?? new Uint8ClampedArray(4 * columns * rows);
            pixels = new Uint8ClampedArray(told.length);
            for (let i = 0; i < told.length; i += 4) {
                pixels.set(labelColour(told[i], 256 * told[i + 1] + told[i + 2]), i);
                pixels[i + 3] = 255;
            }
        }
        draw.putImageData(new ImageData(pixels, columns, rows), 0, 0);
    }

    private mapOf(picture: CameraPicture): ColourMap {
        return picture.about.shows === "temperature" ? "thermal" : this.map();
    }

    /** Boxes in shares of the picture, so that they grow with it. */
    private showMarks({ about }: CameraPicture): void {
        const { columns, rows, boxes = [], corners = [], labels = [] } = about,
            percent = (value: number, of: number) => `${((100 * value) / of).toFixed(2)}%`,
            marks: Element[] = [];
        const name = (k: number, left: number, top: number) => {
            const mark = h("span", { class: "camera-label" }, `label ${labels[k] ?? "?"}`);
            mark.style.left = percent(Math.max(0, Math.min(columns, left)), columns);
            mark.style.top = percent(Math.max(0, Math.min(rows, top)), rows);
            mark.style.background = cssOf(labelColour(labels[k] ?? 0));
            return mark;
        };
        boxes.forEach(([left, top, right, bottom], k) => {
            const mark = h("div", { class: "camera-box" });
            mark.style.left = percent(left, columns);
            mark.style.top = percent(top, rows);
            mark.style.width = percent(right - left, columns);
            mark.style.height = percent(bottom - top, rows);
            mark.style.borderColor = cssOf(labelColour(labels[k] ?? 0));
            marks.push(mark);
            if (this.full) marks.push(name(k, left, top));
        });
        if (corners.length > 0) marks.push(this.boxesInSpace(corners, labels, columns, rows));
        corners.forEach((places, k) => {
            const seen = places.filter((place) => place !== null);
            if (this.full && seen.length > 0)
                marks.push(name(k, Math.min(...seen.map(([u]) => u)), Math.min(...seen.map(([, v]) => v))));
        });
        this.marks.replaceChildren(...marks);
    }

    private boxesInSpace(
        corners: ([number, number] | null)[][],
        labels: number[],
        columns: number,
        rows: number,
    ): SVGSVGElement {
        const svg = document.createElementNS(SVG, "svg");
        svg.setAttribute("viewBox", `0 0 ${columns} ${rows}`);
        corners.forEach((places, k) => {
            const path = document.createElementNS(SVG, "path"),
                pieces = EDGES.map(([a, b]) => [places[a], places[b]]).filter(
                    (ends): ends is [[number, number], [number, number]] => ends[0] !== null && ends[1] !== null,
                );
            path.setAttribute("d", pieces.map(([a, b]) => `M${a.join(" ")}L${b.join(" ")}`).join(""));
            path.setAttribute("stroke", cssOf(labelColour(labels[k] ?? 0)));
            svg.append(path);
        });
        return svg;
    }

    private showScale(picture: CameraPicture): void {
        const { about } = picture;
        this.scale.hidden = picture.values === null && about.shows !== "labels";
        if (about.shows === "labels") return this.showLabels(picture);
        if (picture.values === null) return;
        const bar = h("span", { class: "camera-bar" });
        bar.style.background = gradientOf(this.mapOf(picture));
        const word = (value = 0) => `${fixed(value, about.unit === "K" ? 1 : 2)} ${about.unit ?? ""}`;
        this.scale.replaceChildren(h("span", {}, word(about.low)), bar, h("span", {}, word(about.high)));
    }

    /** The labels that are seen. */
    private showLabels({ pixels, about }: CameraPicture): void {
        const counts = new Map<number, number>();
        for (let i = 0; i < (pixels?.length ?? 0); i += 4) {
            const label = pixels?.[i] ?? 0;
            if (label > 0) counts.set(label, (counts.get(label) ?? 0) + 1);
        }
        const all = about.columns * about.rows,
            chips = [...counts]
                .sort((a, b) => b[1] - a[1])
                .map(([label, count]) => {
                    const swatch = h("i", { class: "swatch" });
                    swatch.style.background = cssOf(labelColour(label));
                    return h(
                        "span",
                        { class: "camera-chip" },
                        swatch,
                        `label ${label}, ${fixed((100 * count) / all, 0)} %`,
                    );
                });
        this.scale.replaceChildren(...(chips.length > 0 ? chips : [h("span", {}, "nothing with a label in sight")]));
    }

    /** What lies under the pointer. */
    private read(): void {
        setText(this.reading, this.words());
    }

    private words(): string {
        if (this.picture === null || this.pointer === null) return "";
        const { about, values } = this.picture,
            column = Math.floor(this.pointer.x * about.columns),
            row = Math.floor(this.pointer.y * about.rows);
        if (column < 0 || row < 0 || column >= about.columns || row >= about.rows) return "";
        const at = row * about.columns + column,
            pixels = pixelsOf(this.picture),
            place = `(${column}, ${row})`;
        if (values !== null) {
            const value = values[at];
            if (value === Infinity) return `${place}  nothing in reach`;
            if (value === -Infinity) return `${place}  nearer than the camera sees`;
            return `${place}  ${fixed(value, 3)} ${about.unit ?? ""}`;
        }
        if (pixels === null) return place;
        const [r, g, b] = pixels.subarray(4 * at, 4 * at + 3);
        if (about.shows !== "labels") return `${place}  ${r} ${g} ${b}`;
        const instance = 256 * g + b;
        return r === 0 ? `${place}  no label` : `${place}  label ${r}${instance > 0 ? `, number ${instance}` : ""}`;
    }
}
