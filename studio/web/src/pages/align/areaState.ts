// The area that is shown, kept while the path is looked at.
import { signal } from "@preact/signals";
import type { Block } from "../../net/block";
import { call } from "../../net/connection";
import { areaKey, type AreaSection } from "./area";

export interface MadeArea {
  block: Block;
  /** The inputs that it was made of. */
  key: string;
}

export const madeArea = signal<MadeArea | null>(null);
export const makingArea = signal(false);
/** The reason why no area exists yet; "" if one exists or none was requested. */
export const areaFault = signal("");

export async function makeArea(area: AreaSection): Promise<void> {
  const key = areaKey(area);
  makingArea.value = true;
  areaFault.value = "";
  try {
    madeArea.value = { block: await call<Block>("align.area"), key };
  } catch (error) {
    if ((error as Error).message === "cancelled") return;
    madeArea.value = null;
    areaFault.value = (error as Error).message;
    throw error;
  } finally {
    makingArea.value = false;
  }
}
