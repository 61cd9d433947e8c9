// Brings files into the project's folder: piece by piece, all or none.
import { call } from "../net/connection";
import type { Dropped } from "./dropped";

export interface Placed {
  /** The name that it had. */
  from: string;
  /** Its name in the project's folder. */
  name: string;
}

/** What a person has cancelled. */
export class Stopped extends Error {}

/** As base64 a message of two thirds of what the server takes. */
export const kPiece_bytes = 480 * 1024;

export async function sendFiles(files: readonly Dropped[], told: (fraction: number) => void, isStopped: () => boolean): Promise<Placed[]> {
  const { addition } = await call<{ addition: number }>("add.begin", { files: files.map(({ path, file }) => ({ path, bytes: file.size })) });
  const all = files.reduce((sum, { file }) => sum + file.size, 0);
  let sent = 0;
  try {
    for (const [index, { file }] of files.entries()) {
      for (let at = 0; at < file.size; at += kPiece_bytes) {
        if (isStopped()) throw new Stopped("cancelled");
        const piece = file.slice(at, at + kPiece_bytes);
        await call("add.bytes", { addition, file: index, at, base64: await base64(piece) });
        told((sent += piece.size) / all);
      }
    }
  } catch (error) {
    // What the server refused may have ended with the connection: the first reason is the one to show.
    await call("add.cancel", { addition }).catch(() => undefined);
    throw error;
  }
  return (await call<{ placed: Placed[] }>("add.end", { addition })).placed;
}

function base64(piece: Blob): Promise<string> {
  return new Promise((resolve, reject) => {
    const reader = new FileReader();
    reader.onload = () => resolve((reader.result as string).replace(/^[^,]*,/, ""));
    reader.onerror = () => reject(reader.error ?? new Error("a file could not be read"));
    reader.readAsDataURL(piece);
  });
}
