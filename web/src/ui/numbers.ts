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
