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
  /** The first of them, if it is known. */
  problem: string | null;
  /** The text has changed since the picture was made. */
  outdated: boolean;
  /** There is a picture. */
  any: boolean;
}

export interface Badge {
  kind: "blocked" | "error" | "stale" | "rendering" | "outdated" | "current" | "empty";
  text: string;
  /** More about it. */
  detail: string;
  /** What a click on it does. */
  leads: "problem" | "output" | "again" | null;
}

/** What a screen reader says of it, and a tooltip shows. */
const LEADS = {
  problem: "Click to go to the first error.",
  output: "Click to see what the renderer says.",
  again: "Click to render it anew.",
};

/** The one thing that matters most. */
export function badge(state: State): Badge {
  const told = (kind: Badge["kind"], text: string, detail = "", leads: Badge["leads"] = null): Badge => ({
    kind,
    text,
    detail: leads === null ? detail : `${detail} ${LEADS[leads]}`,
    leads,
  });
  if (state.blocked !== null) {
    return told("blocked", "", state.blocked);
  }
  if (state.error !== null) {
    const text = state.any ? `Error, last good picture: ${state.error}` : `Error: ${state.error}`;
    return told("error", text, state.error, "output");
  }
  if (state.stale) {
    const detail = "The scene has errors. The picture is that of its last version without.";
    return state.problem === null
      ? told("stale", "Stale", detail)
      : told("stale", `Stale: ${state.problem}`, detail, "problem");
  }
  if (state.rendering) {
    return told("rendering", `Rendering ${Math.floor(100 * state.progress)} %`);
  }
  if (state.outdated) {
    return told("outdated", "Stale", "The scene has changed since the picture was made.", "again");
  }
  return told(state.any ? "current" : "empty", "");
}
