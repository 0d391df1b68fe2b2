// Who may do what, as the gateway says it (docs/viewer-protocol.md): each page has a role, and one page has control.

export type Role = "watch" | "steer" | "administer";

export interface PageInfo {
    page: number;
    /** Of its computer. */
    address: string;
    /** Its name, where users have tokens of their own; else empty. */
    user: string;
    role: Role;
}

export interface Roles {
    type: "roles";
    /** This page. */
    page: number;
    role: Role;
    holder: PageInfo | null;
    asking: PageInfo[];
}
