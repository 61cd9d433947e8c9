// Binary frames with a head and arrays (docs/studio-protocol.md), as the server's BlockWriter makes them.

export type NumberArray = Float64Array | Float32Array | Uint32Array | Int32Array | Uint8Array;

export interface Block {
  kind: string;
  head: Record<string, any>;
  arrays: Record<string, NumberArray>;
  shapes: Record<string, number[]>;
}

const MAGIC = 0x31425341; // "ASB1"
const TYPES: Record<string, { new (buffer: ArrayBuffer, offset: number, length: number): NumberArray; BYTES_PER_ELEMENT: number }> = {
  f64: Float64Array,
  f32: Float32Array,
  u32: Uint32Array,
  i32: Int32Array,
  u8: Uint8Array,
};

/** Views of a frame's arrays, not copies. Throws for a frame that is none. */
export function decodeBlock(frame: ArrayBuffer): Block {
  if (frame.byteLength < 8) throw new Error("a frame is too short");
  const view = new DataView(frame);
  if (view.getUint32(0, true) !== MAGIC) throw new Error("a frame is not of this version");
  const headBytes = view.getUint32(4, true);
  if (headBytes > frame.byteLength - 8) throw new Error("a frame's head is cut off");
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(frame, 8, headBytes)));
  const arrays: Block["arrays"] = {};
  const shapes: Block["shapes"] = {};
  for (const { name, type, shape, offset } of head.arrays) {
    const View = TYPES[type];
    if (!View) throw new Error(`a frame has numbers of type ${type}`);
    const count = shape.reduce((product: number, size: number) => product * size, 1);
    if (offset + count * View.BYTES_PER_ELEMENT > frame.byteLength) throw new Error("a frame is cut off");
    arrays[name] = new View(frame, offset, count);
    shapes[name] = shape;
  }
  return { kind: head.kind, head, arrays, shapes };
}
