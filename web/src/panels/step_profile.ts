// Where the time of a step goes: a bar for each stage, and what the solver did. The run measures only while this is open
// and in sight, because measuring costs it some per cent.
import { emptyWords, solverFacts, stageRows } from "../model/step_shares";
import type { ViewerState } from "../model/viewer_state";
import { h, setText } from "../ui/dom";
import { fixed } from "../ui/numbers";
import type { StepProfile } from "../wire/profile";

const FACTS: readonly (readonly [name: string, title: string])[] = [
    ["Largest island", "Robots that are connected by contacts, the most in one step"],
    ["Most contacts", "Contact points and near misses of one island of several robots; 0: robots do not touch"],
    ["Solved together", "Islands are solved in parts: robots of the largest part"],
    ["Iterations", "Of Newton's method, for a contact island in one step"],
    ["Residual", "What the balance of momentum lacks, relative, in the worst island"],
    ["Friction off by", "The most that friction differs from the coefficient times the normal impulse, relative"],
    ["Friction missed", "Solves whose friction is off by more than the tolerance of the accuracy"],
    ["A tick", "Time of all stages, summed over threads and Simulators"],
];

export function stepProfile(state: ViewerState): HTMLElement {
    const values = new Map<string, HTMLElement>(),
        bars = h("div", { class: "stage-bars", role: "list", "aria-label": "Stages of a step" }),
        empty = h("p", { class: "dim" });
    const facts = FACTS.map(([name, title]) => {
        const value = h("span", { class: "fact-value" }, "–");
        values.set(name, value);
        return h("div", { class: "fact wide", title }, h("span", { class: "fact-name" }, name), value);
    });
    const details = h(
        "details",
        { class: "step-profile" },
        h(
            "summary",
            { title: "Measured only while this is open: it costs the run some per cent" },
            "Where a step's time goes",
        ),
        empty,
        bars,
        h("div", { class: "facts-grid" }, ...facts),
    );
    let inSight = false;
    const want = () => state.wantsProfile.set(details.open && inSight);
    details.addEventListener("toggle", want);
    new IntersectionObserver((entries) => {
        inSight = entries[entries.length - 1].isIntersecting;
        want();
    }).observe(details);
    state.profile.follow((profile) => show(profile, values, bars, empty));
    return details;
}

function show(
    profile: StepProfile | null,
    values: ReadonlyMap<string, HTMLElement>,
    bars: HTMLElement,
    empty: HTMLElement,
): void {
    const words = emptyWords(profile);
    setText(empty, words);
    empty.hidden = words === "";
    const texts = profile === null ? {} : solverFacts(profile);
    for (const [name, element] of values) setText(element, texts[name] ?? "–");
    const rows = profile === null ? [] : stageRows(profile);
    while (bars.children.length > rows.length) bars.lastElementChild?.remove();
    while (bars.children.length < rows.length) bars.append(stageBar());
    rows.forEach((row, k) => {
        const [name, track, share] = [...bars.children[k].children] as HTMLElement[];
        setText(name, row.name);
        (track.firstElementChild as HTMLElement).style.width = `${fixed(100 * row.share, 1)}%`;
        setText(share, `${fixed(100 * row.share, 1)} %`);
        (bars.children[k] as HTMLElement).title = `${fixed(row.us, 2)} µs a tick`;
    });
}

function stageBar(): HTMLElement {
    const track = h("span", { class: "stage-track", "aria-hidden": "true" }, h("span", { class: "stage-fill" }));
    return h(
        "div",
        { class: "stage-bar", role: "listitem" },
        h("span", {}),
        track,
        h("span", { class: "stage-share" }),
    );
}
