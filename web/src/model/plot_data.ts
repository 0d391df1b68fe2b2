// What plots do with numbers: unwrapped angles, a table of several curves, CSV, and how plots are written in a link.

export interface CurveName {
    robotName: string;
    key: string;
    label: string;
    unit: string;
}

export interface CurveData extends CurveName {
    times: number[];
    values: (number | null)[];
}

const ANGLE = /^angle\.|^sensor\..*\.(yaw|heading|roll|pitch)$/;

/** A full turn of what jumps from one end to the other; 0: it does not. */
export function turnOf(curve: Pick<CurveName, "key" | "unit">): number {
    return ANGLE.test(curve.key) ? (curve.unit === "°" ? 360 : 2 * Math.PI) : 0;
}

/** Without the jumps of a full turn. */
export function unwrapped(values: readonly (number | null)[], turn: number): (number | null)[] {
    if (turn === 0) return [...values];
    let offset = 0,
        before: number | null = null;
    return values.map((value) => {
        if (value === null) return null;
        if (before !== null) offset -= turn * Math.round((value - before) / turn);
        before = value;
        return value + offset;
    });
}

/** One row for each time of any curve; null where a curve has none. */
export function tableOf(curves: readonly CurveData[]): [number[], ...(number | null)[][]] {
    const times = [...new Set(curves.flatMap((curve) => curve.times))].sort((a, b) => a - b),
        places = new Map(times.map((time, k) => [time, k]));
    const columns = curves.map((curve) => {
        const column = new Array<number | null>(times.length).fill(null);
        curve.times.forEach((time, k) => (column[places.get(time) ?? 0] = curve.values[k]));
        return column;
    });
    return [times, ...columns];
}

function cell(text: string): string {
    return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/** Comma-separated, with a head: "time [s]", "car_1 speed [m/s]". */
export function csvOf(curves: readonly CurveData[]): string {
    const [times, ...columns] = tableOf(curves),
        unit = (text: string) => (text === "" ? "" : ` [${text}]`);
    const head = ["time [s]", ...curves.map((one) => `${one.robotName} ${one.label}${unit(one.unit)}`)];
    const rows = times.map((time, k) => [time, ...columns.map((column) => column[k] ?? "")].join(","));
    return [head.map(cell).join(","), ...rows, ""].join("\n");
}

/** "car_1~speed~m/s~speed!car_2~...;..." */
export function formatPlots(plots: readonly (readonly CurveName[])[]): string {
    const safe = (text: string) => text.replace(/[~!;&#%]/g, " ");
    return plots
        .map((curves) =>
            curves.map((one) => [one.robotName, one.key, one.unit, one.label].map(safe).join("~")).join("!"),
        )
        .filter((text) => text !== "")
        .join(";");
}

export function parsePlots(text: string): CurveName[][] {
    return text
        .split(";")
        .map((plot) =>
            plot
                .split("!")
                .map((curve) => curve.split("~"))
                .filter((parts) => parts.length === 4 && parts[0] !== "" && parts[1] !== "")
                .map(([robotName, key, unit, label]) => ({ robotName, key, unit, label })),
        )
        .filter((plot) => plot.length > 0);
}
