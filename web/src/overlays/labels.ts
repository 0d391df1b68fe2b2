// Words in the picture: HTML beside points of the world, so that they stay sharp and are read in the page's own type.
import * as THREE from "three";
import { h, setText } from "../ui/dom";
import type { Stage } from "../view/stage";

interface Label {
    element: HTMLElement;
    at: THREE.Vector3;
    used: boolean;
}

export class LabelLayer {
    readonly element = h("div", { class: "labels", "aria-hidden": "true" });
    private readonly labels = new Map<string, Label>();
    private readonly place = new THREE.Vector3();

    constructor(private readonly stage: Stage) {}

    /** Shows `words` at `at`; null takes the label away. */
    put(key: string, at: THREE.Vector3 | null, words: string, kind = ""): void {
        const known = this.labels.get(key);
        if (at === null || words === "") {
            known?.element.remove();
            this.labels.delete(key);
            return;
        }
        const label = known ?? { element: h("div", { class: `tag ${kind}` }), at: new THREE.Vector3(), used: true };
        if (known === undefined) {
            this.labels.set(key, label);
            this.element.append(label.element);
        }
        label.at.copy(at);
        setText(label.element, words);
    }

    keysStarting(prefix: string): string[] {
        return [...this.labels.keys()].filter((key) => key.startsWith(prefix));
    }

    update(): void {
        const { left, top, width, height } = this.stage.viewport;
        for (const { element, at } of this.labels.values()) {
            this.place.copy(at).project(this.stage.camera);
            const seen = this.place.z < 1 && Math.abs(this.place.x) <= 1 && Math.abs(this.place.y) <= 1;
            element.style.visibility = seen ? "visible" : "hidden";
            const x = left + ((this.place.x + 1) * width) / 2,
                y = top + ((1 - this.place.y) * height) / 2;
            if (seen) element.style.transform = `translate(${x}px, ${y}px)`;
        }
    }
}
