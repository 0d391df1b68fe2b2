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

/**
 * Names of the models of an SDF, URDF or MJCF file, without those inside of others. Of an MJCF file a model is a body that
 * moves in the world, with all that hangs on it.
 */
export function modelNames(content: string): string[] {
    const page = new DOMParser().parseFromString(content, "text/xml"),
        nameOf = (element: Element) => element.getAttribute("name") ?? "";
    if (page.documentElement.tagName === "mujoco") return movingBodies(page).map(nameOf);
    const found = page.querySelectorAll("sdf > model, sdf > world > model, sdf > world > include, robot");
    return [...found].filter((element) => element.tagName !== "robot" || element.parentElement === null).map(nameOf);
}

/** Bodies of an MJCF file that have joints and are in no body that has some. */
function movingBodies(page: Document): Element[] {
    const joints = [...page.querySelectorAll("worldbody body > joint, worldbody body > freejoint")],
        bodies = new Set(joints.map((joint) => joint.parentElement).filter((body) => body !== null));
    const isInside = (body: Element) => {
        for (let outer = body.parentElement; outer !== null; outer = outer.parentElement)
            if (bodies.has(outer as HTMLElement)) return true;
        return false;
    };
    return [...bodies].filter((body) => !isInside(body));
}
