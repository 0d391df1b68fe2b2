// Gravity and wind at a robot, by component, in the rows that numbers of joints and links have, too. The scene says those
// of the file, a robot's report its own.
import type { SceneInfo, Triple } from "../wire/messages";
import type { NumberRow, NumberValues, OwnNumbers, SurroundingsAction } from "../wire/numbers";

const UNITS = { gravity: "m/s^2", wind: "m/s" } as const;
const NAMES = ["gravity", "wind"] as const;
const STILL: Triple = [0, 0, 0];

type Name = (typeof NAMES)[number];

function components(name: Name): [string, string, string] {
    return [`${name}_x`, `${name}_y`, `${name}_z`];
}

/** Those that the robot has of its own. */
export function ownSurroundings(own: OwnNumbers | undefined): NumberValues {
    const values: NumberValues = {};
    for (const name of NAMES) own?.[name]?.forEach((value, k) => (values[components(name)[k]] = value));
    return values;
}

export function surroundingsCount(own: OwnNumbers | undefined): number {
    return NAMES.filter((name) => own?.[name] !== undefined).length;
}

export function surroundingsRows(own: OwnNumbers | undefined, scene: Pick<SceneInfo, Name>): NumberRow[] {
    return NAMES.flatMap((name) => {
        const file = scene[name] ?? STILL,
            values = own?.[name] ?? file;
        return components(name).map((component, k) => ({
            name: component,
            unit: UNITS[name],
            value: values[k],
            ...(values[k] === file[k] ? {} : { file: file[k] }),
        }));
    });
}

/** The order that sets them; the components of each come together. */
export function surroundingsAction(values: NumberValues, reset: boolean): SurroundingsAction {
    const action: SurroundingsAction = { action: "surroundings", reset };
    for (const name of NAMES) {
        const [x, y, z] = components(name).map((component) => values[component]);
        if (x != null && y != null && z != null) action[name] = [x, y, z];
    }
    return action;
}
