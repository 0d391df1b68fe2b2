// Own numbers of robots as a person edits them: as texts, and as the orders that set them or take that back.
import type {
    NumberRow,
    NumbersAction,
    NumbersPlace,
    NumberValues,
    OwnNumbers,
    SurroundingsAction,
} from "../wire/numbers";
import type { TypeInfo } from "../wire/messages";
import { ownSurroundings, surroundingsAction, surroundingsCount } from "./surroundings";

/** A joint axis, a link, or gravity and wind at the robot. */
export type Place = NumbersPlace | "surroundings";

const DIGITS = 7;

/** A number as a field shows it. Without a bound, a lower limit is -∞, all others ∞. */
export function numberText({ name, value }: Pick<NumberRow, "name" | "value">): string {
    if (value === null) return name === "lower" ? "-∞" : "∞";
    return String(Number(value.toPrecision(DIGITS)));
}

/** The number that a text gives; null: no bound; undefined: none. */
export function numberOf(text: string, row: NumberRow): number | null | undefined {
    const word = text.trim().toLowerCase(),
        value = word === "" ? NaN : Number(word);
    if (Number.isFinite(value)) return value;
    const found = /^([+-]?)(∞|inf|infinity)$/.exec(word);
    return found !== null && row.endless === true && (found[1] === "-") === (row.name === "lower") ? null : undefined;
}

/** Numbers that come together: the run takes none of them alone. */
const TOGETHER = [/^(lower|upper)$/, /^inertia_/, /^gravity_/, /^wind_/];

/** The values, with those that have to come with them as they are now. */
export function withPartners(values: NumberValues, rows: readonly NumberRow[]): NumberValues {
    const named = Object.keys(values),
        groups = TOGETHER.filter((group) => named.some((name) => group.test(name)));
    const all = { ...values };
    for (const { name, value } of rows)
        if (!(name in all) && groups.some((group) => group.test(name))) all[name] = value;
    return all;
}

export function samePlace(a: Place, b: Place): boolean {
    if (a === "surroundings" || b === "surroundings") return a === b;
    if ("link" in a) return "link" in b && a.link === b.link;
    return !("link" in b) && a.joint === b.joint && a.axis === b.axis;
}

/** The order for this place. */
export function numbersAction(place: Place, values: NumberValues, reset: boolean): NumbersAction | SurroundingsAction {
    if (place === "surroundings") return surroundingsAction(values, reset);
    const what = { values, reset };
    return "link" in place
        ? { action: "link_parameters", link: place.link, ...what }
        : { action: "joint_parameters", joint: place.joint, axis: place.axis, ...what };
}

/** The numbers that differ from the file at this place. */
export function ownAt(own: OwnNumbers | undefined, place: Place): NumberValues {
    if (place === "surroundings") return ownSurroundings(own);
    const all = "link" in place ? own?.links : own?.joints;
    return all?.find((one) => samePlace(one, place))?.values ?? {};
}

/** The count of numbers of the robot that differ from the file; gravity is one, and so is the wind. */
export function ownCount(own: OwnNumbers | undefined): number {
    return [...(own?.joints ?? []), ...(own?.links ?? [])].reduce(
        (sum, { values }) => sum + Object.keys(values).length,
        surroundingsCount(own),
    );
}

export interface NamedPlace {
    name: string;
    kind: "joint" | "link" | "robot";
    place: Place;
}

/** Gravity and wind, all axes of joints and all links of a type, with their names. */
export function placesOf(type: TypeInfo): NamedPlace[] {
    const axes = type.joints.flatMap(({ name, axes }, joint) =>
        Array.from({ length: axes }, (_, axis) => ({
            name: axes > 1 ? `${name} ${axis + 1}` : name,
            kind: "joint" as const,
            place: { joint, axis },
        })),
    );
    const links = type.links.map(({ name }, link) => ({ name, kind: "link" as const, place: { link } }));
    return [{ name: "gravity and wind", kind: "robot", place: "surroundings" }, ...axes, ...links];
}
