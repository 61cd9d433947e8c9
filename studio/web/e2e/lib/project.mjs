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
      const p = [48 * bump * Math.sin(v) * Math.cos(u), 34 * bump * Math.sin(v) * Math.sin(u), 24 * bump * Math.cos(v)];
      // Rounded to a nanometre, so that the corners of a pole are one point.
      lines.push(`v ${p.map((one) => Number(one.toFixed(6))).join(" ")}`);
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

const kPlate_mm = 30;

/** Waves of 1 to 3 mm in all directions. */
function relief_m(x_mm, y_mm) {
  let height = 0;
  for (let wave = 0; wave < 24; ++wave) {
    const [cycles, angle] = [0.35 + 0.02 * wave, 2.4 * wave];
    height += 6e-6 * Math.cos(2 * Math.PI * cycles * (x_mm * Math.cos(angle) + y_mm * Math.sin(angle)) + 1.7 * wave * wave);
  }
  return height;
}

/** What `register` leaves of 16 strokes that cross on a plate: a minute of simulation, written by hand. */
export function writeRegistered(folder) {
  const vertices = [];
  const faces = [];
  const at = (row, column) => (kPlate_mm + 1) * row + column + 1;
  for (let row = 0; row <= kPlate_mm; ++row) {
    for (let column = 0; column <= kPlate_mm; ++column) {
      vertices.push(`v ${column} ${row} 0`);
      if (row === kPlate_mm || column === kPlate_mm) continue;
      faces.push(`f ${at(row, column)} ${at(row, column + 1)} ${at(row + 1, column + 1)}`, `f ${at(row, column)} ${at(row + 1, column + 1)} ${at(row + 1, column)}`);
    }
  }
  mkdirSync(folder);
  writeFileSync(join(folder, "plate.obj"), `${[...vertices, ...faces].join("\n")}\n`);
  writeFileSync(join(folder, "scene.json"), JSON.stringify({ format: "asperity-scene", version: 1, mesh: "plate.obj", unit_m: 0.001, textures: [] }));
  const scans = Array.from({ length: 16 }, (_, stroke) => ({ name: `scan${stroke}` }));
  writeFileSync(join(folder, "registration.json"), JSON.stringify({ format: "asperity-registration", version: 1, trustworthy: true, scans }));
  scans.forEach(({ name }, stroke) => {
    const path = ["s_m,px_m,py_m,pz_m,triangle"];
    const profile = ["s_m,height_m,sigma_m,texture_m,force_N,speed_mps,texture_sigma_m"];
    const lane = 10.2 + 1.2 * (stroke % 8);
    for (let step = 0; step <= 240; ++step) {
      const s = 0.05 * step;
      const [x, y] = stroke < 8 ? [8 + s, lane] : [lane, 8 + s];
      const [column, row] = [Math.floor(x), Math.floor(y)];
      path.push([1e-3 * s, 1e-3 * x, 1e-3 * y, 0, 2 * (kPlate_mm * row + column) + (x - column < y - row ? 1 : 0)].join());
      profile.push([1e-3 * s, relief_m(x, y) + 2e-5 * (stroke % 5), 1e-5, 0, 0.5, 0.02, 2e-6].join());
    }
    mkdirSync(join(folder, name));
    writeFileSync(join(folder, name, "path.csv"), `${path.join("\n")}\n`);
    writeFileSync(join(folder, name, "profile.csv"), `${profile.join("\n")}\n`);
  });
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
    for (const seed of [11, 12]) {
      run("simulate", "--surface", "sandpaper", "--probe", "open", "--speed", "25mm/s", "--seed", `${seed}`, "--set", "surface.seed=7", "--set", "hand.path_seed=3",
        "--set", "hand.length_m=0.06", "-o", `guided_${seed}`, "--quiet");
    }
    writeRegistered(join(this.first, "registered"));
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
