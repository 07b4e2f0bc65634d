// Renders compiled scenes with the kernel as WebAssembly: node wasm.mjs MODULE FOLDER. For each line of standard input,
// `NAME WIDTH HEIGHT STRAIGHT`, writes the 32-bit floats of FOLDER/NAME.m3ir's picture to FOLDER/NAME-STRAIGHT.f32.
import { readFileSync, writeFileSync } from "node:fs";

const [module, folder] = process.argv.slice(2);
const { instance } = await WebAssembly.instantiate(readFileSync(module), {});
const { memory, room, open, render, text, text_length } = instance.exports;

for (const line of readFileSync(0, "utf8").trim().split("\n")) {
  const [name, width, height, straight] = line.split(" ");
  const file = readFileSync(`${folder}/${name}.m3ir`);
  const at = room(file.length);
  new Uint8Array(memory.buffer).set(file, at);
  if (open() !== 0) {
    throw new Error(new TextDecoder().decode(new Uint8Array(memory.buffer, text(), text_length())));
  }
  const pixels = render(Number(width), Number(height), Number(straight));
  writeFileSync(`${folder}/${name}-${straight}.f32`, new Uint8Array(memory.buffer, pixels, 12 * width * height));
}
