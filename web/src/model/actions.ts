// Everything that the page can do in one word. Keys, the help card and the command palette read this list, so a part of the
// page adds an entry here and is found in all of them.
import type { IconName } from "../ui/icons";

export interface Action {
    /** Stays the same over versions: "camera.home". */
    id: string;
    /** As menus show it: "Whole world". */
    title: string;
    /** Heading in the help card and the palette. */
    group: string;
    /** Values of KeyboardEvent.key, " " is the space bar; "Mod+K" is Ctrl-K or Cmd-K, "Mod+Shift+Z" with Shift, too. */
    keys?: readonly string[];
    icon?: IconName;
    /** More words by which it is found. */
    words?: string;
    /** Its keys act while a text is typed, too. */
    everywhere?: boolean;
    /** It takes something away: it is found only by the beginnings of its words. */
    destructive?: boolean;
    /** A key that is held runs it again and again. */
    repeats?: boolean;
    run(): void;
    /** Missing: always. */
    enabled?(): boolean;
    /** Of a switch: whether it is on. */
    on?(): boolean;
}

type Press = Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "shiftKey">;

/** A key press as `keys` writes it, in small letters. Shift counts only where it does not change the character. */
export function pressed(event: Press): string {
    const mod = event.ctrlKey || event.metaKey,
        shift = event.shiftKey && (mod || event.key.length > 1);
    return `${mod ? "mod+" : ""}${shift ? "shift+" : ""}${event.key.toLowerCase()}`;
}

/** A key as people read it. */
export function keyText(key: string): string {
    return key === " " ? "Space" : key.replace(/^Mod\+/, "Ctrl ").replace("Shift+", "Shift ");
}

export class Actions {
    private readonly list: Action[] = [];
    private readonly sources: (() => readonly Action[])[] = [];

    add(...actions: Action[]): void {
        for (const action of actions) {
            if (this.get(action.id) !== undefined) throw new Error(`the action ${action.id} exists already`);
            const taken = (action.keys ?? []).find((key) => this.byKey(key.toLowerCase()) !== undefined);
            if (taken !== undefined) throw new Error(`the key ${taken} of ${action.id} is taken`);
            this.list.push(action);
        }
    }

    /** Actions that come and go, such as one for each robot: made anew whenever the palette opens. */
    addSource(make: () => readonly Action[]): void {
        this.sources.push(make);
    }

    /** Those of add(). */
    all(): readonly Action[] {
        return this.list;
    }

    /** All, those of the sources included. */
    found(): Action[] {
        return [...this.list, ...this.sources.flatMap((make) => make())];
    }

    get(id: string): Action | undefined {
        return this.list.find((action) => action.id === id);
    }

    private byKey(key: string): Action | undefined {
        return this.list.find((action) => action.keys?.some((one) => one.toLowerCase() === key));
    }

    /** Keys count wherever no text is typed and no control of the page wants them. */
    listen(): void {
        window.addEventListener("keydown", (event) => {
            const target = event.target as HTMLElement,
                found = this.byKey(pressed(event));
            if (found === undefined || event.altKey || document.querySelector("dialog[open]") !== null) return;
            // A dialog that closes keeps the focus for a moment.
            const typing =
                target.matches("input:not([type=checkbox]):not([type=radio]):not([type=range]), select, textarea") &&
                target.checkVisibility();
            if (typing && found.everywhere !== true) return;
            if (event.key === " " && target.matches("button, summary, input, [role=tab]")) return;
            if (event.repeat && found.repeats !== true) return;
            event.preventDefault();
            if (found.enabled?.() !== false) found.run();
        });
    }
}
