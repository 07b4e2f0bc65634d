/** What is said of a pixel: its place and colour at once, and what it shows as soon as that is known. */

import type { Hit, Optics, Rendered } from "./host";
import type { Point } from "./viewport";

const WORDS: Record<Optics, string> = { mirage: "mirage", straight: "straight" };

/** Such as `x 12  y 40  0.80 0.10 0.10  mirage`. */
export function pixelText(pixel: Point, color: [number, number, number] | null, optics: Optics): string {
  const values = color === null ? "nothing yet" : color.map((value) => value.toFixed(3)).join("  ");
  return `x ${pixel.x}  y ${pixel.y}   ${values}   ${WORDS[optics]}`;
}

/** Such as `line 61  at -1400.1, -1.2, 0.4  depth 1401.1  path 1401.2 in 14 arcs`. */
export function hitText(hit: Hit | null): string {
  if (hit === null) {
    return "nothing is met here";
  }
  const position = hit.position.map(short).join(", ");
  const arcs = hit.path.arcs > 1 ? ` in ${hit.path.arcs} arcs` : "";
  return `line ${hit.line}   at ${position}   depth ${short(hit.depth)}   path ${short(hit.path.length)}${arcs}`;
}

/** What is said where it could not be asked. */
export function unknownText(reason: string): string {
  return `what is here is not known: ${reason}`;
}

/** Such as `mirage 640 × 400 in 0.12 s`. `whole`: it was meant to have the scene's own size. */
export function pictureText(optics: Optics, answer: Rendered, whole: boolean): string {
  const { width, height, ownWidth, ownHeight, seconds } = answer;
  const smaller = whole && width * height < ownWidth * ownHeight;
  const own = smaller ? ` (of ${ownWidth} × ${ownHeight}, too many for a preview: Save renders them all)` : "";
  return `${optics} ${width} × ${height}${own} in ${seconds.toFixed(2)} s`;
}

/** Six figures, without zeros at the end. */
function short(value: number): string {
  return Number(value.toPrecision(6)).toString();
}

/** The colour for a swatch. */
export function css(color: [number, number, number]): string {
  return `rgb(${color.map((value) => Math.round(value * 255)).join(", ")})`;
}
