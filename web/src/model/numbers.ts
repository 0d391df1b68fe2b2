// Numbers of joints and links as a person edits them: as texts, and as the orders that set them or take that back.
import type { NumberRow, NumbersAction, NumbersPlace, NumberValues, OwnNumbers } from "../wire/numbers";
import type { TypeInfo } from "../wire/messages";

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
const TOGETHER = [/^(lower|upper)$/, /^inertia_/];

/** The values, with those that have to come with them as they are now. */
export function withPartners(values: NumberValues, rows: readonly NumberRow[]): NumberValues {
    const named = Object.keys(values),
        groups = TOGETHER.filter((group) => named.some((name) => group.test(name)));
    const all = { ...values };
    for (const { name, value } of rows)
        if (!(name in all) && groups.some((group) => group.test(name))) all[name] = value;
    return all;
}

export function samePlace(a: NumbersPlace, b: NumbersPlace): boolean {
    if ("link" in a) return "link" in b && a.link === b.link;
    return !("link" in b) && a.joint === b.joint && a.axis === b.axis;
}

/** The order for this place. */
export function numbersAction(place: NumbersPlace, values: NumberValues, reset: boolean): NumbersAction {
    const what = { values, reset };
    return "link" in place
        ? { action: "link_parameters", link: place.link, ...what }
        : { action: "joint_parameters", joint: place.joint, axis: place.axis, ...what };
}

/** The numbers that differ from the file at this place. */
export function ownAt(own: OwnNumbers | undefined, place: NumbersPlace): NumberValues {
    const all = "link" in place ? own?.links : own?.joints;
    return all?.find((one) => samePlace(one, place))?.values ?? {};
}

/** The count of numbers of the robot that differ from the file. */
export function ownCount(own: OwnNumbers | undefined): number {
    return [...(own?.joints ?? []), ...(own?.links ?? [])].reduce(
        (sum, { values }) => sum + Object.keys(values).length,
        0,
    );
}

/** All axes of joints and all links of a type, with their names. */
export function placesOf(type: TypeInfo): { name: string; kind: "joint" | "link"; place: NumbersPlace }[] {
    const axes = type.joints.flatMap(({ name, axes }, joint) =>
        Array.from({ length: axes }, (_, axis) => ({
            name: axes > 1 ? `${name} ${axis + 1}` : name,
            kind: "joint" as const,
            place: { joint, axis },
        })),
    );
    const links = type.links.map(({ name }, link) => ({ name, kind: "link" as const, place: { link } }));
    return [...axes, ...links];
}
