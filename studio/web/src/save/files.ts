// What a browser keeps of a plot or a table: a file of its own, or the clipboard.
import { say } from "../ui/toast";

/** Hands a file to the browser, which asks or puts it among its downloads. */
export function saveFile(name: string, content: Blob | string, type: string): void {
  const address = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }));
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  // The download has begun by then.
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** Throws where a browser has no clipboard for pages without encryption. */
function clipboard(): Clipboard {
  if (!navigator.clipboard) throw new Error("This browser allows the clipboard only on encrypted pages and on pages of this machine. Save a file instead.");
  return navigator.clipboard;
}

export async function copyText(text: string): Promise<void> {
  await clipboard().writeText(text);
  say("Copied.");
}

export async function copyPicture(picture: Blob): Promise<void> {
  await clipboard().write([new ClipboardItem({ [picture.type]: picture })]);
  say("Copied.");
}

/** "Power spectral density of the texture" as "power-spectral-density-of-the-texture". */
export function fileName(words: string): string {
  const slug = words
    .toLowerCase()
    .replace(/[^\p{L}\p{N}]+/gu, "-")
    .replace(/^-|-$/g, "");
  return slug.length <= 60 ? slug || "asperity" : slug.slice(0, 60).replace(/-[^-]*$/, "");
}

/** A cell of a CSV (RFC 4180). */
export const csvCell = (text: string): string => (/[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

export const csvLine = (cells: readonly string[]): string => cells.map(csvCell).join(",") + "\r\n";
