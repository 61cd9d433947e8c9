import { type Box3, Vector3 } from "three";

/** The direction that is up on the screen, in the frame of the data: "-y" in the tracker's world, "z" on meshes. */
export type Upright = "-y" | "y" | "z";

export const viewNames = ["top", "bottom", "front", "back", "left", "right"] as const;
export type ViewName = (typeof viewNames)[number] | "home";

export function upOf(up: Upright): Vector3 {
  if (up === "z") return new Vector3(0, 0, 1);
  return new Vector3(0, up === "y" ? 1 : -1, 0);
}

/** Where the viewer is, seen from the middle; "front" is where the tracker's camera is, or −y where z is up. */
export function directionOf(name: ViewName, up: Upright): Vector3 {
  const above = upOf(up);
  const front = up === "z" ? new Vector3(0, -1, 0) : new Vector3(0, 0, up === "y" ? 1 : -1);
  const right = new Vector3().crossVectors(above, front);
  const nearPole = 1e-3; // a viewer exactly above has no "up" on the screen
  switch (name) {
    case "top":
      return above.addScaledVector(front, nearPole);
    case "bottom":
      return above.negate().addScaledVector(front, nearPole);
    case "front":
      return front;
    case "back":
      return front.negate();
    case "left":
      return right.negate();
    case "right":
      return right;
    case "home":
      return front.addScaledVector(right, 0.7).addScaledVector(above, 0.8);
  }
}

/** How far from the middle of a box a camera must stand that sees all of its corners; `from`: of unit length, towards it. */
export function fitDistance(box: Box3, from: Vector3, up: Vector3, fov_rad: number, aspect: number): number {
  const right = new Vector3().crossVectors(up, from).normalize();
  const above = new Vector3().crossVectors(from, right);
  const half = box.getSize(new Vector3()).multiplyScalar(0.5);
  const tall = Math.tan(fov_rad / 2);
  let distance = 0;
  for (let corner = 0; corner < 8; ++corner) {
    const at = new Vector3(corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y, corner & 4 ? half.z : -half.z);
    const sideways = Math.max(Math.abs(at.dot(right)) / (tall * aspect), Math.abs(at.dot(above)) / tall);
    distance = Math.max(distance, sideways + at.dot(from));
  }
  return distance;
}
