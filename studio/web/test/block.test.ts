import { expect, test } from "vitest";
import { decodeBlock } from "../src/net/block";

/** A frame as docs/studio-protocol.md describes it, made here by hand. */
function frame(head: object, arrays: [offset: number, bytes: Uint8Array][], size: number): ArrayBuffer {
  const buffer = new ArrayBuffer(size);
  const view = new DataView(buffer);
  const text = new TextEncoder().encode(JSON.stringify(head));
  view.setUint32(0, 0x31425341, true);
  view.setUint32(4, text.length, true);
  new Uint8Array(buffer, 8).set(text);
  for (const [offset, bytes] of arrays) new Uint8Array(buffer, offset).set(bytes);
  return buffer;
}

const head = {
  kind: "mesh",
  topic: "align.mesh",
  arrays: [
    { name: "positions", type: "f64", shape: [2, 3], offset: 256 },
    { name: "triangles", type: "u32", shape: [1, 3], offset: 304 },
  ],
};
const positions = new Uint8Array(Float64Array.from([1, 2, 3, 4, 5, 6]).buffer);
const triangles = new Uint8Array(Uint32Array.from([0, 1, 0]).buffer);
const good = () => frame(head, [[256, positions], [304, triangles]], 320);

test("a frame's arrays are views with their shapes", () => {
  const block = decodeBlock(good());
  expect(block.kind).toBe("mesh");
  expect(block.head.topic).toBe("align.mesh");
  expect([...block.arrays.positions!]).toEqual([1, 2, 3, 4, 5, 6]);
  expect(block.arrays.triangles).toBeInstanceOf(Uint32Array);
  expect(block.shapes.positions).toEqual([2, 3]);
});

test("what is no frame is refused", () => {
  expect(() => decodeBlock(new ArrayBuffer(4))).toThrow("too short");
  const other = good();
  new DataView(other).setUint32(0, 1, true);
  expect(() => decodeBlock(other)).toThrow("not of this version");
  const long = good();
  new DataView(long).setUint32(4, 1e6, true);
  expect(() => decodeBlock(long)).toThrow("cut off");
  expect(() => decodeBlock(good().slice(0, 310))).toThrow("cut off");
  const strange = { ...head, arrays: [{ name: "a", type: "f16", shape: [1], offset: 256 }] };
  expect(() => decodeBlock(frame(strange, [], 320))).toThrow("f16");
});
