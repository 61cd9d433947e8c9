// The vibration as sound: from the topic "feel.sound" to the audio worklet.
import { subscribe } from "../../net/connection";
import workletUrl from "./vibration.worklet.ts?worker&url";

export interface Sound {
  setVolume(volume: number): void;
  close(): void;
}

/** Begins to play; needs a user's gesture. Rejects in words where the browser has no audio worklets. */
export async function openSound(volume: number): Promise<Sound> {
  if (typeof AudioContext === "undefined" || typeof AudioWorkletNode === "undefined") {
    throw new Error("The vibration cannot be played here; the plots still show it. Browsers play it only on pages of this machine (127.0.0.1) or of a secure address.");
  }
  const context = new AudioContext({ latencyHint: "interactive" });
  try {
    await context.audioWorklet.addModule(workletUrl);
  } catch {
    await context.close();
    throw new Error("The code that plays the vibration could not be loaded. Reload the page and try again.");
  }
  const node = new AudioWorkletNode(context, "vibration", { numberOfInputs: 0, outputChannelCount: [2] });
  node.connect(context.destination);
  node.port.postMessage({ volume });
  await context.resume();
  const end = subscribe("feel.sound", (block) => {
    node.port.postMessage({ samples_N: Float32Array.from(block.arrays.force_N!), rate_Hz: block.head.rate_Hz });
  });
  return {
    setVolume: (next) => node.port.postMessage({ volume: next }),
    close: () => {
      end();
      node.disconnect();
      void context.close();
    },
  };
}
