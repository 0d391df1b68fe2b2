// Numbers as people read them.

export function fixed(value: number | null | undefined, digits = 3): string {
    if (value === null || value === undefined || !Number.isFinite(value)) return "–";
    const text = value.toFixed(digits);
    return Number(text) === 0 ? text.replace("-", "") : text;
}

/** 12 345 as "12.3 k". */
export function short(value: number | null | undefined): string {
    if (value === null || value === undefined || !Number.isFinite(value)) return "–";
    if (Math.abs(value) >= 1e6) return `${(value / 1e6).toFixed(1)} M`;
    if (Math.abs(value) >= 1e4) return `${(value / 1e3).toFixed(1)} k`;
    return String(Math.round(value));
}

/** Bytes a second. */
export function byteRate(value: number | null | undefined): string {
    if (value === null || value === undefined || !Number.isFinite(value)) return "–";
    if (value >= 1e6) return `${(value / 1e6).toFixed(1)} MB/s`;
    return value >= 1e3 ? `${(value / 1e3).toFixed(value >= 1e4 ? 0 : 1)} kB/s` : `${Math.round(value)} B/s`;
}

export function percent(value: number | null | undefined): string {
    return value === null || value === undefined || !Number.isFinite(value) ? "–" : `${(100 * value).toFixed(0)} %`;
}

/** Simulated seconds as minutes:seconds.milliseconds, hours where there are any. `digits`: of a second's parts. */
export function clockText(seconds: number, digits: 0 | 1 | 2 | 3 = 3): string {
    const unit = 10 ** digits,
        parts = Math.max(0, Math.round(seconds * unit)),
        whole = Math.floor(parts / unit),
        pad = (n: number, width: number) => String(n).padStart(width, "0");
    const hours = Math.floor(whole / 3600),
        minutes = Math.floor(whole / 60) % 60;
    const rest = `${pad(whole % 60, 2)}${digits > 0 ? `.${pad(parts % unit, digits)}` : ""}`;
    return hours > 0 ? `${hours}:${pad(minutes, 2)}:${rest}` : `${minutes}:${rest}`;
}

export function factorText(value: number | null | undefined): string {
    if (value === null || value === undefined || !Number.isFinite(value)) return "–";
    return value >= 100 ? `${value.toFixed(0)}×` : value >= 10 ? `${value.toFixed(1)}×` : `${value.toFixed(2)}×`;
}

export type Pace = "steady" | "late";
/** Of what is asked for: less is not the noise of a short measurement. */
const LATE_FACTOR = 0.95;

/** late: below real time, though the speed asked for ("0.5", "max") is not. Slow motion that was asked for is not late. */
export function paceOf(factor: number | null | undefined, speed: string | undefined): Pace {
    if (factor === null || factor === undefined || !Number.isFinite(factor)) return "steady";
    const asked = speed === undefined || speed === "max" ? 1 : Math.min(1, Number(speed));
    return factor < LATE_FACTOR * asked ? "late" : "steady";
}
