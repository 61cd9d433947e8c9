import {
  type Box3,
  BufferGeometry,
  CanvasTexture,
  Color,
  Float32BufferAttribute,
  Group,
  LineBasicMaterial,
  LineSegments,
  Sprite,
  SpriteMaterial,
  Vector3,
} from "three";
import { themeColour } from "../plot/colours";
import { upOf, type Upright } from "./views";

const kCells = 10;
const kBelow = 0.03;
const kInMargin = 0.075; // half of what View.fit() leaves

/** A grid below the content, its cells a round number of millimetres, and the three axes next to the content. */
export class Ground {
  readonly object = new Group();
  private readonly grid = new LineSegments(new BufferGeometry(), new LineBasicMaterial());
  private readonly axes = (["x", "y", "z"] as const).map((name) => ({
    name,
    // As its letter: not hidden by what reaches beyond the fitted part.
    line: new LineSegments(new BufferGeometry(), new LineBasicMaterial({ depthTest: false })),
    letter: new Sprite(new SpriteMaterial({ map: letterTexture(name), depthTest: false })),
  }));

  constructor() {
    for (const { line } of this.axes) line.renderOrder = 1;
    this.object.add(this.grid, ...this.axes.flatMap(({ line, letter }) => [line, letter]));
  }

  /** Below the box, as large as it. */
  place(box: Box3, up: Upright, radius: number): void {
    const above = upOf(up);
    const along = new Vector3(1, 0, 0);
    const across = new Vector3().crossVectors(above, along);
    const cell = roundStep((2.4 * radius) / kCells);
    const centre = box.getCenter(new Vector3());
    const corner = box.min.clone();
    const depth = up === "-y" ? box.max.y - centre.y : centre.dot(above) - corner.dot(above);
    centre.addScaledVector(above, -depth - kBelow * radius); // a flat thing does not lie in the grid
    const points: number[] = [];
    for (let line = -kCells / 2; line <= kCells / 2; ++line) {
      for (const [fixed, free] of [[along, across], [across, along]] as const) {
        for (const end of [-1, 1]) {
          const point = centre.clone().addScaledVector(fixed, line * cell).addScaledVector(free, (end * kCells * cell) / 2);
          points.push(...point.toArray());
        }
      }
    }
    this.grid.geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
    this.grid.geometry.computeBoundingSphere();
    const size = box.getSize(new Vector3());
    // Next to the content, and within the margin that a fitted picture has.
    const beside = (extent: number) => extent / 2 + Math.max(0.2 * cell, kInMargin * extent - 0.3 * cell);
    const origin = centre
      .clone()
      .addScaledVector(along, -beside(size.x))
      .addScaledVector(across, -beside(Math.abs(size.dot(across))));
    this.axes.forEach(({ line, letter }, index) => {
      const tip = origin.clone().setComponent(index, origin.getComponent(index) + cell);
      letter.position.copy(origin).setComponent(index, origin.getComponent(index) + 1.3 * cell);
      letter.scale.setScalar(0.5 * cell);
      line.geometry.setAttribute("position", new Float32BufferAttribute([...origin.toArray(), ...tip.toArray()], 3));
      line.geometry.computeBoundingSphere();
    });
  }

  showAxes(shown: boolean): void {
    for (const { line, letter } of this.axes) line.visible = letter.visible = shown;
  }

  takeColours(): void {
    this.grid.material.color = new Color(themeColour("--view-grid"));
    for (const { name, line, letter } of this.axes) {
      line.material.color = new Color(themeColour(`--axis-${name}`));
      letter.material.color = line.material.color;
    }
  }
}

/** A white letter, which its material colours. */
function letterTexture(letter: string): CanvasTexture {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const pen = canvas.getContext("2d")!;
  pen.fillStyle = "#fff";
  pen.font = "600 52px sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  pen.fillText(letter, 32, 32);
  return new CanvasTexture(canvas);
}

/** The largest of 1, 2, 5 × 10ⁿ that is at most `size`. */
export function roundStep(size: number): number {
  const power = 10 ** Math.floor(Math.log10(size) + 1e-9);
  const digit = size / power;
  return (digit >= 5 ? 5 : digit >= 2 ? 2 : 1) * power;
}
