// The mock's own numbers of robots: some of each joint axis and link, gravity and wind, which orders change and give back.
// They act on nothing.
import { ownAt, samePlace, withPartners } from "../src/model/numbers";
import type { OrderAction, SceneInfo } from "../src/wire/messages";
import type {
    NumberRow,
    NumbersPlace,
    NumbersWish,
    NumberValues,
    OwnNumbers,
    SurroundingsAction,
} from "../src/wire/numbers";

/** As the simulator's. */
const SURROUNDINGS_MAX = 1e3;

export class MockNumbers {
    private readonly all = new Map<number, OwnNumbers>();

    constructor(private readonly scene: SceneInfo) {}

    /** Those of the file. */
    private file(robot: number, place: NumbersPlace): NumberRow[] {
        const type = this.scene.types[this.scene.robots[robot].type];
        if ("link" in place) {
            const link = type.links[place.link];
            return [
                { name: "mass", unit: "kg", value: link?.mass ?? 1 },
                ...["xx", "yy", "zz"].map((axes) => ({ name: `inertia_${axes}`, unit: "kg m^2", value: 0.01 })),
                { name: "friction", unit: "", value: 0.8 },
            ];
        }
        const joint = type.joints[place.joint],
            turns = joint.units[place.axis] === "rad",
            bound = (values: (number | null)[]) => ({ value: values[place.axis] ?? null, endless: true });
        return [
            { name: "lower", unit: turns ? "rad" : "m", ...bound(joint.lower) },
            { name: "upper", unit: turns ? "rad" : "m", ...bound(joint.upper) },
            { name: "max_effort", unit: turns ? "N m" : "N", ...bound(joint.max_effort) },
            { name: "damping", unit: turns ? "N m s/rad" : "N s/m", value: 0.01 },
        ];
    }

    private rows(robot: number, place: NumbersPlace): NumberRow[] {
        const own = ownAt(this.all.get(robot), place);
        return this.file(robot, place).map((row) =>
            row.name in own ? { ...row, value: own[row.name], file: row.value } : row,
        );
    }

    report({ robot, ...place }: NumbersWish): object {
        const numbers = this.rows(robot, place as NumbersPlace);
        return { type: "numbers", scene: this.scene.scene, robot, tick: 0, ...place, numbers };
    }

    own(robot: number): { own?: OwnNumbers } {
        const own = this.all.get(robot);
        return own === undefined ? {} : { own };
    }

    /** null: the order is for something else; "": it is taken; else why it is refused. */
    obey(robot: number, order: OrderAction): string | null {
        if (order.action === "surroundings") return this.surround(robot, order);
        if (order.action !== "joint_parameters" && order.action !== "link_parameters") return null;
        const place: NumbersPlace =
                order.action === "link_parameters" ? { link: order.link } : { joint: order.joint, axis: order.axis },
            values = order.values ?? {},
            rows = this.rows(robot, place),
            negative = Object.keys(values).find((name) => name !== "lower" && (values[name] ?? 0) < 0);
        if (negative !== undefined)
            return `'${negative}' is ${values[negative]}; it cannot be negative [bad-parameter]`;
        if (Object.keys(withPartners(values, rows)).length !== Object.keys(values).length)
            return "the order sets a part of what comes together [half-limits]";
        const file = this.file(robot, place),
            now: NumberValues = { ...(order.reset === true ? {} : ownAt(this.all.get(robot), place)), ...values };
        for (const { name, value } of file) if (now[name] === value) delete now[name];
        this.keep(robot, place, now);
        return "";
    }

    private surround(robot: number, { gravity, wind, reset }: SurroundingsAction): string {
        const far = [...(gravity ?? []), ...(wind ?? [])].find((value) => Math.abs(value) > SURROUNDINGS_MAX);
        if (far !== undefined) return `a component is ${far}, beyond the limit of ${SURROUNDINGS_MAX} [beyond-limit]`;
        const { gravity: had, wind: blew, ...rest } = this.all.get(robot) ?? {},
            now = reset === true ? { gravity, wind } : { gravity: gravity ?? had, wind: wind ?? blew },
            own: OwnNumbers = { ...rest };
        if (now.gravity !== undefined && String(now.gravity) !== String(this.scene.gravity)) own.gravity = now.gravity;
        if (now.wind !== undefined && String(now.wind) !== String(this.scene.wind ?? [0, 0, 0])) own.wind = now.wind;
        this.all.set(robot, own);
        return "";
    }

    private keep(robot: number, place: NumbersPlace, values: NumberValues): void {
        const { joints = [], links = [], ...around } = this.all.get(robot) ?? {},
            own: OwnNumbers = {
                ...around,
                joints: joints.filter((one) => !samePlace(one, place)),
                links: links.filter((one) => !samePlace(one, place)),
            };
        if (Object.keys(values).length > 0)
            if ("link" in place) own.links?.push({ ...place, values });
            else own.joints?.push({ ...place, values });
        this.all.set(robot, own);
    }
}
