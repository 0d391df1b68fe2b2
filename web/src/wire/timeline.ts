// Earlier moments of the run: the branches and bookmarks of its journal, and what a preview says of itself
// (docs/viewer-protocol.md). Times are simulated seconds.

export interface BranchInfo {
    id: number;
    /** 0: none, or it was pruned. */
    parent: number;
    /** Where it left its parent. */
    begin_s: number;
    /** Its first time that can be restored. */
    first_s: number;
    /** Its last time; of the current branch when the timeline changed last. */
    end_s: number;
    reason: string;
}

export interface BookmarkInfo {
    id: number;
    branch: number;
    time_s: number;
    name: string;
}

export interface Timeline {
    type: "timeline";
    serial: number;
    /** The current branch. */
    branch: number;
    branches: BranchInfo[];
    bookmarks: BookmarkInfo[];
}

export interface PreviewInfo {
    branch: number;
    tick: number;
    time_s: number;
    /** It is the moment that was asked for, not an earlier one on the way there. */
    exact: boolean;
    /** Robots of that moment that the present scene does not have. */
    gone: number;
    /** Robots of the present scene that did not exist then. */
    absent: number;
}
