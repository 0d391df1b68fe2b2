// The scenery: everything that never moves, merged into one geometry for each finish (and each transparency), with thin
// edges that keep pale blocks readable on a projector.
import * as THREE from "three";
import type { SceneInfo, Visual } from "../wire/messages";
import type { MeshData } from "../wire/scene_source";
import { byFinish, type Finishes } from "./finishes";
import { mergedGeometry, poseMatrix, shapeGeometry } from "./geometry";

const EDGE_RAD_DEG = 30;
const EDGE_TRIANGLES_MAX = 50_000;

/** Walls are a little darker towards the ground, as if the sky lit them: cheap ambient occlusion. */
function shadeTowardsGround(geometry: THREE.BufferGeometry): void {
    const position = geometry.getAttribute("position"),
        normal = geometry.getAttribute("normal"),
        colour = geometry.getAttribute("color");
    for (let k = 0; k < position.count; ++k) {
        if (Math.abs(normal.getZ(k)) > 0.7) continue;
        const shade = 0.8 + 0.2 * Math.min(1, Math.max(0, position.getZ(k) / 2.5));
        colour.setXYZ(k, colour.getX(k) * shade, colour.getY(k) * shade, colour.getZ(k) * shade);
    }
}

export class StaticsLayer {
    readonly group = new THREE.Group();
    readonly solids: THREE.Mesh[] = [];
    /** The box about all that is no plane. */
    readonly extent = new THREE.Box3();
    private readonly edgeMaterial = new THREE.LineBasicMaterial({ color: 0x000000, transparent: true, opacity: 0.22 });

    constructor(
        scene: SceneInfo,
        meshes: ReadonlyMap<number, MeshData>,
        private readonly finishes: Finishes,
    ) {
        const alphaOf = (visual: Visual) => visual.alpha ?? 1,
            planes = scene.statics.filter((visual) => visual.shape === "plane"),
            others = scene.statics.filter((visual) => visual.shape !== "plane");
        for (const alike of byFinish(planes, (visual) => visual)) this.addMerged(alike, meshes, 1, true);
        for (const alpha of new Set(others.map(alphaOf)))
            for (const alike of byFinish(
                others.filter((visual) => alphaOf(visual) === alpha),
                (visual) => visual,
            ))
                this.addMerged(alike, meshes, alpha, false);
        this.addEdges(
            others.filter((visual) => alphaOf(visual) >= 1 && visual.finish === undefined),
            meshes,
        );
    }

    private addMerged(visuals: Visual[], meshes: ReadonlyMap<number, MeshData>, alpha: number, planes: boolean): void {
        const geometry = mergedGeometry(
                visuals.map((visual) => ({ visual, pose: visual.frame })),
                meshes,
            ),
            finish = visuals[0].finish;
        if (geometry === null) return;
        if (!planes && finish === undefined) shadeTowardsGround(geometry);
        const material = this.finishes.material(finish, {
            vertexColors: true,
            roughness: planes ? 0.95 : 0.85,
            transparent: alpha < 1,
            opacity: alpha,
            depthWrite: alpha >= 1,
            polygonOffset: planes,
            polygonOffsetFactor: 2,
            polygonOffsetUnits: 2,
            shadowSide: THREE.FrontSide, // back faces would let light through at the foot of a wall
        });
        const mesh = new THREE.Mesh(geometry, material);
        mesh.castShadow = !planes && alpha >= 1 && visuals[0].casts !== false;
        mesh.receiveShadow = true;
        mesh.name = planes ? "planes" : "solids";
        this.group.add(mesh);
        this.solids.push(mesh);
        if (!planes) {
            geometry.computeBoundingBox();
            this.extent.union(geometry.boundingBox as THREE.Box3);
        }
    }

    private addEdges(visuals: Visual[], meshes: ReadonlyMap<number, MeshData>): void {
        const points: number[] = [],
            point = new THREE.Vector3();
        for (const visual of visuals) {
            const shape = shapeGeometry(visual, meshes),
                matrix = poseMatrix(visual.frame);
            if (shape.getAttribute("position").count > 3 * EDGE_TRIANGLES_MAX) continue;
            const edges = new THREE.EdgesGeometry(shape, EDGE_RAD_DEG).getAttribute("position");
            for (let k = 0; k < edges.count; ++k)
                point.fromBufferAttribute(edges, k).applyMatrix4(matrix).toArray(points, points.length);
        }
        if (points.length === 0) return;
        const geometry = new THREE.BufferGeometry();
        geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
        this.group.add(new THREE.LineSegments(geometry, this.edgeMaterial));
    }

    dispose(): void {
        this.group.traverse((object) => {
            const mesh = object as Partial<THREE.Mesh>;
            mesh.geometry?.dispose();
            (mesh.material as THREE.Material | undefined)?.dispose();
        });
    }
}
