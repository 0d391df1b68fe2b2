// The scene as rows of a tree: robots by type with their links, joints and sensors, scenery, lights. Only rows of open
// branches are made, so that a world of thousands of robots costs thousands of small objects and no more.
import type { SceneInfo, TypeInfo } from "../wire/messages";
import { lightKey, linkKey, robotKey, sceneryKey } from "./sight";

export type RowKind = "group" | "type" | "robot" | "link" | "joint" | "sensor" | "scenery" | "light";

export interface TreeRow {
    kind: RowKind;
    /** Names the row over scenes; what is folded, hidden and locked is kept by it. */
    key: string;
    text: string;
    level: number;
    /** null: it has no rows below it. */
    open: boolean | null;
    /** Of a group or a type: robots or models in it. */
    count?: number;
    /** Of a robot and its parts. */
    robot?: number;
    /** Which of the robot's links, joints or sensors. */
    part?: number;
    /** What hides and locks with it; none: it cannot be. */
    sight: string[];
}

/** Models of the scenery and the places of their shapes in SceneInfo.statics. */
export function sceneryModels(scene: SceneInfo): Map<string, number[]> {
    const models = new Map<string, number[]>();
    scene.statics.forEach(({ name }, k) => {
        const model = modelOf(name),
            shapes = models.get(model);
        if (shapes === undefined) models.set(model, [k]);
        else shapes.push(k);
    });
    return models;
}

/** The model of a shape of the scenery, which is called MODEL::LINK::SHAPE. */
export function modelOf(name: string): string {
    const parts = name.split("::");
    return parts.length > 2 ? parts.slice(0, -2).join("::") : parts[0];
}

/** Lights of the world; those of links belong to their robots. */
function lightsOf(scene: SceneInfo): string[] {
    return (scene.look?.lights ?? []).map(({ name }) => name);
}

/** "car_12" and "car" are "car". */
function stemOf(name: string): string {
    return name.replace(/[_-]?\d+$/, "") || name;
}

/** For each type the first one that moves alike and has the same stem. */
function alike(types: readonly TypeInfo[]): number[] {
    const known = new Map<string, number>();
    return types.map((type, k) => {
        const key = `${type.like} ${stemOf(type.name)}`,
            first = known.get(key) ?? k;
        known.set(key, first);
        return first;
    });
}

class Rows {
    readonly rows: TreeRow[] = [];

    constructor(
        private readonly scene: SceneInfo,
        private readonly words: string,
        private readonly folded: ReadonlySet<string>,
        private readonly unfolded: ReadonlySet<string>,
    ) {}

    private fits(text: string): boolean {
        return this.words === "" || text.toLowerCase().includes(this.words);
    }

    /** Groups and types are open unless they were folded; a search opens all of them. */
    private opened(key: string): boolean {
        return this.words !== "" || !this.folded.has(key);
    }

    robots(): void {
        const first = alike(this.scene.types),
            ofType: number[][] = this.scene.types.map(() => []);
        this.scene.robots.forEach(({ name, type }, robot) => this.fits(name) && ofType[first[type]].push(robot));
        const count = ofType.reduce((sum, robots) => sum + robots.length, 0);
        if (count === 0) return;
        const sight = ofType.flat().map((robot) => robotKey(this.scene.robots[robot].name));
        if (!this.group("robots", "Robots", count, sight)) return;
        const used = ofType.filter((robots) => robots.length > 0).length;
        ofType.forEach((robots, type) => {
            // A heading helps where types have several robots; one each would be headings only.
            const headed = robots.length > 1 && used > 1;
            if (!headed || this.type(type, robots)) for (const robot of robots) this.robot(robot, headed ? 3 : 2);
        });
    }

    private group(key: string, text: string, count: number, sight: string[]): boolean {
        const open = this.opened(key);
        this.rows.push({ kind: "group", key, text, level: 1, open, count, sight });
        return open;
    }

    private type(type: number, robots: number[]): boolean {
        const { name } = this.scene.types[type],
            names = robots.map((robot) => this.scene.robots[robot].name),
            stem = stemOf(names[0]);
        // A type may be called after its first robot, or after a robot of other colours: a stem that all share says more.
        const ofARobot = this.scene.robots.some((robot) => robot.name === name),
            text = ofARobot && names.every((one) => stemOf(one) === stem) ? stem : name,
            key = `type:${text}`,
            open = this.opened(key),
            sight = names.map(robotKey);
        this.rows.push({ kind: "type", key, text, level: 2, open, count: robots.length, sight });
        return open;
    }

    private robot(robot: number, level: number): void {
        const { name, type } = this.scene.robots[robot],
            { links, joints, sensors } = this.scene.types[type],
            key = robotKey(name),
            parts = links.length + joints.length + sensors.length,
            open = parts === 0 ? null : this.unfolded.has(key);
        this.rows.push({ kind: "robot", key, text: name, level, open, robot, sight: [key] });
        if (open !== true) return;
        const part = (kind: "link" | "joint" | "sensor", text: string, k: number) => {
            const own = `${kind}:${name}/${text}`,
                sight = kind === "link" ? [linkKey(name, text)] : [];
            this.rows.push({ kind, key: own, text, level: level + 1, open: null, robot, part: k, sight });
        };
        links.forEach((link, k) => part("link", link.name, k));
        joints.forEach((joint, k) => part("joint", joint.name, k));
        sensors.forEach((sensor, k) => part("sensor", sensor.name, k));
    }

    scenery(): void {
        const models = [...sceneryModels(this.scene).keys()].filter((model) => this.fits(model));
        if (models.length === 0 || !this.group("scenery", "Scenery", models.length, models.map(sceneryKey))) return;
        for (const model of models)
            this.rows.push({
                kind: "scenery",
                key: sceneryKey(model),
                text: model,
                level: 2,
                open: null,
                sight: [sceneryKey(model)],
            });
    }

    lights(): void {
        const lights = lightsOf(this.scene).filter((light) => this.fits(light));
        if (lights.length === 0 || !this.group("lights", "Lights", lights.length, lights.map(lightKey))) return;
        for (const light of lights)
            this.rows.push({
                kind: "light",
                key: lightKey(light),
                text: light,
                level: 2,
                open: null,
                sight: [lightKey(light)],
            });
    }
}

/** `words` in small letters; empty: everything. `folded`: groups and types; `unfolded`: robots. */
export function treeRows(
    scene: SceneInfo,
    words: string,
    folded: ReadonlySet<string>,
    unfolded: ReadonlySet<string>,
): TreeRow[] {
    const tree = new Rows(scene, words, folded, unfolded);
    tree.robots();
    tree.scenery();
    tree.lights();
    return tree.rows;
}

/** Whether all of a row's keys are in the set. */
export function allIn(row: TreeRow, keys: ReadonlySet<string>): boolean {
    return row.sight.length > 0 && row.sight.every((key) => keys.has(key));
}
