// What the hand shows while it holds a robot: an arrow from where it was taken to where it is drawn, and what that means.
import * as THREE from "three";
import { ArrowField } from "../overlays/arrow_field";
import type { LabelLayer } from "../overlays/labels";

const MOVE_COLOUR = new THREE.Color(0x35c46b);
const PUSH_COLOUR = new THREE.Color(0xff8a3d);

export class HandMark {
    readonly group = new THREE.Group();
    private readonly arrow = new ArrowField(1, 0.035);
    private from = new THREE.Vector3();
    private tool: "move" | "push" = "move";

    constructor(private readonly labels: LabelLayer) {
        this.group.add(this.arrow.mesh);
        this.group.visible = false;
    }

    begin(tool: "move" | "push", from: THREE.Vector3): void {
        this.tool = tool;
        this.from = from.clone();
    }

    move(to: THREE.Vector3, words: string): void {
        this.group.visible = true;
        this.arrow.begin();
        this.arrow.add(this.from, to.clone().sub(this.from), this.tool === "move" ? MOVE_COLOUR : PUSH_COLOUR);
        this.arrow.end();
        this.labels.put("hand", to, words);
    }

    end(): void {
        this.group.visible = false;
        this.labels.put("hand", null, "");
    }
}
