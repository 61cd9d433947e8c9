// The results in report.html: blocks in base64 between script tags, as the program has put them there (docs/report.md).
import { measuredOf, type Measured } from "../measured/measured";
import { decodeBlock } from "../net/block";

export interface Result {
  measured: Measured;
  name: string;
  /** The content of result.json. */
  json: Record<string, any>;
}

/** Decodes a block. Throws if it is not a block. `called`: its name in this report. */
export function decodeResult(frame: ArrayBuffer, called?: string): Result {
  const block = decodeBlock(frame);
  const measured = measuredOf(block);
  const name = called || measured.name;
  return { measured: { ...measured, name }, name, json: block.head.result };
}

export function bytesOfBase64(text: string): ArrayBuffer {
  const plain = atob(text);
  const bytes = new Uint8Array(plain.length);
  for (let index = 0; index < plain.length; ++index) bytes[index] = plain.charCodeAt(index);
  return bytes.buffer;
}

export function resultsOf(page: Document): Result[] {
  const blocks = page.querySelectorAll<HTMLScriptElement>('script[type="application/octet-stream"]');
  return Array.from(blocks, (block) => decodeResult(bytesOfBase64(block.textContent ?? ""), block.dataset.name));
}
