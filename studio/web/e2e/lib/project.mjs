// A folder to work in, made by the command line: recordings of the bench, a mesh, textures.
import { cpSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { asperity } from "./studio.mjs";

/** A pebble in millimetres: an ellipsoid with a few broad bumps, so that no two places of it are alike. */
export function pebbleObj(rings = 48, sectors = 96) {
  const lines = [];
  for (let i = 0; i <= rings; ++i) {
    const v = (Math.PI * i) / rings;
    for (let k = 0; k < sectors; ++k) {
      const u = (2 * Math.PI * k) / sectors;
      const bump = 1 + Math.sin(v) * (0.05 * Math.sin(2 * u + 0.7) + 0.035 * Math.cos(3 * u) * Math.sin(v) + 0.03 * Math.cos(2 * v + u));
      lines.push(`v ${48 * bump * Math.sin(v) * Math.cos(u)} ${34 * bump * Math.sin(v) * Math.sin(u)} ${24 * bump * Math.cos(v)}`);
    }
  }
  const at = (i, k) => i * sectors + (k % sectors) + 1;
  for (let i = 0; i < rings; ++i) {
    for (let k = 0; k < sectors; ++k) {
      if (i > 0) lines.push(`f ${at(i, k)} ${at(i + 1, k)} ${at(i, k + 1)}`);
      if (i < rings - 1) lines.push(`f ${at(i, k + 1)} ${at(i + 1, k)} ${at(i + 1, k + 1)}`);
    }
  }
  return `${lines.join("\n")}\n`;
}

const kZigzag = "-0.03,-0.012,0.02;-0.01,0.014,0.024;0.01,-0.014,0.024;0.03,0.012,0.02";

/** Made once; each flow works in a copy. */
export class Projects {
  constructor(binary) {
    this.binary = binary;
    this.root = mkdtempSync(join(tmpdir(), "asperity-e2e-"));
    this.first = join(this.root, "first");
  }

  prepare() {
    mkdirSync(this.first);
    const run = (...args) => asperity(this.binary, args, this.first);
    writeFileSync(join(this.first, "pebble.obj"), pebbleObj());
    run("simulate", "--surface", "protoboard", "--probe", "open", "--speed", "25mm/s", "--seed", "1", "-o", "board", "--quiet");
    run("simulate", "--surface", "protoboard", "--probe", "open", "--speed", "25mm/s", "--seed", "2", "-o", "board_again", "--quiet");
    run("simulate", "--surface", "sandpaper", "--mesh", "pebble.obj", "--mesh-unit", "mm", "--through", kZigzag, "--seed", "1", "-o", "stroke", "--quiet");
    run("process", "board", "-o", "measured", "--quiet");
    run("paint", "pebble.obj", "--mesh-unit", "mm", "--through", "-30,0,20;0,3,24;30,0,20", "--texture", "measured/texture.json", "--width", "12mm", "-o", "painted", "--quiet");
  }

  /** A copy to work in. */
  copy(name) {
    const folder = join(this.root, name);
    cpSync(this.first, folder, { recursive: true });
    return folder;
  }

  remove() {
    rmSync(this.root, { recursive: true, force: true });
  }
}
