// Names for robots that are to come.

/** `wanted`, or the first of wanted_1, wanted_2 ... that is free; a number at its end counts on. */
export function freeName(wanted: string, taken: (name: string) => boolean): string {
    const plain = wanted.replaceAll("::", "_").trim() || "model";
    if (!taken(plain)) return plain;
    const stem = plain.replace(/_\d+$/, "");
    let n = 1;
    while (taken(`${stem}_${n}`)) ++n;
    return `${stem}_${n}`;
}

/** Names of the models of an SDF or URDF file, without those inside of others. */
export function modelNames(content: string): string[] {
    const page = new DOMParser().parseFromString(content, "text/xml"),
        found = page.querySelectorAll("sdf > model, sdf > world > model, sdf > world > include, robot");
    return [...found]
        .filter((element) => element.tagName !== "robot" || element.parentElement === null)
        .map((element) => element.getAttribute("name") ?? "");
}
