// The results in report.html: blocks in base64 between script tags, as the program has put them there (docs/report.md).
import { decodeBlock, type NumberArray } from "../net/block";

export interface Problem {
  kind: string;
  message: string;
  count: number;
}

export interface Result {
  name: string;
  /** The content of result.json. */
  json: Record<string, any>;
  /** Along the base path, SI, nan in gaps. */
  profile: Record<"s_m" | "height_m" | "sigma_m" | "texture_m" | "force_N" | "speed_mps", Float32Array>;
  /** How many points the profile and the path had; fewer may be here. */
  profilePoints: number;
  pathPoints: number;
  /** n × 3, the tip in the world frame; empty if the path was not kept. */
  path_m: Float32Array;
}

/** Takes a block apart. Throws for one that is none or lacks something. */
export function decodeResult(frame: ArrayBuffer): Result {
  const { head, arrays } = decodeBlock(frame);
  const numbers = (name: string): Float32Array => {
    const array: NumberArray | undefined = arrays[name];
    if (!(array instanceof Float32Array)) throw new Error(`the report's data has no ${name}`);
    return array;
  };
  return {
    name: String(head.name),
    json: head.result,
    profile: {
      s_m: numbers("s_m"),
      height_m: numbers("height_m"),
      sigma_m: numbers("sigma_m"),
      texture_m: numbers("texture_m"),
      force_N: numbers("force_N"),
      speed_mps: numbers("speed_mps"),
    },
    profilePoints: head.profile_points,
    pathPoints: head.path_points,
    path_m: numbers("path_m"),
  };
}

export function bytesOfBase64(text: string): ArrayBuffer {
  const plain = atob(text);
  const bytes = new Uint8Array(plain.length);
  for (let index = 0; index < plain.length; ++index) bytes[index] = plain.charCodeAt(index);
  return bytes.buffer;
}

export function resultsOf(page: Document): Result[] {
  const blocks = page.querySelectorAll('script[type="application/octet-stream"]');
  return Array.from(blocks, (block) => decodeResult(bytesOfBase64(block.textContent ?? "")));
}

/** Names of settings with their groups, and their values: "profile.cutoff_cycles_per_mm", 0.1. */
export function flatSettings(config: unknown, group = ""): [string, string][] {
  if (config === null || typeof config !== "object" || Array.isArray(config)) {
    return [[group, Array.isArray(config) ? config.join(", ") : String(config)]];
  }
  return Object.entries(config).flatMap(([name, value]) => flatSettings(value, group ? `${group}.${name}` : name));
}
