/** A host that works its picture out itself: a bright disc on blue. There is no editor, and nothing to ask for. */

const SHARE = 0.4; // of the shorter side: the disc's radius

export class Disc {
  listen(events) {
    events.scene({ id: "disc", name: "disc", version: 1, render: true, errors: false, problem: null });
  }

  async render({ maxWidth = 320, maxHeight = 200 }, tile) {
    const [width, height] = [maxWidth, maxHeight];
    const pixels = new Uint8Array(width * height * 3);
    for (let place = 0; place < width * height; place++) {
      pixels.set(this.isInside(place % width, Math.floor(place / width), width, height) ? INSIDE : OUTSIDE, 3 * place);
    }
    tile({ preview: "disc", version: 1, width, height, top: 0, step: 1, columns: width, rows: height, pixels });
    const own = { ownWidth: width, ownHeight: height, aspect: 1 };
    return { status: "done", version: 1, stale: false, width, height, ...own, seconds: 0, bent: true };
  }

  async pick(optics, { x, y, width, height }) {
    if (!this.isInside(x, y, width, height)) {
      return null;
    }
    const place = { position: [x, y, 0], normal: [0, 0, 1], depth: 1, path: { length: 1, arcs: 1 } };
    return { version: 1, range: null, solidRange: null, line: 1, solid: 0, primitive: 0, color: [1, 1, 0], ...place };
  }

  async mask() {
    return null;
  }

  isInside(x, y, width, height) {
    return Math.hypot(x + 0.5 - width / 2, y + 0.5 - height / 2) < SHARE * Math.min(width, height);
  }

  reveal() {}
  save() {}
  pin() {}
  carryOut() {}
  showProblem() {}
  showOutput() {}
  chose() {}
}

const INSIDE = [255, 240, 120];
const OUTSIDE = [30, 60, 140];
