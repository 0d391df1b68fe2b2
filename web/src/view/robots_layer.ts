// All robots: one InstancedMesh for each different body, whichever types share it. Each frame only robots that moved are
// placed anew. Bodies that differ in nothing but one colour share a mesh and carry that colour as instances.
import * as THREE from "three";
import { bodyAt, placeBodies } from "../kinematics/tree";
import { composed, POSE_WIDTH, writeMatrix } from "../kinematics/pose";
import type { Fleet } from "../model/fleet";
import type { History } from "../model/history";
import type { TypeInfo } from "../wire/messages";
import type { MeshData } from "../wire/scene_source";
import { finishKey, type Finishes } from "./finishes";
import { lightness, mergedGeometry, type PlacedVisual, visualColour } from "./geometry";

interface BodyLook {
    body: number;
    parts: PlacedVisual[];
    alpha: number;
    key: string;
    colour: THREE.Color | null;
    /** How light it is beside the lightest body of its type: tyres stay dark whatever the group's colour. */
    shade: number;
}

interface Batch {
    mesh: THREE.InstancedMesh;
    robots: number[];
    own: THREE.Color[];
    shade: number[];
}

const BODIES_MAX = 4096;
const WHITE = new THREE.Color(1, 1, 1);

function rounded(values: ArrayLike<number>): string {
    return Array.from(values, (value) => value.toFixed(5)).join(" ");
}

/** Which robots a layer draws, which of their links, and how. */
export interface Part {
    robots: readonly number[];
    shows(robot: number, link: number): boolean;
    wireframe: boolean;
    transparent: boolean;
}

const SEEN_THROUGH = 0.35;

/** The visuals (or collision shapes) of a type, by body, what lies over them and whether one sees through them. */
function looks(
    type: TypeInfo,
    kind: "visuals" | "collisions",
    seeThrough: boolean,
    shows: (link: number) => boolean,
): BodyLook[] {
    const found = new Map<string, BodyLook>();
    type.links.forEach((link, number) => {
        for (const visual of shows(number) ? link[kind] : []) {
            const alpha = kind === "collisions" || seeThrough ? SEEN_THROUGH : (visual.alpha ?? 1),
                name = `${link.body} ${alpha < 1 ? alpha.toFixed(2) : "solid"} ${finishKey(visual)}`;
            const look = found.get(name) ?? { body: link.body, parts: [], alpha, key: "", colour: null, shade: 1 };
            look.parts.push({ visual, pose: composed(link.frame, visual.frame) });
            found.set(name, look);
        }
    });
    const lightest = Math.max(
        0.02,
        ...[...found.values()].flatMap((look) => look.parts.map((part) => lightness(visualColour(part.visual)))),
    );
    for (const look of found.values()) {
        const colours = new Set(look.parts.map((part) => rounded(part.visual.rgb ?? [])));
        if (colours.size === 1) look.colour = visualColour(look.parts[0].visual);
        if (look.colour !== null) look.shade = Math.max(0.22, lightness(look.colour) / lightest);
        look.key = JSON.stringify(
            look.parts.map(({ visual, pose }) => [
                visual.shape,
                visual.size,
                visual.radius,
                visual.length,
                visual.radii,
                visual.mesh,
                rounded(pose),
                look.colour === null ? visual.rgb : 0,
                look.alpha,
                finishKey(visual),
            ]),
        );
    }
    return [...found.values()];
}

export class RobotsLayer {
    readonly group = new THREE.Group();
    private readonly batches: Batch[] = [];
    /** Of each robot: from where in `slots` its (batch, instance, body) triples run. */
    private readonly slotStart: Uint32Array;
    private readonly slots: Uint32Array;
    private readonly scratch = new Float64Array((BODIES_MAX + 1) * 7);
    /** 1: drawn elsewhere, or hidden. */
    private readonly away: Uint8Array;
    private colouring: ((robot: number, out: THREE.Color) => void) | null = null;

    constructor(
        private readonly fleet: Fleet,
        meshes: ReadonlyMap<number, MeshData>,
        private readonly finishes: Finishes,
        kind: "visuals" | "collisions" = "visuals",
        private readonly part: Part | null = null,
    ) {
        const known = new Map<string, BodyLook[]>(),
            looksOf = (robot: number): BodyLook[] => {
                const type = fleet.type(robot),
                    shown = part === null ? [] : type.links.map((_, link) => part.shows(robot, link)),
                    key = `${fleet.typeOf[robot]} ${shown.join()}`;
                const found = known.get(key) ?? looks(type, kind, part?.transparent ?? false, (k) => shown[k] ?? true);
                known.set(key, found);
                return found;
            };
        const batchOf = new Map<string, { look: BodyLook; members: { robot: number; look: BodyLook }[] }>();
        for (const r of part?.robots ?? Array.from({ length: fleet.count }, (_, robot) => robot))
            for (const look of looksOf(r)) {
                const batch = batchOf.get(look.key) ?? { look, members: [] };
                batch.members.push({ robot: r, look });
                batchOf.set(look.key, batch);
            }
        this.away = new Uint8Array(fleet.count);
        const slotsOf: number[][] = Array.from({ length: fleet.count }, () => []);
        for (const { look, members } of batchOf.values()) this.addBatch(look, members, meshes, slotsOf);
        this.slotStart = new Uint32Array(fleet.count + 1);
        slotsOf.forEach((list, r) => (this.slotStart[r + 1] = this.slotStart[r] + list.length));
        this.slots = Uint32Array.from(slotsOf.flat());
        this.recolour(null);
    }

    private addBatch(
        look: BodyLook,
        members: { robot: number; look: BodyLook }[],
        meshes: ReadonlyMap<number, MeshData>,
        slotsOf: number[][],
    ): void {
        const geometry = mergedGeometry(look.parts, meshes);
        if (geometry === null) return;
        if (look.colour !== null) geometry.setAttribute("color", geometry.getAttribute("tint"));
        const material = this.finishes.material(look.parts[0].visual.finish, {
            vertexColors: true,
            roughness: 0.62,
            metalness: 0.02,
            transparent: look.alpha < 1,
            opacity: look.alpha,
            depthWrite: look.alpha >= 1,
            wireframe: this.part?.wireframe === true,
            shadowSide: THREE.FrontSide,
        });
        const mesh = new THREE.InstancedMesh(geometry, material, members.length);
        mesh.instanceMatrix.setUsage(THREE.DynamicDrawUsage);
        mesh.frustumCulled = false;
        mesh.castShadow = look.alpha >= 1 && look.parts[0].visual.casts !== false;
        mesh.receiveShadow = true;
        this.group.add(mesh);
        const number =
            this.batches.push({
                mesh,
                robots: members.map((member) => member.robot),
                own: members.map((member) => member.look.colour ?? WHITE),
                shade: members.map((member) => member.look.shade),
            }) - 1;
        members.forEach((member, instance) => slotsOf[member.robot].push(number, instance, bodyAt(member.look.body)));
    }

    /** Places the robots that changed. */
    update(history: History): void {
        const { drawn, changed } = history,
            { fleet } = this;
        let any = false;
        for (let r = 0; r < fleet.count; ++r) {
            if (changed[r] === 0) continue;
            any = true;
            if (this.slotStart[r] === this.slotStart[r + 1]) continue;
            if (this.away[r] === 1) {
                this.putAway(r);
                continue;
            }
            placeBodies(fleet.type(r), drawn.base, r * 7, drawn.joints, fleet.firstCoordinate[r], this.scratch);
            for (let s = this.slotStart[r]; s < this.slotStart[r + 1]; s += 3)
                writeMatrix(
                    this.batches[this.slots[s]].mesh.instanceMatrix.array as Float32Array,
                    this.slots[s + 1] * 16,
                    this.scratch,
                    this.slots[s + 2],
                );
        }
        if (any) for (const batch of this.batches) batch.mesh.instanceMatrix.needsUpdate = true;
    }

    /** Draws these robots no more; the others as before. */
    leaveOut(robots: Iterable<number>, history: History): void {
        const before = this.away.slice();
        this.away.fill(0);
        for (const robot of robots) this.away[robot] = 1;
        before.forEach((was, robot) => {
            if (was !== this.away[robot]) history.changed[robot] = 1;
        });
    }

    /** A matrix of zeros leaves no triangle, neither to draw nor to hit. */
    private putAway(robot: number): void {
        for (let s = this.slotStart[robot]; s < this.slotStart[robot + 1]; s += 3) {
            const at = this.slots[s + 1] * 16;
            (this.batches[this.slots[s]].mesh.instanceMatrix.array as Float32Array).fill(0, at, at + 16);
        }
    }

    /** Colours every robot by `colouring`, or as its model says where it is null. */
    recolour(colouring: ((robot: number, out: THREE.Color) => void) | null): void {
        const modelNow = colouring === null,
            modelBefore = this.colouring === null;
        this.colouring = colouring;
        const colour = new THREE.Color();
        for (const { mesh, robots, own, shade } of this.batches) {
            if (modelNow !== modelBefore) {
                const plain = own[0] !== WHITE || !modelNow;
                mesh.geometry.setAttribute("color", mesh.geometry.getAttribute(plain ? "tint" : "own"));
            }
            robots.forEach((robot, instance) => {
                if (colouring === null) colour.copy(own[instance]);
                else {
                    colouring(robot, colour);
                    colour.multiplyScalar(shade[instance]);
                }
                mesh.setColorAt(instance, colour);
            });
            if (mesh.instanceColor !== null) mesh.instanceColor.needsUpdate = true;
        }
    }

    /** First body that the ray meets of the robot: which, how far away, and where. */
    hit(caster: THREE.Raycaster, robot: number): { body: number; distance: number; point: THREE.Vector3 } | null {
        let nearest: { body: number; distance: number; point: THREE.Vector3 } | null = null;
        const single = new THREE.Mesh(),
            matrix = new THREE.Matrix4(),
            found: THREE.Intersection[] = [];
        for (let s = this.slotStart[robot]; s < this.slotStart[robot + 1] && this.away[robot] === 0; s += 3) {
            const batch = this.batches[this.slots[s]];
            batch.mesh.getMatrixAt(this.slots[s + 1], matrix);
            single.geometry = batch.mesh.geometry;
            single.material = batch.mesh.material;
            single.matrixWorld.copy(matrix);
            found.length = 0;
            single.raycast(caster, found);
            const body = this.slots[s + 2] / POSE_WIDTH - 1;
            for (const { distance, point } of found)
                if (nearest === null || distance < nearest.distance) nearest = { body, distance, point };
        }
        return nearest;
    }

    dispose(): void {
        for (const { mesh } of this.batches) {
            mesh.geometry.dispose();
            (mesh.material as THREE.Material).dispose();
            mesh.dispose();
        }
    }
}
