/** What a picture says of itself, in words: the badge on it, and the line that screen readers are told. */

export interface State {
  /** Why there can be no picture at all. */
  blocked: string | null;
  error: string | null;
  rendering: boolean;
  /** 0 to 1. */
  progress: number;
  /** The text has errors. */
  stale: boolean;
  /** The text has changed since the picture was made. */
  outdated: boolean;
  /** There is a picture. */
  any: boolean;
}

export interface Badge {
  kind: "blocked" | "error" | "stale" | "rendering" | "outdated" | "current";
  text: string;
  /** More about it. */
  detail: string;
}

/** The one thing that matters most. */
export function badge(state: State): Badge {
  if (state.blocked !== null) {
    return { kind: "blocked", text: "No picture", detail: state.blocked };
  }
  if (state.error !== null) {
    return { kind: "error", text: state.any ? "Error: last good picture" : "Error", detail: state.error };
  }
  if (state.stale) {
    const detail = "The scene has errors. The picture is that of its last version without.";
    return { kind: "stale", text: "Stale", detail };
  }
  if (state.rendering) {
    return { kind: "rendering", text: `Rendering ${Math.floor(100 * state.progress)} %`, detail: "" };
  }
  if (state.outdated) {
    return { kind: "outdated", text: "Stale", detail: "The scene has changed since the picture was made." };
  }
  return { kind: "current", text: "", detail: "" };
}
