// The page's icons as paths in a 16 x 16 box; true: filled, else drawn as lines.
export const ICONS = {
    play: [["M5 3.2v9.6l7.5-4.8z", true]],
    pause: [["M4.5 3h2.4v10H4.5zM9.1 3h2.4v10H9.1z", true]],
    step: [
        ["M4 3.2v9.6l6-4.8z", true],
        ["M11.5 3v10", false],
    ],
    reset: [
        ["M12 3.2v9.6L5.5 8z", true],
        ["M4 3v10", false],
    ],
    flag: [["M4 14V2.5h7.5L9.8 5.6l1.7 3.1H4", false]],
    branches: [
        ["M4.5 2.5v11M4.5 10.5c0-3 7-1.5 7-5", false],
        ["M11.5 5.2a1.5 1.5 0 1 0 0-3 1.5 1.5 0 0 0 0 3", true],
    ],
    cursor: [["M4 2.5l8 6.2-3.7.5-1.9 3.4z", false]],
    move: [
        [
            "M8 2v12M2 8h12M8 2 6.4 3.6M8 2l1.6 1.6M8 14l-1.6-1.6M8 14l1.6-1.6M2 8l1.6-1.6M2 8l1.6 1.6M14 8l-1.6-1.6M14 8l-1.6 1.6",
            false,
        ],
    ],
    push: [["M2.5 8h9M8.5 4.5 12 8l-3.5 3.5M14 3v10", false]],
    camera: [
        ["M2 5h3l1.2-1.8h3.6L11 5h3v8H2z", false],
        ["M8 11.2a2.4 2.4 0 1 0 0-4.8 2.4 2.4 0 0 0 0 4.8", false],
    ],
    record: [["M8 4.2a3.8 3.8 0 1 1 0 7.6 3.8 3.8 0 0 1 0-7.6", true]],
    link: [
        [
            "M6.8 9.2a2.6 2.6 0 0 0 3.7 0l2-2a2.6 2.6 0 0 0-3.7-3.7l-.9.9M9.2 6.8a2.6 2.6 0 0 0-3.7 0l-2 2a2.6 2.6 0 0 0 3.7 3.7l.9-.9",
            false,
        ],
    ],
    theme: [
        ["M8 2.5a5.5 5.5 0 1 0 0 11z", true],
        ["M8 2.5a5.5 5.5 0 0 1 0 11", false],
    ],
    help: [["M5.8 6a2.2 2.2 0 1 1 3.3 1.9c-.8.5-1.1.9-1.1 1.8M8 12v.4", false]],
    home: [["M2.5 7.5 8 3l5.5 4.5M4 6.8V13h8V6.8", false]],
    focus: [
        ["M2.5 5.5v-3h3M10.5 2.5h3v3M13.5 10.5v3h-3M5.5 13.5h-3v-3", false],
        ["M8 6.6a1.4 1.4 0 1 1 0 2.8 1.4 1.4 0 0 1 0-2.8", true],
    ],
    left: [["M2.5 3h11v10h-11zM6.3 3v10", false]],
    right: [["M2.5 3h11v10h-11zM9.7 3v10", false]],
    plot: [["M2.5 2.5v11h11M4.5 10l2.5-3 2.2 1.8L13 4.5", false]],
    close: [["M4 4l8 8M12 4l-8 8", false]],
    add: [["M8 3v10M3 8h10", false]],
    more: [
        ["M3.5 6.8a1.2 1.2 0 1 1 0 2.4 1.2 1.2 0 0 1 0-2.4M8 6.8a1.2 1.2 0 1 1 0 2.4 1.2 1.2 0 0 1 0-2.4", true],
        ["M12.5 6.8a1.2 1.2 0 1 1 0 2.4 1.2 1.2 0 0 1 0-2.4", true],
    ],
    list: [["M6 4h8M6 8h8M6 12h8M2.5 4h.6M2.5 8h.6M2.5 12h.6", false]],
    robot: [
        ["M3.5 6h9v7h-9zM8 6V3.5M5.8 13v1M10.2 13v1", false],
        [
            "M6 8.2a.9.9 0 1 1 0 1.8.9.9 0 0 1 0-1.8M10 8.2a.9.9 0 1 1 0 1.8.9.9 0 0 1 0-1.8M8 2.2a.9.9 0 1 1 0 1.8.9.9 0 0 1 0-1.8",
            true,
        ],
    ],
    cluster: [["M5.5 2.5h5v3.5h-5zM2 10h4.5v3.5H2zM9.5 10H14v3.5H9.5zM8 6v2M4.2 10V8h7.6v2", false]],
    eye: [
        ["M1.8 8C3.4 5.2 5.5 3.8 8 3.8s4.6 1.4 6.2 4.2C12.6 10.8 10.5 12.2 8 12.2S3.4 10.8 1.8 8z", false],
        ["M8 6.2a1.8 1.8 0 1 1 0 3.6 1.8 1.8 0 0 1 0-3.6", true],
    ],
    command: [["M2.5 3.5h11v9h-11zM5 6.5 6.8 8 5 9.5M8.5 9.8h2.700", false]],
    search: [["M7 2.8a4.2 4.2 0 1 1 0 8.4 4.2 4.2 0 0 1 0-8.4M10.2 10.2 13.5 13.5", false]],
} satisfies Record<string, [string, boolean][]>;

export type IconName = keyof typeof ICONS;
