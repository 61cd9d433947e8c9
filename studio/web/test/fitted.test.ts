import { Box3, BoxGeometry, Group, Mesh, Scene, Vector3 } from "three";
import { expect, it } from "vitest";
import { boxOfFitted, type Fitted } from "../src/view3d/fitted";

const cube = (side: number) => new Mesh(new BoxGeometry(side, side, side));
const boxOf = (side: number) => new Box3(new Vector3().setScalar(-side / 2), new Vector3().setScalar(side / 2));

function scene(...parts: Mesh[]) {
  const content = new Group();
  new Scene().add(content);
  content.add(...parts);
  return content;
}
const fitted = (what: Fitted["what"], side: number): Fitted => ({ what, box: boxOf(side) });

it("keeps the box of a part that is there", () => {
  const part = cube(2);
  expect(boxOfFitted(fitted(part, 2), scene(part, cube(8)))).toEqual(boxOf(2));
});

it("forgets a part that was removed or replaced by one of another size", () => {
  const part = cube(2);
  const content = scene(part);
  part.removeFromParent();
  expect(boxOfFitted(fitted(part, 2), content)).toBeNull();
  content.add(cube(8));
  expect(boxOfFitted(fitted(part, 2), content)).toBeNull();
  content.add(cube(2));
  expect(boxOfFitted(fitted(part, 2), content)).toEqual(boxOf(2));
  expect(boxOfFitted(fitted(null, 2), content)).toEqual(boxOf(2));
  expect(boxOfFitted(fitted(null, 3), content)).toBeNull();
});

it("follows the content, and keeps a box that was given", () => {
  const content = scene(cube(8));
  expect(boxOfFitted(fitted(content, 2), content)).toEqual(boxOf(8));
  content.clear();
  expect(boxOfFitted(fitted(content, 2), content)).toBeNull();
  expect(boxOfFitted(fitted(boxOf(3), 3), content)).toEqual(boxOf(3));
});
