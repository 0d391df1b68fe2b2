// Words in the picture: HTML beside points of the world, so that they stay sharp and are read in the page's own type. Names
// that would cover other words, or a bar over the picture, are left out; none is cut by the picture's edges.
import * as THREE from "three";
import { h, setText } from "../ui/dom";
import type { Stage } from "../view/stage";

/** CSS pixels of the canvas. */
interface Box {
    left: number;
    top: number;
    right: number;
    bottom: number;
}

interface Label {
    element: HTMLElement;
    at: THREE.Vector3;
    /** One of many: left out where there is no room. */
    name: boolean;
    /** Beside the point instead of above it: -1 left, 1 right. */
    side: -1 | 0 | 1;
    /** null: not measured since its words changed. */
    size: { width: number; height: number } | null;
    shown: boolean;
}

/** Between a point and the words above it, and between words. */
const RISE = 20;
const ASIDE = 14;
const GAP = 1;

const meet = (a: Box, b: Box) =>
    a.left < b.right + GAP && b.left < a.right + GAP && a.top < b.bottom + GAP && b.top < a.bottom + GAP;

export class LabelLayer {
    readonly element = h("div", { class: "labels", "aria-hidden": "true" });
    private readonly labels = new Map<string, Label>();
    private readonly place = new THREE.Vector3();
    private over: HTMLElement | null = null;

    constructor(private readonly stage: Stage) {}

    /** Names are not written below the parts of this. */
    avoid(over: HTMLElement): void {
        this.over = over;
    }

    /** Shows `words` at `at`; null takes the label away. */
    put(key: string, at: THREE.Vector3 | null, words: string, kind = ""): void {
        const known = this.labels.get(key);
        if (at === null || words === "") {
            known?.element.remove();
            this.labels.delete(key);
            return;
        }
        const label = known ?? this.made(key, kind);
        label.at.copy(at);
        if (label.element.textContent === words) return;
        setText(label.element, words);
        label.size = null;
    }

    private made(key: string, kind: string): Label {
        const label: Label = {
            element: h("div", { class: `tag ${kind}` }),
            at: new THREE.Vector3(),
            name: /^(name|link) /.test(key),
            side: !kind.startsWith("way") ? 0 : kind.includes("odometer") ? 1 : -1,
            size: null,
            shown: false,
        };
        this.labels.set(key, label);
        this.element.append(label.element);
        return label;
    }

    keysStarting(prefix: string): string[] {
        return [...this.labels.keys()].filter((key) => key.startsWith(prefix));
    }

    update(): void {
        const { left, top, width, height } = this.stage.viewport,
            view = { left, top, right: left + width, bottom: top + height },
            all = [...this.labels.values()],
            // Names that were shown before come first: else they would flicker.
            ranked = [
                ...all.filter(({ name }) => !name),
                ...all.filter(({ name, shown }) => name && shown),
                ...all.filter(({ name, shown }) => name && !shown),
            ];
        for (const label of all)
            label.size ??= { width: label.element.offsetWidth, height: label.element.offsetHeight };
        const bars = all.length > 0 ? this.covered() : [],
            taken = [...bars];
        for (const label of ranked) {
            this.place.copy(label.at).project(this.stage.camera);
            const seen = this.place.z < 1 && Math.abs(this.place.x) <= 1 && Math.abs(this.place.y) <= 1;
            const x = left + ((this.place.x + 1) * width) / 2,
                y = top + ((1 - this.place.y) * height) / 2;
            this.show(label, seen ? below(boxAt(label, x, y, view), label.name ? [] : bars) : null, taken);
        }
    }

    private show(label: Label, box: Box | null, taken: Box[]): void {
        label.shown = box !== null && !(label.name && taken.some((other) => meet(box, other)));
        label.element.style.visibility = label.shown ? "visible" : "hidden";
        if (box === null || !label.shown) return;
        taken.push(box);
        // The style puts words above a point, in its middle.
        const x = box.left + (label.size?.width ?? 0) / 2;
        label.element.style.transform = `translate(${x}px, ${box.top + RISE}px)`;
    }

    /** What bars and cards cover of the canvas. */
    private covered(): Box[] {
        const canvas = this.stage.canvas.getBoundingClientRect(),
            parts =
                this.over?.querySelectorAll(".banner, .question, .view-buttons, .view-toggle, .over-left > *") ?? [];
        return [...parts]
            .map((part) => part.getBoundingClientRect())
            .filter(({ width }) => width > 0)
            .map(({ left, right, top, bottom }) => ({
                left: left - canvas.left,
                right: right - canvas.left,
                top: top - canvas.top,
                bottom: bottom - canvas.top,
            }));
    }
}

/** Moved down, out from under the bars. */
function below(box: Box, bars: readonly Box[]): Box {
    let free = box;
    for (const bar of bars)
        if (meet(free, bar)) free = { ...free, top: bar.bottom + GAP, bottom: bar.bottom + GAP + box.bottom - box.top };
    return free;
}

/** Above the point or beside it, moved inside the view where it would be cut. */
function boxAt({ size, side }: Label, x: number, y: number, view: Box): Box {
    const { width, height } = size ?? { width: 0, height: 0 },
        from = side === 0 ? x - width / 2 : side < 0 ? x - width - ASIDE : x + ASIDE,
        left = Math.max(view.left, Math.min(view.right - width, from)),
        top = Math.max(view.top, Math.min(view.bottom - height, side === 0 ? y - RISE : y - 2));
    return { left, top, right: left + width, bottom: top + height };
}
