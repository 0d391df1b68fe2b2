// Whether the page is used by fingers: its controls are larger then (style/touch.css).
export const COARSE = matchMedia("(pointer: coarse)").matches;
