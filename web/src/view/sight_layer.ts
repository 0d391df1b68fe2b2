// Draws what is hidden, wireframe or transparent: robots that are not drawn as usual leave the common layer and get layers
// of their own, scenery that is hidden leaves the picture.
import { modelOf } from "../model/scene_tree";
import type { Selection } from "../model/selection";
import type { Signal } from "../model/signal";
import { lightKey, linkKey, robotKey, sceneryKey } from "../model/sight";
import type { ViewerState, World } from "../model/viewer_state";
import type { Colouring } from "./colouring";
import type { Part } from "./robots_layer";
import type { Stage } from "./stage";

export class SightLayer {
    private stale = true;
    private hiddenScenery = "";
    private hiddenLights = "";

    constructor(
        private readonly stage: Stage,
        private readonly state: ViewerState,
        private readonly selection: Selection,
        private readonly colouring: Colouring,
    ) {
        const { sight, overlays, selected, others, world } = state;
        for (const signal of [sight.hidden, overlays, selected, others, world])
            (signal as Signal<unknown>).follow(() => (this.stale = true));
        stage.pickable = (robot) => {
            const key = robotKey(state.world.value?.fleet.name(robot) ?? "");
            return !sight.hidden.value.has(key) && !sight.locked.value.has(key);
        };
        // Before the scene is shown for the first time, so that nothing hidden flashes up.
        stage.showScenery(null, (visual) => !sight.hidden.value.has(sceneryKey(modelOf(visual.name))));
        const shines = (light: string) => !sight.hidden.value.has(lightKey(light));
        stage.showLights(null, shines);
        sight.hidden.follow((hidden) => {
            this.showScenery(hidden);
            const lights = [...hidden].filter((key) => key.startsWith("light:")).join("\n");
            if (lights !== this.hiddenLights) stage.showLights(state.world.value, shines);
            this.hiddenLights = lights;
        });
    }

    private showScenery(hidden: ReadonlySet<string>): void {
        const models = [...hidden].filter((key) => key.startsWith("scenery:")).join("\n");
        if (models === this.hiddenScenery) return;
        this.hiddenScenery = models;
        this.stage.showScenery(
            this.state.world.value,
            (visual) => !this.state.sight.hidden.value.has(sceneryKey(modelOf(visual.name))),
        );
    }

    update(world: World | null): void {
        if (!this.stale || world === null || this.stage.robots === null) return;
        this.stale = false;
        const { hidden, parts, away } = this.divided(world);
        if (parts.length === 0 && away.size === 0 && this.stage.partly.length === 0 && hidden.size === 0)
            return this.stage.robots.leaveOut([], world.history);
        this.stage.showParts(world, parts, away);
        if (parts.length > 0) this.colouring.refresh();
    }

    /** Robots with hidden links, and robots in another style: those selected, or all. */
    private divided(world: World): { hidden: ReadonlySet<string>; parts: Part[]; away: Set<number> } {
        const { fleet } = world,
            hidden = this.state.sight.hidden.value,
            on = this.state.overlays.value,
            styled = on.has("wireframe") || on.has("transparent"),
            chosen = this.selection.robots,
            inStyle = new Set(styled ? (chosen.length > 0 ? chosen : everyone(fleet.count)) : []),
            partly = withHiddenLinks(hidden),
            away = new Set<number>();
        const plain: number[] = [],
            special: number[] = [];
        for (let r = 0; r < fleet.count; ++r) {
            const name = fleet.name(r);
            if (hidden.has(robotKey(name))) away.add(r);
            else if (inStyle.has(r)) special.push(r);
            else if (partly.has(name)) plain.push(r);
        }
        const shows = (robot: number, link: number) =>
            !partly.has(fleet.name(robot)) ||
            !hidden.has(linkKey(fleet.name(robot), fleet.type(robot).links[link]?.name ?? ""));
        const parts: Part[] = [];
        if (plain.length > 0) parts.push({ robots: plain, shows, wireframe: false, transparent: false });
        if (special.length > 0)
            parts.push({
                robots: special,
                shows,
                wireframe: on.has("wireframe"),
                transparent: on.has("transparent"),
            });
        for (const robot of [...plain, ...special]) away.add(robot);
        return { hidden, parts, away };
    }
}

function everyone(count: number): number[] {
    return Array.from({ length: count }, (_, robot) => robot);
}

/** Names of robots of which a link is hidden. */
function withHiddenLinks(hidden: ReadonlySet<string>): Set<string> {
    const names = new Set<string>();
    for (const key of hidden) if (key.startsWith("link:")) names.add(key.slice("link:".length, key.lastIndexOf("\n")));
    return names;
}
