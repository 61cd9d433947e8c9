// What the server reads an import's columns as, and the settings that a person's changes become.

export interface PlanColumn {
  number: number;
  label: string;
  unit: string;
}

export interface PlanMeaning {
  meaning: string;
  number: number;
  unit: string;
  negative: boolean;
  why: string;
}

export interface PlanFile {
  role: string;
  file: string;
  preset: string;
  rows: number;
  rate_hz: number;
  columns: PlanColumn[];
  /** Of the first rows. */
  cells: string[][];
  map: PlanMeaning[];
}

export interface ImportPlan {
  files: PlanFile[];
  checks: string;
  doubts: string[];
  fault: string;
}

/** Meanings that a column can be given, by their group, with the words that a person reads. */
export const kMeanings: readonly [group: string, meanings: readonly [meaning: string, words: string][]][] = [
  ["Time", [["t", "time"], ["t2", "time, to be added"]]],
  ["Position", [["px", "position x"], ["py", "position y"], ["pz", "position z"]]],
  ["Quaternion", [["qw", "quaternion w"], ["qx", "quaternion x"], ["qy", "quaternion y"], ["qz", "quaternion z"]]],
  ["Euler angles", [["rx", "angle about x"], ["ry", "angle about y"], ["rz", "angle about z"]]],
  ["Rotation vector", [["vx", "rotation vector x"], ["vy", "rotation vector y"], ["vz", "rotation vector z"]]],
  ["Rotation matrix", [1, 2, 3].flatMap((row) => [1, 2, 3].map((column): [string, string] => [`m${row}${column}`, `matrix, row ${row}, column ${column}`]))],
  ["Accelerometer", [["ax", "specific force x"], ["ay", "specific force y"], ["az", "specific force z"]]],
  ["Gyroscope", [["gx", "angular rate x"], ["gy", "angular rate y"], ["gz", "angular rate z"]]],
  ["Force", [["f", "force along the axis"], ["fx", "force x"], ["fy", "force y"], ["fz", "force z"]]],
];

/** The setting that holds what a file's columns mean. */
export const columnsSetting: Readonly<Record<string, string>> = {
  poses: "mapping.pose.columns",
  "inertial sensor": "mapping.imu.columns",
  gyroscope: "mapping.gyro.columns",
  force: "mapping.force.columns",
};

/** All meanings of a file as --columns takes them. */
export const columnsText = (map: readonly PlanMeaning[]): string =>
  map.map(({ meaning, number, unit, negative }) => `${meaning}=${negative ? "-" : ""}#${number}${unit && unit !== "1" ? `[${unit}]` : ""}`).join(", ");

/** The map after one column was given another meaning ("": none), unit or sign; a meaning belongs to one column. */
export function withMeaning(map: readonly PlanMeaning[], number: number, change: Partial<Pick<PlanMeaning, "meaning" | "unit" | "negative">>): PlanMeaning[] {
  const old = map.find((one) => one.number === number) ?? { meaning: "", number, unit: "", negative: false, why: "stated" };
  const next = { ...old, ...change, why: "stated" };
  // Another quantity has other units.
  if (change.meaning !== undefined && change.meaning[0] !== old.meaning[0] && change.unit === undefined) next.unit = "";
  const rest = map.filter((one) => one.number !== number && one.meaning !== next.meaning);
  return next.meaning === "" ? rest : [...rest, next].sort((a, b) => a.number - b.number);
}

/** A name for the recording, of its file's. */
export const recordingName = (file: string): string =>
  file
    .replace(/^.*\//, "")
    .replace(/\.[^.]*$/, "")
    .replace(/[^\p{L}\p{N}_-]+/gu, "_")
    .replace(/^[_.-]+|[_.-]+$/g, "") || "recording";
